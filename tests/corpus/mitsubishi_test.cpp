// Lists of others, beside the repository and no part of it: they do what their
// manifest says, proved.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/property.h"
#include "confirm.h"
#include "frontend/il_mitsubishi/reader.h"
#include "smt/verify.h"

namespace rung {
namespace {

struct Claim {
  std::string_view file;
  std::string_view property;
  std::string_view verdict;
};

class Verdict {
 public:
  Verdict(const std::string& text, std::string_view property) {
    SourceSet sources;
    DiagnosticList list;
    const FileId file = sources.add("list.il", text);
    const FileId props = sources.add("props", std::string(property));
    Program program =
        build_program(read_il_mitsubishi(sources, file, list), {}, list);
    const std::string_view line = sources[props].text();
    const AstAnnotation extra = {
        line, {props, 0, static_cast<std::uint32_t>(line.size())}};
    if (!list.has_errors()) {
      const PropertySet set = read_properties(program, {extra}, sources, list);
      if (!list.has_errors()) prove(program, set);
    }
    for (const Diagnostic& item : list.items()) text_ += item.message;
  }
  const std::string& text() const { return text_; }

 private:
  void prove(const Program& program, const PropertySet& set) {
    const VerifyReport report = verify(program, set, {});
    for (const ObligationResult& result : report.results) {
      if (!result.obligation.built_in) text_ = to_string(result.verdict);
    }
    if (!report.failures.empty()) text_ = report.failures.front().what;
    const std::string doubt = unconfirmed(program, set, report);
    if (!doubt.empty()) text_ = doubt;
  }

  std::string text_;
};

TEST(MitsubishiCorpus, DoesWhatItsManifestSays) {
  const std::string root = RUNG_SOURCE_DIR "/../shared/corpus/il_mitsubishi/";
  if (!std::filesystem::exists(root)) GTEST_SKIP() << "no " << root;
  const std::vector<Claim> claims = {
      {"simple_logic.il", "always Y0 == X0 && Y1 == !X1", "proved"},
      {"simple_logic.il", "always Y2 == (X0 && X1)", "proved"},
      {"simple_logic.il", "always Y3 == (X0 || X1)", "proved"},
      {"complex_logic.il", "always Y0 == ((X0 && X1) || X2 || X3)", "proved"},
      {"complex_logic.il", "always Y1 == ((X0 || X1) && X2 && X3)", "proved"},
      {"set_reset.il", "always X1 -> !M0 && !Y0", "proved"},
      {"set_reset.il", "always X0 && !X1 -> M0 && Y0", "proved"},
      {"set_reset.il", "always !X0 && !X1 -> (M0 <-> prev(M0))", "proved"},
      {"set_reset.il", "always (Y0 <-> M0) && (Y1 <-> L0)", "proved"},
      // OUTI M10 fights SET M10: the latch holds nothing, and red stays on for
      // a scan behind X0.
      {"traffic_light.il", "always M10 == !X0", "proved"},
      {"traffic_light.il", "always X0 -> M10", "violated"},
      {"traffic_light.il", "always Y0 == (X0 || prev(M10))", "proved"},
      {"traffic_light.il", "never Y1 && Y2", "proved"},
      {"traffic_light.il", "always Y0 -> M10", "violated"},
  };
  for (const Claim& claim : claims) {
    const std::ifstream in(root + std::string(claim.file), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    EXPECT_EQ(Verdict(text.str(), claim.property).text(), claim.verdict)
        << claim.file << ": " << claim.property;
  }
}

TEST(MitsubishiCorpus, IsReadWhole) {
  const std::string root = RUNG_SOURCE_DIR "/../shared/corpus/il_mitsubishi/";
  if (!std::filesystem::exists(root)) GTEST_SKIP() << "no " << root;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    const std::ifstream in(entry.path(), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    ++files;
    EXPECT_EQ(Verdict(text.str(), "reach true").text(), "proved")
        << entry.path();
    EXPECT_TRUE(is_il_mitsubishi(text.str())) << entry.path();
  }
  EXPECT_EQ(files, 4);
}

}  // namespace
}  // namespace rung
