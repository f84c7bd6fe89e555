// The result cache: a kept answer is the same bytes, and nothing but the answer
// to the same question is ever taken for one.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "app/packed_answer.h"
#include "app/result_store.h"
#include "tests/app/sandbox.h"

namespace rung::test {
namespace {

constexpr const char* kMotor =
    "//@ input I2\n"
    "//@ stopped: never Q0 && I1\n"
    "//@ reach Q0\n"
    "//@ soon: after I0, Q0 within 3 scans\n"
    "Q0 = (I0 || Q0) && !I1;\n"
    "Q1 = I2;\n"
    "Q1 = I3;\n";
constexpr const char* kFan = "//@ never Q0 && I1\nQ0 = (I0 || Q0) && !I1;\n";

/// Its answer, and what is proved of its slices.
constexpr std::size_t kOfOneCheck = 2;

Digest key_of(const std::string& text) { return Hasher().add(text).finish(); }

/// All entries below `directory`, in the order of their names.
std::vector<fs::path> entries(const fs::path& directory) {
  std::vector<fs::path> found;
  if (!fs::exists(directory)) return found;
  for (const auto& at : fs::recursive_directory_iterator(directory)) {
    if (at.is_regular_file()) found.push_back(at.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

struct Said {
  int status = -1;
  std::string out;
  std::string err;
  std::string report;  // x.json
  bool operator==(const Said&) const = default;
};

Said ask(const Sandbox& sandbox, const std::string& command) {
  Said said;
  said.status = sandbox.run(command + " --format json:x.json");
  said.out = sandbox.out();
  said.err = sandbox.err();
  said.report = read_text(sandbox.path() / "x.json");
  return said;
}

TEST(Digest, IsSha256) {
  // FIPS 180-2, B.1, behind the length that add() puts before a text: so the
  // standard's own value is not it, and a text is not its parts.
  EXPECT_EQ(to_string(Hasher().finish()),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_NE(Hasher().add("ab").add("c").finish(),
            Hasher().add("a").add("bc").finish());
}

TEST(ResultStore, GivesBackWhatWasKept) {
  const Sandbox sandbox;
  const ResultStore store(sandbox.path() / "c");
  ASSERT_EQ(store.open(), std::nullopt);
  const std::string bytes("a\0\xff\n", 4);
  EXPECT_EQ(store.find(key_of("one")), std::nullopt);
  EXPECT_EQ(store.keep(key_of("one"), bytes), std::nullopt);
  EXPECT_EQ(store.keep(key_of("none"), ""), std::nullopt);
  EXPECT_EQ(store.find(key_of("one")), bytes);
  EXPECT_EQ(store.find(key_of("none")), "");
  EXPECT_EQ(store.find(key_of("two")), std::nullopt);
  EXPECT_EQ(store.size().entries, 2U);
}

TEST(ResultStore, BelievesNoByteThatWasChangedOrLost) {
  const Sandbox sandbox;
  const ResultStore store(sandbox.path());
  ASSERT_EQ(store.keep(key_of("one"), "proved, all of it"), std::nullopt);
  const fs::path path = entries(sandbox.path()).front();
  const std::string whole = read_text(path);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    write_text(path, changed);
    EXPECT_EQ(store.find(key_of("one")), std::nullopt) << "byte " << i;
    write_text(path, whole.substr(0, i));
    EXPECT_EQ(store.find(key_of("one")), std::nullopt) << "cut at " << i;
  }
  write_text(path, whole + "\n");
  EXPECT_EQ(store.find(key_of("one")), std::nullopt);
  write_text(path, whole);
  EXPECT_EQ(store.find(key_of("one")), "proved, all of it");
}

TEST(ResultStore, BelievesNoEntryOfAnotherKey) {
  const Sandbox sandbox;
  const ResultStore store(sandbox.path());
  ASSERT_EQ(store.keep(key_of("one"), "proved"), std::nullopt);
  const fs::path one = entries(sandbox.path()).front();
  ASSERT_EQ(store.keep(key_of("two"), "violated"), std::nullopt);
  for (const fs::path& path : entries(sandbox.path())) {
    if (path != one) {
      fs::copy_file(one, path, fs::copy_options::overwrite_existing);
    }
  }
  EXPECT_EQ(store.find(key_of("two")), std::nullopt);
}

TEST(ResultStore, StaysWithinItsBoundAndLosesWhatIsOldest) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "README", std::string(5000, 'r'));
  write_text(sandbox.path() / "ab/mine.txt", "not an entry");
  const ResultStore store(sandbox.path(), 2000);
  const std::string bytes(300, 'x');  // an entry has a line of 65 more
  const auto now = fs::file_time_type::clock::now();
  std::set<fs::path> before;
  for (int i = 0; i < 8; ++i) {
    ASSERT_EQ(store.keep(key_of(std::to_string(i)), bytes), std::nullopt);
    for (const fs::path& path : entries(sandbox.path())) {
      const bool is_new = before.insert(path).second && path.extension() == "";
      if (is_new)
        fs::last_write_time(path, now - std::chrono::minutes(100 - i));
    }
  }
  EXPECT_TRUE(store.find(key_of("0")));  // so it was used last
  store.trim();
  EXPECT_LE(store.size().bytes, 2000U);
  EXPECT_TRUE(store.find(key_of("0")));
  EXPECT_TRUE(store.find(key_of("7")));
  EXPECT_FALSE(store.find(key_of("1")));
  store.clear();
  EXPECT_EQ(store.size().entries, 0U);
  EXPECT_EQ(read_text(sandbox.path() / "README").size(), 5000U);
  EXPECT_EQ(read_text(sandbox.path() / "ab/mine.txt"), "not an entry");
}

TEST(ResultStore, RefusesWhatOthersMayWriteInto) {
  const Sandbox sandbox;
  const ResultStore store(sandbox.path());
  EXPECT_EQ(store.open(), std::nullopt);
  ::chmod(sandbox.path().c_str(), 0777);
  ASSERT_TRUE(store.open());
  EXPECT_NE(store.open()->find("may write into it"), std::string::npos);
  write_text(sandbox.path() / "file", "");
  EXPECT_TRUE(ResultStore(sandbox.path() / "file").open());
  EXPECT_TRUE(ResultStore(sandbox.path() / "file/below").open());
}

TEST(ResultStore, ManyMayWriteAtOnce) {
  const Sandbox sandbox;
  const auto work = [&](int own) {
    const ResultStore store(sandbox.path(), 200'000);
    for (int i = 0; i < 200; ++i) {
      const std::string name = std::to_string(i % 10);
      const std::string bytes(1000 + static_cast<std::size_t>(i % 10), 'x');
      EXPECT_EQ(store.keep(key_of(name), bytes), std::nullopt);
      const auto found = store.find(key_of(name));
      EXPECT_TRUE(!found || *found == bytes);
      if (i % 50 == own) store.trim();
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back(work, i);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(ResultStore(sandbox.path()).size().entries, 10U);
}

TEST(PackedAnswer, IsNoneInBytesThatAreNone) {
  FileReport report;
  report.program = std::make_shared<Program>();
  report.findings.resize(1);
  TextPool texts;
  const AnswerFiles files{FileId(0), {}};
  const auto packed = pack_answer(report, 0, files);
  ASSERT_TRUE(packed);
  for (std::size_t i = 0; i < packed->size(); ++i) {
    FileReport to = report;
    to.findings.clear();
    EXPECT_FALSE(unpack_answer(packed->substr(0, i), files, texts, to));
    EXPECT_TRUE(to.findings.empty());
  }
  for (const char* const bytes : {"", "\x80", "\xf6", "\x84\x01\x02\x03\x04",
                                  "\x84\x80\x81\x00\x80\x80", "{}"}) {
    FileReport to = report;
    EXPECT_FALSE(unpack_answer(bytes, files, texts, to)) << bytes;
  }
}

TEST(PackedAnswer, IsNotMadeOfWhatFailedItsCheck) {
  FileReport report;
  report.program = std::make_shared<Program>();
  const AnswerFiles files{FileId(0), {}};
  EXPECT_TRUE(pack_answer(report, 0, files));
  report.findings.resize(1);
  report.findings[0].where = {FileId(7), 0, 1};
  EXPECT_FALSE(pack_answer(report, 0, files)) << "a place in another file";
  report.findings.clear();
  report.failures.resize(1);
  EXPECT_FALSE(pack_answer(report, 0, files));
}

TEST(Cache, RepeatsEveryByteAndTheStatus) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "motor.rung", kMotor);
  write_text(sandbox.path() / "fan.rung", kFan);
  write_text(sandbox.path() / "latin.rung", "// caf\xe9\nQ0 = I0; Q0 = I1;\n");
  write_text(sandbox.path() / "bad.rung", "Q0 = ;\n");
  for (const std::string command :
       {"check -v motor.rung fan.rung latin.rung bad.rung", "lint motor.rung",
        "prove -v fan.rung", "prove --sweep fan.rung", "check -q motor.rung",
        "check --props good.props motor.rung"}) {
    SCOPED_TRACE(command);
    write_text(sandbox.path() / "good.props", "never Q0 && I1\n");
    fs::remove_all(sandbox.path() / "c");
    const std::string asked = "rungproof " + command + " --cache c --jobs ";
    const Said cold = ask(sandbox, asked + "1");
    const std::size_t kept = entries(sandbox.path() / "c").size();
    EXPECT_GT(kept, 0U);
    EXPECT_EQ(ask(sandbox, asked + "1"), cold);
    EXPECT_EQ(ask(sandbox, asked + "4"), cold);
    EXPECT_EQ(entries(sandbox.path() / "c").size(), kept);
    // The lines of the properties moved, and nothing else.
    write_text(sandbox.path() / "good.props", "\nnever Q0 && I1\n");
    const bool has_props = command.find("--props") != std::string::npos;
    EXPECT_EQ(ask(sandbox, asked + "1") == cold, !has_props);
  }
}

TEST(Cache, IsAskedForByTheEnvironmentToo) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "fan.rung", kFan);
  const std::string check = " rungproof lint fan.rung";
  EXPECT_EQ(sandbox.run("RUNGPROOF_CACHE=c" + check + " --cache off"), 0);
  EXPECT_TRUE(entries(sandbox.path() / "c").empty());
  EXPECT_EQ(sandbox.run("RUNGPROOF_CACHE=c" + check), 0);
  EXPECT_EQ(entries(sandbox.path() / "c").size(), 1U);
  EXPECT_EQ(sandbox.run("XDG_CACHE_HOME=$PWD/x" + check + " --cache on"), 0);
  EXPECT_EQ(entries(sandbox.path() / "x/rungproof").size(), 1U);
}

TEST(Cache, AChangedProgramIsAnotherQuestion) {
  const Sandbox sandbox;
  const std::string command = "rungproof check fan.rung --cache c";
  write_text(sandbox.path() / "fan.rung", kFan);
  EXPECT_EQ(sandbox.run(command), 0);
  write_text(sandbox.path() / "fan.rung",
             "//@ never Q0 && I1\nQ0 = (I0 || Q0) || !I1;\n");
  EXPECT_EQ(sandbox.run(command), 1) << sandbox.out();
}

TEST(Cache, ABrokenEntryIsFoundAgain) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "motor.rung", kMotor);
  const std::string command =
      "rungproof check motor.rung --cache c --format sarif";
  const int status = sandbox.run(command);
  const std::string cold = sandbox.out();
  for (const fs::path& path : entries(sandbox.path() / "c")) {
    const std::string whole = read_text(path);
    std::string changed = whole;
    changed[changed.size() / 2] ^= 0x20;
    for (const std::string& bytes :
         {changed, std::string(), whole + "x", whole.substr(0, 65),
          std::string(70, 'a')}) {
      for (const fs::path& one : entries(sandbox.path() / "c")) {
        write_text(one, bytes);
      }
      EXPECT_EQ(sandbox.run(command), status);
      EXPECT_EQ(sandbox.out(), cold);
      EXPECT_NE(read_text(path), bytes) << "it was written again";
    }
  }
}

