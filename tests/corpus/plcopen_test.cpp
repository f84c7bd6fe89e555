#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "analysis/property.h"
#include "confirm.h"
#include "frontend/props_yaml.h"
#include "frontend/recognise.h"
#include "smt/equivalence.h"
#include "smt/verify.h"

namespace rung {
namespace {

// Ladders of other tools, and the structured text that the tools made of them.

const std::string kRoot = RUNG_SOURCE_DIR "/../shared/corpus/";

bool has_corpus() { return std::filesystem::exists(kRoot + "plcopen_ld"); }

/// Without the lines `(*DBG:...*)` that the OpenPLC editor puts behind a
/// program, and takes away before it is compiled: they are C, and no comments.
std::string text_of(const std::string& path) {
  std::ifstream in(kRoot + path, std::ios::binary);
  std::string text;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("(*DBG:")) text += line + "\n";
  }
  return text;
}

/// A file that was read, with its program if there were no errors.
struct Read {
  Read(const std::string& path, std::string_view semantics,
       std::string_view pou = "")
      : Read(path, text_of(path), semantics, pou) {}
  Read(const std::string& path, std::string text, std::string_view semantics,
       std::string_view pou)
      : file(sources.add(path, std::move(text))) {
    const Language& language = recognise(sources[file].text());
    name = language.name;
    if (!language.supported()) return;
    ReadOptions options;
    options.semantics = find_semantics(semantics);
    options.pou = pou;
    ast = language.read(sources, file, options, list);
    read = !list.has_errors();
  }
  void build() {
    program = build_program(ast, {}, list);
    if (!list.has_errors()) read_properties(program, {}, sources, list);
    read = !list.has_errors();
  }
  /// A property line that does not stand in the file.
  void say(const std::string& line) {
    lines.push_back(std::make_unique<std::string>(line));
    ast.annotations.push_back({*lines.back(), {file, 0, 0}});
  }
  /// The variables of the text that are memory; with `assigned`, those that
  /// some statement writes.
  std::set<std::string> memory(bool assigned) const {
    std::set<std::string> targets;
    for (const AstAssignment& rung : ast.rungs) targets.emplace(rung.target);
    std::set<std::string> names;
    for (const AstDeclaration& cell : ast.declarations) {
      if (cell.kind != AstDeclaration::Kind::Memory || cell.made) continue;
      const std::string key(cell.name);
      if (targets.contains(key) == assigned) names.insert(key);
    }
    return names;
  }
  bool has_inputs() const {
    return std::any_of(ast.declarations.begin(), ast.declarations.end(),
                       [](const AstDeclaration& cell) {
                         return cell.kind == AstDeclaration::Kind::Input;
                       });
  }
  /// `read`, or the first error's code and message.
  std::string outcome() const {
    for (const Diagnostic& item : list.items()) {
      if (item.severity == Severity::Error) {
        return std::string(item.code) + " " + item.message;
      }
    }
    return read ? "read" : "no reader";
  }

  SourceSet sources;
  DiagnosticList list;
  FileId file;
  Ast ast;
  Program program;
  std::vector<std::unique_ptr<std::string>> lines;
  std::string_view name;
  bool read = false;
};

