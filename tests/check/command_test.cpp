// The program itself: what it reads, prints, and how it ends.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace rung {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kProgram =
    "//@ a: always I1 -> !Q0\n"
    "//@ b: settles within 2 scans\n"
    "Q0 = (I0 || Q0) && !I1;\n";

std::string result_of(const std::string& name, const std::string& kind,
                      const std::string& text, const std::string& lemmas) {
  return R"({"schema": "rungproof.result/1", "files": [{"language": "script",
    "dialect": "sim", "semantics": "sim", "scan_ms": [1, 100]}],
    "properties": [{"name": ")" +
         name + R"(", "kind": ")" + kind + R"(", "text": ")" + text +
         R"(", "goal": "invariant", "verdict": "proved", "certificate":
    {"k": 0, "lemmas": [)" +
         lemmas + "]}}]}";
}

std::string equivalence(const std::string& lemmas, const std::string& more) {
  return R"({"schema": "rungproof.equiv/1", "verdict": "equivalent",
    "outputs": ["Q0"], "delay": 0, "certificate": {"k": 0, "lemmas": [)" +
         lemmas + "]}" + more + "}";
}

class CheckCommand : public testing::Test {
 protected:
  CheckCommand() {
    std::string name = (fs::temp_directory_path() / "check-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
    write("a.rung", std::string(kProgram));
    write("good.json", result_of("a", "always", "a: always I1 -> !Q0", ""));
  }
  ~CheckCommand() override {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  CheckCommand(const CheckCommand&) = delete;
  CheckCommand& operator=(const CheckCommand&) = delete;

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
  }

  /// The exit status; what it printed is in `said_`.
  int run(const std::string& arguments) {
    const std::string command = "cd " + path_.string() + " && " +
                                RUNG_CHECK_PROGRAM + " " + arguments + " 2>&1";
    std::FILE* const pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return -1;
    said_.clear();
    std::array<char, 4096> buffer{};
    std::size_t count = 0;
    while ((count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0) {
      said_.append(buffer.data(), count);
    }
    const int status = ::pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  fs::path path_;
  std::string said_;
};

TEST_F(CheckCommand, Confirms) {
  EXPECT_EQ(run("a.rung good.json"), 0) << said_;
  EXPECT_NE(said_.find("confirmed: a\n"), std::string::npos) << said_;
  EXPECT_EQ(run("a.rung good.json --property a --timeout 20"), 0) << said_;
}

TEST_F(CheckCommand, ConfirmsWithAnotherSolver) {
  if (std::system("command -v cvc5 > /dev/null") != 0) GTEST_SKIP();
  EXPECT_EQ(run("--solver cvc5 a.rung good.json"), 0) << said_;
}

TEST_F(CheckCommand, Rejects) {
  write("other.json", result_of("a", "always", "a: always I1 -> Q0", ""));
  EXPECT_EQ(run("a.rung other.json"), 1) << said_;
  write("lemma.json",
        result_of("a", "always", "a: always I1 -> !Q0", "\"!Q0\""));
  EXPECT_EQ(run("a.rung lemma.json"), 1) << said_;
  EXPECT_NE(said_.find("consecution of lemma `!Q0` fails"), std::string::npos)
      << said_;
  EXPECT_EQ(run("a.rung good.json --scan 1..50"), 1) << said_;
  write("a.rung", "//@ a: always I1 -> !Q0\nQ0 = (I0 || Q0) && I1;\n");
  EXPECT_EQ(run("a.rung good.json"), 1) << said_;
}

TEST_F(CheckCommand, ComparesTwoPrograms) {
  write("b.rung", "Q0 = I0 && !I1 || Q0 && !I1;\n");
  write("c.rung", "Q0 = I0 && !I1 || Q0 && !I2;\n");
  write("d.rung", "Q5 = I3 && !I1 || Q5 && !I1;\n");
  write("same.json", equivalence("\"(a.Q0 == b.Q0)\"", ""));
  EXPECT_EQ(run("a.rung b.rung same.json"), 0) << said_;
  EXPECT_NE(said_.find("confirmed: Q0\n"), std::string::npos) << said_;
  EXPECT_EQ(run("a.rung c.rung same.json"), 1) << said_;
  EXPECT_EQ(run("a.rung d.rung same.json"), 1) << said_;
  write("mapped.json", equivalence("\"(a.Q0 == b.Q5)\"", ""));
  EXPECT_EQ(run("a.rung d.rung mapped.json --map Q0=Q5 --map I0=I3"), 0)
      << said_;
  EXPECT_EQ(run("a.rung d.rung mapped.json --map Q0=Q5"), 1) << said_;
}

TEST_F(CheckCommand, RefusesBadInput) {
  write("bad.json", "{");
  write("same.json", equivalence("", ""));
  write("bad.rung", "Q0 = ;\n");
  for (const char* const arguments : {"",
                                      "a.rung",
                                      "a.rung none.json",
                                      "none.rung good.json",
                                      "a.rung bad.json",
                                      "bad.rung good.json",
                                      "a.rung a.rung",
                                      "a.rung good.json --property c",
                                      "a.rung good.json --solver none",
                                      "a.rung good.json --scan five",
                                      "a.rung good.json --scan 9..1",
                                      "a.rung good.json --dialect none",
                                      "a.rung good.json --timeout 0",
                                      "a.rung same.json",
                                      "a.rung a.rung good.json",
                                      "a.rung bad.rung same.json",
                                      "a.rung none.rung same.json",
                                      "a.rung a.rung a.rung same.json",
                                      "a.rung a.rung same.json --map Q0",
                                      "a.rung a.rung same.json --map =Q0",
                                      "a.rung a.rung same.json --map Q0="}) {
    EXPECT_EQ(run(arguments), 2) << arguments << "\n" << said_;
  }
}

TEST_F(CheckCommand, SaysWhatItDoesNotCheck) {
  write("b.json", result_of("b", "settles", "b: settles within 2 scans", ""));
  EXPECT_EQ(run("a.rung b.json"), 3) << said_;
  EXPECT_NE(said_.find("not checked: b: `settles` is not known here"),
            std::string::npos)
      << said_;
  write("settled.json",
        equivalence("\"(a.Q0 == b.Q0)\"", ", \"settled\": true"));
  EXPECT_EQ(run("a.rung a.rung settled.json"), 3) << said_;
  // A solver that is not there confirms nothing.
  ::setenv("RUNG_OLD_PATH", std::getenv("PATH"), 1);
  ::setenv("PATH", path_.c_str(), 1);
  EXPECT_EQ(run("a.rung good.json"), 3) << said_;
  ::setenv("PATH", std::getenv("RUNG_OLD_PATH"), 1);
}

}  // namespace
}  // namespace rung