TEST(Cache, AnotherBuildIsAnotherQuestion) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "fan.rung", kFan);
  EXPECT_EQ(sandbox.run("rungproof check fan.rung --cache c"), 0);
  EXPECT_EQ(entries(sandbox.path() / "c").size(), kOfOneCheck);
  std::string program = read_text(RUNG_PROGRAM);
  // Name size 4, description size 20, NT_GNU_BUILD_ID: then the name, the id.
  const std::string head("\x04\0\0\0\x14\0\0\0\x03\0\0\0GNU\0", 16);
  const std::size_t at = program.find(head);
  ASSERT_NE(at, std::string::npos);
  program[at + head.size()] ^= 1;
  write_text(sandbox.path() / "other", program);
  fs::permissions(sandbox.path() / "other", fs::perms::owner_all);
  EXPECT_EQ(sandbox.run("./other check fan.rung --cache c"), 0);
  EXPECT_EQ(entries(sandbox.path() / "c").size(), 2 * kOfOneCheck);
}

TEST(Cache, IsRightWhenManyFillIt) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "motor.rung", kMotor);
  write_text(sandbox.path() / "fan.rung", kFan);
  const std::string check = "rungproof check motor.rung fan.rung --cache c";
  EXPECT_EQ(sandbox.run("for i in 1 2 3 4 5 6; do " + check +
                        " >$i.out 2>&1 & done; wait"),
            0);
  EXPECT_EQ(sandbox.run(check), 1);
  for (int i = 1; i <= 6; ++i) {
    EXPECT_EQ(read_text(sandbox.path() / (std::to_string(i) + ".out")),
              sandbox.out());
  }
  EXPECT_EQ(entries(sandbox.path() / "c").size(), 2 * kOfOneCheck)
      << "nothing half-written";
}