std::vector<std::string> all_files(std::string_view extension) {
  std::vector<std::string> files;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(kRoot + "plcopen_ld")) {
    if (entry.path().extension() != extension) continue;
    files.push_back(
        std::filesystem::relative(entry.path(), kRoot).generic_string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

using Counts = std::map<std::string, int>;

/// `read`, or the error's code and the name that its message has.
std::string reason(const std::string& outcome) {
  const std::size_t begin = outcome.find('`');
  const std::size_t end = outcome.find('`', begin + 1);
  if (outcome.size() < 5 || begin == std::string::npos) {
    return outcome.substr(0, 5);
  }
  return outcome.substr(0, 6) + outcome.substr(begin + 1, end - begin - 1);
}

Counts outcomes(std::string_view extension) {
  Counts counts;
  for (const std::string& path : all_files(extension)) {
    // Files of three programs; the attacks are on the first.
    const bool three = path.find("/swat/") != std::string::npos;
    Read one(path, "openplc", three ? "PLC1" : "");
    if (one.read) one.build();
    ++counts[reason(one.outcome())];
  }
  return counts;
}

// 89 drawings, 86 texts that tools made of them, 18 files of properties. A loop
// without a constant number of passes is an attack in most of these files.
TEST(PlcopenCorpus, IsReadOrRefusedForItsReason) {
  if (!has_corpus()) GTEST_SKIP() << "no " << kRoot;
  EXPECT_EQ(outcomes(".xml"),
            (Counts{{"read", 37},
                    {"RP100", 21},       // a WHILE that never ends
                    {"RP041 WHILE", 6},  // one that may
                    {"RP041 __TRY", 5},
                    {"RP041 1.0", 3},  // REAL
                    {"RP041 REAL", 3},
                    {"RP041 TIME_TO_REAL", 1},
                    {"RP041 'test.mosquitto.org'", 2},  // STRING
                    {"RP041 '192.168.0.177'", 1},
                    {"RP041 P1AM_INIT", 1},
                    {"RP041 VAR_EXTERNAL", 1},  // of which there is no global
                    {"RP043 2147483647", 1},    // of an INT
                    {"RP045", 3},               // PT that counts scans
                    {"RP049", 1},               // a divisor that may be 0
                    {"RP094 actions", 1},       // SFC
                    {"RP094 arrayValue", 1},
                    {"RP098", 1}}));  // power rails and nothing else
  EXPECT_EQ(outcomes(".st"), (Counts{{"read", 38},
                                     {"RP100", 30},
                                     {"RP041 WHILE", 6},
                                     {"RP041 __TRY", 5},
                                     {"RP041 1.0", 1},
                                     {"RP041 REAL", 3},
                                     {"RP041 HMI_BOOL", 2},
                                     {"RP041 VAR_EXTERNAL", 1}}));
  EXPECT_EQ(all_files(".yaml").size(), 18U);
}

/// A drawing, the text that a tool made of it, and what the manifest says.
struct Pair {
  std::string drawing;
  std::string text;
  std::string semantics;
  bool differs = false;
};

std::vector<Pair> pairs() {
  std::vector<Pair> pairs;
  std::istringstream lines(text_of("MANIFEST.tsv"));
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> columns;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, '\t');) {
      columns.push_back(cell);
    }
    constexpr std::size_t kExpected = 7;
    if (columns.size() <= kExpected || !columns[0].ends_with(".xml")) continue;
    const std::string& expected = columns[kExpected];
    std::istringstream words(expected);
    for (std::string word; words >> word;) {
      while (word.ends_with(";")) word.pop_back();
      if (!word.starts_with("plcopen_ld/") || !word.ends_with(".st")) continue;
      const bool by_place =
          word.ends_with(".pos-order.st") ||
          expected.find("order=position") != std::string::npos;
      pairs.push_back({columns[0], word, by_place ? "beremiz-py2" : "openplc",
                       expected.find("DIFFER") != std::string::npos});
    }
  }
  return pairs;
}

/// The programs of a structured text.
std::vector<std::string> programs_of(const std::string& path) {
  std::vector<std::string> names;
  std::istringstream lines(text_of(path));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("PROGRAM ")) names.push_back(line.substr(8));
  }
  return names;
}

/// Whatever both write is compared, not only outputs. Programs that declare no
/// inputs have them among their variables: those that nothing writes.
void compare_memory(Read& a, Read& b) {
  const std::set<std::string> other = b.memory(true);
  for (const std::string& name : a.memory(true)) {
    if (!other.contains(name)) continue;
    a.say("output " + name);
    b.say("output " + name);
  }
  if (a.has_inputs()) return;
  for (const std::string& name : a.memory(false)) {
    a.say("input " + name);
    b.say("input " + name);
  }
}

