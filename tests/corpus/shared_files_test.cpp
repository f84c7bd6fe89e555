// Every program of others: read whole, or refused by the reader that it is for.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "analysis/program.h"
#include "frontend/recognise.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

const fs::path kCorpus = RUNG_SOURCE_DIR "/../shared/corpus";

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// "plclib: read", or the code of the first error.
std::string outcome_of(const fs::path& path) {
  if (path.extension() == ".yaml") return "properties";
  SourceSet sources;
  DiagnosticList found;
  const std::string text = text_of(path);
  const FileId file = sources.add(path.string(), text);
  const Language& language = recognise(text);
  std::string name(language.name);
  if (!language.supported()) return name + ": not read";
  const Ast ast = language.read(sources, file, {}, found);
  if (!found.has_errors()) build_program(ast, {}, found);
  for (const Diagnostic& item : found.items()) {
    if (item.severity != Severity::Error) continue;
    return name + ": " + std::string(item.code);
  }
  return name + ": read";
}

using Counts = std::map<std::string, int>;
const std::map<std::string, Counts> kExpected = {
    {"ascii_ladder",
     {{"ascii: read", 16}, {"ascii: RP087", 1}, {"ascii: RP089", 1}}},
    {"classicladder", {{"classicladder: not read", 8}}},
    {"il_iec",
     {{"il-iec: read", 1},
      {"il-iec: RP041", 4},
      {"il-iec: RP047", 1},
      {"st: read", 1},
      {"st: RP041", 6}}},  // of which five are companions
    {"il_mitsubishi", {{"il-mitsubishi: read", 4}}},
    {"l5x",
     {{"l5x: read", 10},
      {"l5x: RP052", 6},
      {"l5x: RP054", 1},
      {"l5x: RP087", 10},
      {"l5x: RP088", 1},
      {"il-iec: RP040", 1}}},  // a table of the rungs of the others
    {"ldmicro_ld",
     {{"ldmicro: read", 9},
      {"ldmicro: RP001", 1},
      {"ldmicro: RP087", 6},
      {"script: RP003", 3}}},  // machine code in hexadecimal
    {"plclib",
     {{"plclib: read", 35},
      {"plclib: RP055", 7},
      {"plclib: RP056", 1},
      {"plclib: RP059", 1}}},
    {"plcopen_ld",
     {{"plcopen: read", 28},
      {"plcopen: RP041", 38},
      {"plcopen: RP043", 1},
      {"plcopen: RP045", 3},
      {"plcopen: RP049", 1},
      {"plcopen: RP094", 2},
      {"plcopen: RP098", 1},
      {"plcopen: RP100", 15},
      {"st: read", 29},
      {"st: RP041", 30},
      {"st: RP042", 3},
      {"st: RP100", 24},
      {"properties", 18}}},
    {"schema", {{"plcopen: RP094", 1}}},  // an XML schema is no project
    {"stl_siemens",
     {{"stl: read", 4},
      {"stl: RP001", 3},
      {"stl: RP040", 11},
      {"stl: RP041", 23},
      {"stl: RP042", 1},
      {"stl: RP044", 1},
      {"st: RP001", 1},         // not UTF-8
      {"plcopen: RP094", 8}}},  // projects of awlsim, in XML
    {"vovkplc",
     {{"vovkplc: not read", 22},
      {"plcscript: not read", 8},
      {"json: not read", 28},
      {"stl: RP044", 6},       // its lists have other addresses
      {"script: RP003", 8}}},  // lists of tokens that a test looks for
};

TEST(SharedFiles, AreReadOrRefusedByTheirReader) {
  if (!fs::exists(kCorpus)) GTEST_SKIP() << "no " << kCorpus;
  std::map<std::string, Counts> counts;
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(kCorpus)) {
    if (!entry.is_regular_file()) continue;
    const fs::path path = fs::relative(entry.path(), kCorpus);
    if (!path.has_parent_path()) continue;  // the manifest and the notice
    files.insert(path.generic_string());
    ++counts[path.begin()->string()][outcome_of(entry.path())];
  }
  EXPECT_EQ(counts, kExpected);
  // Those of the manifest, and no others.
  std::ifstream manifest(kCorpus / "MANIFEST.tsv");
  std::set<std::string> listed;
  std::string line;
  std::getline(manifest, line);
  while (std::getline(manifest, line)) {
    listed.insert(line.substr(0, line.find('\t')));
  }
  EXPECT_EQ(files, listed);
}

}  // namespace
}  // namespace rung