// What an option does to the cache. One that the program has and this table
// does not fails the test: think of it before it serves an old answer.
enum class Effect {
  Asks,     // another question, and no proof is the other's
  Selects,  // another question, of which proofs do not depend
  Shows,    // the same answer, shown or found in another way
  Apart,    // no answer is kept or taken
};
struct OptionRow {
  std::string use;  // "--scan 1..5"
  Effect effect = Effect::Asks;
  std::string command = "check";
};
const std::vector<OptionRow>& option_rows() {
  static const std::vector<OptionRow> rows = {
      {"--format json", Effect::Shows},
      {"--scan 1..5", Effect::Asks},
      {"--semantics sim", Effect::Asks},
      {"--stable-inputs", Effect::Asks},
      {"--rollover", Effect::Asks},
      {"--pou main", Effect::Asks},
      {"--dialect sim", Effect::Asks},
      {"--language script", Effect::Asks},
      {"--props one.props", Effect::Selects},
      {"--timeout 30", Effect::Selects},
      {"--engine pdr", Effect::Asks},
      {"--jobs 3", Effect::Shows},
      // Each file may have its own, in a configuration: it is part of that.
      {"--fail-on error", Effect::Asks},
      {"--config other.toml", Effect::Asks},
      {"--no-config", Effect::Asks},
      {"--pack pedantic", Effect::Asks},
      {"--rule double-coil=off", Effect::Asks},
      {"--baseline known.json", Effect::Shows},
      {"--color always", Effect::Shows},
      {"--quiet", Effect::Shows},
      {"--verbose", Effect::Shows},
      {"--property stopped", Effect::Selects},
      {"--self-check off", Effect::Asks},
      {"--recheck z3", Effect::Apart},
      {"--certificates certificates", Effect::Apart},
      {"--cache c", Effect::Shows},
      {"--explain", Effect::Apart},
      {"--traces traces", Effect::Asks, "prove"},
      {"--fix", Effect::Asks, "lint"},
      {"--diff", Effect::Apart, "lint"},
      {"--map a=b", Effect::Asks},  // of no effect on these commands
      {"--locked", Effect::Apart},
      {"--sweep", Effect::Selects, "prove"},
      {"--replay-on uno", Effect::Apart, "prove"},
      {"--inject wrong-trace", Effect::Apart},
      {"--inject wrong-invariant", Effect::Apart},
      {"--help", Effect::Apart},
      {"--version", Effect::Apart},
  };
  return rows;
}