std::string compare(Read a, Read b) {
  if (a.read && b.read) {
    compare_memory(a, b);
    a.build();
    b.build();
  }
  if (!a.read || !b.read) {
    return a.read == b.read
               ? "refused"
               : "drawing: " + a.outcome() + "; text: " + b.outcome();
  }
  const EquivalenceResult result = check_equivalence(a.program, b.program, {});
  if (!result.failures.empty()) return result.failures.front().what;
  switch (result.verdict) {
    case EquivalenceVerdict::Equivalent:
      return "equivalent";
    case EquivalenceVerdict::Different:
      return "different";
    case EquivalenceVerdict::Bounded:
    case EquivalenceVerdict::Unknown:
      break;
  }
  return result.error + result.reason;
}

std::string compare(const Pair& pair, const std::string& pou) {
  return compare(Read(pair.drawing, pair.semantics, pou),
                 Read(pair.text, pair.semantics, pou));
}

void show(const Pair& pair, const std::string& what) {
  if (std::getenv("RUNG_SHOW") == nullptr) return;
  std::printf("%s %s %s\n", pair.text.c_str(), pair.semantics.c_str(),
              what.c_str());
}

// The drawings are what the tools' structured text says, under the semantics
// of the tool: every variable that both write, in every scan.
TEST(PlcopenCorpus, IsWhatTheToolsMakeOfIt) {
  if (!has_corpus()) GTEST_SKIP() << "no " << kRoot;
  Counts counts;
  for (const Pair& pair : pairs()) {
    for (const std::string& pou : programs_of(pair.text)) {
      const std::string result = compare(pair, pou);
      show(pair, pou + ": " + result);
      ++counts[result];
    }
  }
  EXPECT_EQ(counts, (Counts{{"equivalent", 81}, {"refused", 53}}));
}

/// Without what stands from `begin` to `end`, which must be there.
std::string without(std::string text, std::string_view begin,
                    std::string_view end) {
  const std::size_t from = text.find(begin);
  const std::size_t to = text.find(end, from);
  EXPECT_NE(to, std::string::npos) << begin;
  if (to == std::string::npos) return text;
  return text.erase(from, to + end.size() - from);
}

// Of three drawings the manifest says that they differ from their text. Where
// both are refused, what they are refused for is taken out of both: the handler
// of an exception that nothing raises, a loop that never ends.
TEST(PlcopenCorpus, ThreePairsDifferInTheirText) {
  if (!has_corpus()) GTEST_SKIP() << "no " << kRoot;
  std::map<std::string, std::string> results;
  for (const Pair& pair : pairs()) {
    if (!pair.differs) continue;
    for (const std::string& pou : programs_of(pair.text)) {
      const auto plain = [&](const std::string& path) {
        std::string text = text_of(path);
        if (path.find("LE_GE2") != std::string::npos) {
          text = without(text, "__TRY", "\n");
          text = without(text, "__CATCH", "__ENDTRY;");
        } else {
          text = without(text, "WHILE", "End_WHILE;");
        }
        return Read(path, std::move(text), pair.semantics, pou);
      };
      const std::string name = pair.drawing.substr(pair.drawing.rfind('/') + 1);
      results[name + " " + pou] =
          compare(plain(pair.drawing), plain(pair.text));
    }
  }
  const std::map<std::string, std::string> expected = {
      {"leg_fault_code_sleg_LE_GE2.xml PLC1", "equivalent"},
      {"leg_fault_code_sleg_LE_GE2.xml PLC2", "different"},
      {"leg_fault_code_sleg_LE_GE2.xml PLC3", "equivalent"},
      {"mal_fault_code_smal_LE_GE2.xml PLC1", "equivalent"},
      {"mal_fault_code_smal_LE_GE2.xml PLC2", "different"},
      {"mal_fault_code_smal_LE_GE2.xml PLC3", "equivalent"},
      {"mal_timer_smal_GE3_1.xml PLC1", "equivalent"},
      {"mal_timer_smal_GE3_1.xml PLC2", "equivalent"},
      {"mal_timer_smal_GE3_1.xml PLC3", "equivalent"},
  };
  EXPECT_EQ(results, expected);
}

// Under the other order most drawings whose statements stand in another order
// are other programs, and a run shows it.
TEST(PlcopenCorpus, TheOrderMatters) {
  if (!has_corpus()) GTEST_SKIP() << "no " << kRoot;
  Counts counts;
  for (Pair pair : pairs()) {
    const std::string sibling =
        pair.text.substr(0, pair.text.rfind("-order.st") - 3) + "pos-order.st";
    if (!pair.text.ends_with("doc-order.st") ||
        !std::filesystem::exists(kRoot + sibling)) {
      continue;
    }
    pair.semantics = "beremiz-py2";
    for (const std::string& pou : programs_of(pair.text)) {
      const std::string result = compare(pair, pou);
      show(pair, pou + ": " + result);
      ++counts[result];
    }
  }
  EXPECT_EQ(counts,
            (Counts{{"different", 5}, {"equivalent", 2}, {"refused", 12}}));
}

/// In the words of ESBMC: what its properties are, under one semantics.
std::string esbmc_verdict(const std::string& path, std::string_view semantics) {
  Read one(path, semantics);
  const std::string props = path.substr(0, path.rfind('/')) + "/props.yaml";
  const YamlProperties lines = read_properties_yaml(text_of(props));
  if (!lines.error.empty()) return lines.error;
  std::istringstream each(lines.lines);
  for (std::string line; std::getline(each, line);) {
    if (!line.empty()) one.say(line);
  }
  if (!one.read) return one.outcome().substr(0, 5);
  one.program = build_program(one.ast, {}, one.list);
  const PropertySet set =
      read_properties(one.program, {}, one.sources, one.list);
  if (one.list.has_errors()) return one.list.items().front().message;
  const VerifyReport report = verify(one.program, set, {});
  if (!report.failures.empty()) return report.failures.front().what;
  const std::string doubt = unconfirmed(one.program, set, report);
  if (!doubt.empty()) return doubt;
  std::string verdict = "SAFE";
  for (const ObligationResult& result : report.results) {
    if (result.obligation.built_in) continue;
    // A state that is reached is a violation there.
    const bool reach = result.obligation.goal == Goal::Reach;
    const Verdict good = reach ? Verdict::Violated : Verdict::Proved;
    const Verdict bad = reach ? Verdict::Proved : Verdict::Violated;
    if (result.verdict == bad) return "VIOLATED";
    if (result.verdict != good) verdict = "UNKNOWN " + result.reason;
  }
  return verdict;
}

std::map<std::string, std::string> esbmc_verdicts() {
  std::map<std::string, std::string> verdicts;
  for (const std::string& path : all_files(".xml")) {
    if (path.find("/esbmc_regression/") == std::string::npos) continue;
    const std::string folder = path.substr(0, path.rfind('/'));
    verdicts[folder.substr(folder.rfind('/') + 1)] =
        esbmc_verdict(path, "esbmc");
  }
  return verdicts;
}

TEST(PlcopenCorpus, GivesTheVerdictsOfEsbmc) {
  if (!has_corpus()) GTEST_SKIP() << "no " << kRoot;
  const std::map<std::string, std::string> expected = {
      {"counter_counts_fail", "VIOLATED"},
      {"edge_falling_fail", "VIOLATED"},
      {"esd_manual_reset_fail", "VIOLATED"},
      {"graphical_contact_driven_safe", "SAFE"},
      {"graphical_set_latch_fail", "VIOLATED"},
      {"graphical_set_reset_order_safe", "SAFE"},
      {"graphical_wide_network_fail", "VIOLATED"},
      {"reachability_unsafe", "VIOLATED"},
      {"stairs_light_hold_fail", "VIOLATED"},
      // The switch of ESBMC that injects faults: the program itself is safe.
      {"fault_injection_unsafe", "SAFE"},
      // Refused: a divisor that may be 0, presets that count scans, a counter
      // beyond its type, REAL, loops.
      {"arithmetic_div_unsafe", "RP049"},
      {"conveyor_sequencing_safe", "RP045"},
      {"counter_saturate_at_max", "RP043"},
      {"function_blocks_safe", "RP045"},
      {"graphical_timer_path_fail", "RP045"},
      {"userfb_real_arith_fail", "RP041"},
      {"userfb_real_arith_safe", "RP041"},
      {"userfb_watchdog_fail", "RP041"},
      {"userfb_watchdog_safe", "RP041"},
  };
  EXPECT_EQ(esbmc_verdicts(), expected);
}

}  // namespace
}  // namespace rung