std::set<std::string> options_in(const std::string& help) {
  std::set<std::string> found;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  -")) continue;
    const std::size_t at = line.find("--");
    found.insert(line.substr(at, line.find_first_of(" ,{", at) - at));
  }
  return found;
}

TEST(Cache, KnowsOfEveryOptionWhatItChanges) {
  const Sandbox sandbox;
  std::set<std::string> has;
  for (const std::string help :
       {"rungproof --help", "rungproof check --help", "rungproof lint --help",
        "rungproof prove --help"}) {
    sandbox.run(help);
    has.merge(options_in(sandbox.out()));
  }
  std::set<std::string> known;
  for (const OptionRow& row : option_rows()) {
    known.insert(row.use.substr(0, row.use.find(' ')));
  }
  known.erase("--inject");  // hidden
  EXPECT_EQ(has, known);
}

TEST(Cache, KeepsAnswersOfEveryOptionApart) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "motor.rung", kMotor);
  write_text(sandbox.path() / "one.props", "never Q1 && Q0 && I1\n");
  write_text(sandbox.path() / "other.toml", "[check]\nscan = \"1..7\"\n");
  EXPECT_EQ(sandbox.run("rungproof baseline write motor.rung "
                        "--baseline known.json"),
            0)
      << sandbox.err();
  for (const OptionRow& row : option_rows()) {
    SCOPED_TRACE(row.use);
    write_text(sandbox.path() / "motor.rung", kMotor);  // --fix changes it
    fs::remove_all(sandbox.path() / "c");
    const std::string plain = "rungproof " + row.command + " motor.rung";
    const std::string cached =
        row.use == "--cache c" ? plain : plain + " --cache c";
    const std::string with_option = cached + " " + row.use;
    sandbox.run(plain + " --cache c");
    const std::size_t before = entries(sandbox.path() / "c").size();
    ASSERT_EQ(before, row.command == "lint" ? 1 : kOfOneCheck);
    sandbox.run(with_option);
    const std::size_t now = entries(sandbox.path() / "c").size();
    if (row.effect == Effect::Asks) {
      EXPECT_GE(now, 2 * before) << sandbox.out() << sandbox.err();
    } else if (row.effect == Effect::Selects) {
      EXPECT_GT(now, before) << sandbox.out() << sandbox.err();
    } else {
      EXPECT_EQ(now, before) << sandbox.out() << sandbox.err();
    }
    if (row.effect != Effect::Apart) continue;
    fs::remove_all(sandbox.path() / "c");
    if (row.use == "--locked") continue;  // answers about slices are kept
    sandbox.run(with_option);
    EXPECT_TRUE(entries(sandbox.path() / "c").empty()) << "it was kept";
  }
}

}  // namespace
}  // namespace rung::test
