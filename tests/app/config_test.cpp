// rungproof.toml: what is refused, that `config show` prints what holds, and
// that its schema has the keys and rules that the program has.

#include "app/config.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/sandbox.h"
#include "tests/reports/sections.h"

namespace rung::test {
namespace {

using Json = nlohmann::ordered_json;

struct BadConfig {
  const char* text;
  const char* said;  // behind the path
};

constexpr BadConfig kBad[] = {
    {"[rules\n", "1:7: "},
    {"a = \n", "1:5: "},
    {"[check]\nscan = \"1..5\"\nscan = \"1..6\"\n", "3:8: "},
    {"\xff\n", "1:1: "},
    {"[rules]\ndouble-coil = \"off", "2:19: "},
    {"rule = 1\n", "1:1: there is no key `rule` (did you mean `rules`?)"},
    {"rules = 1\n", "1:9: `rules` is to be a table, `[rules]`"},
    {"rules = []\n", "1:9: `rules` is to be a table, `[rules]`"},
    {"[[check]]\n", "1:1: `check` is to be a table, `[check]`"},
    {"baseline = 5\n", "1:12: `baseline` is to be a text in quotes"},
    {"baseline = \"\"\n", "1:12: `baseline` names no file"},
    {"exclude = \"a\"\n", "1:11: `exclude` is to be a list of texts"},
    {"exclude = [\"a\", 1]\n", "1:17: `exclude` is to be a text in quotes"},
    {"[check]\nscans = \"1..5\"\n",
     "2:1: there is no key `scans` in [check] (did you mean `scan`?)"},
    {"[check]\nscan = 5\n", "2:8: `scan` is to be a text in quotes"},
    {"[check]\nscan = \"5\"\n", "2:8: scan: `5` is not MIN..MAX"},
    {"[check]\nscan = \"0..5\"\n", "2:8: scan: `0..5` is not MIN..MAX"},
    {"[check]\nsemantics = \"codesys\"\n",
     "2:13: semantics: `codesys` is not one of yun, sim"},
    {"[check]\ndialect = \"fbd\"\n", "2:11: dialect: `fbd` is not one of"},
    {"[check]\ndialect = \"\"\n", "2:11: `dialect` is to be not empty"},
    {"[check]\nengine = \"magic\"\n", "2:10: engine: `magic` is not one of"},
    {"[check]\nfail-on = \"never\"\n", "2:11: fail-on: `never` is not one of"},
    {"[check]\nrecheck = \"yices\"\n", "2:11: recheck: `yices` is not"},
    {"[check]\nrollover = \"on\"\n", "2:12: `rollover` is to be true or false"},
    {"[check]\nstable-inputs = 1\n",
     "2:17: `stable-inputs` is to be true or false"},
    {"[check]\ntimeout = \"5\"\n", "2:11: `timeout` is to be a number"},
    {"[check]\ntimeout = 0\n", "2:11: timeout: `0` is not a number of seconds"},
    {"[check]\ntimeout = -1.5\n", "2:11: timeout: `-1.5` is not a number"},
    {"[check]\ntimeout = nan\n", "2:11: timeout: `nan` is not a number"},
    {"[check]\ntimeout = inf\n", "2:11: timeout: `inf` is not a number"},
    {"[rules]\npacks = \"safety\"\n", "2:9: `packs` is to be a list of texts"},
    {"[rules]\npacks = [\"extra\"]\n",
     "2:10: packs: `extra` is not one of default, safety, pedantic"},
    {"[rules]\npacks = [1]\n", "2:10: `packs` is to be a text in quotes"},
    {"[rules]\ndouble-coli = \"off\"\n",
     "2:1: rules: there is no rule `double-coli` (did you mean "
     "`double-coil`?)"},
    {"[rules]\nRP999 = \"off\"\n", "2:1: rules: there is no rule `RP999`"},
    {"[rules]\ndouble-coil = true\n",
     "2:15: `double-coil` is to be a text in quotes"},
    {"[rules]\ndouble-coil = \"fatal\"\n",
     "2:15: double-coil: `fatal` is not one of off, note, warning, error"},
    {"[rules]\nRP101 = \"off\"\ndouble-coil = \"note\"\n",
     "3:1: `RP101` and `double-coil` are one rule"},
};

/// Why the text is refused; empty when it is not.
std::string refusal(const std::string& text) {
  const auto config = read_config("x.toml", text);
  const std::string* const why = std::get_if<std::string>(&config);
  return why == nullptr ? "" : *why;
}

TEST(Config, WhatIsWrongIsAnErrorWithItsPlace) {
  EXPECT_EQ(refusal(""), "");
  for (const BadConfig& bad : kBad) {
    const std::string why = refusal(bad.text);
    EXPECT_TRUE(why.starts_with(std::string("x.toml:") + bad.said))
        << bad.text << why;
  }
}

TEST(Config, NestedAndLongTextsAreRefused) {
  for (const char bracket : {'[', '{'}) {
    EXPECT_NE(refusal("exclude = " + std::string(200'000, bracket)), "");
  }
  EXPECT_EQ(refusal(std::string(2'000'000, '\n')),
            "x.toml:1:1: the configuration is larger than 1 MiB");
}

/// The keys and values that `config show` prints; its remarks apart.
std::map<std::string, std::string> shown(const Sandbox& sandbox,
                                         const std::string& options) {
  EXPECT_EQ(sandbox.run("rungproof config show a.rung " + options), 0)
      << sandbox.err();
  std::map<std::string, std::string> values;
  std::string table;
  for (const std::string& line : lines_of(sandbox.out())) {
    if (line.starts_with("[")) table = line;
    const std::size_t equals = line.find(" = ");
    if (line.starts_with("#") || equals == std::string::npos) continue;
    const std::size_t remark = line.rfind(" # ");
    values[table + line.substr(0, equals)] =
        line.substr(equals, remark - equals);
  }
  return values;
}

TEST(Config, WhatIsShownIsAConfigurationThatSaysTheSame) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "rungproof.toml",
             "baseline = \"known \\\"x\\\".json\"\nexclude = [\"a\\\\b\"]\n"
             "[check]\nscan = \"2..7ms\"\nrollover = true\nfail-on = \"note\"\n"
             "timeout = 1.5\nsemantics = \"sim\"\npou = \"main\"\n"
             "[rules]\npacks = [\"pedantic\"]\nRP101 = \"error\"\n"
             "unused-input = \"off\"\n");
  const auto before = shown(sandbox, "--timeout 9");
  EXPECT_GT(before.size(), 50U);
  EXPECT_EQ(before.at("[check]timeout").substr(0, 4), " = 9");
  EXPECT_EQ(before.at("[rules]double-coil").substr(0, 10), " = \"error\"");
  EXPECT_EQ(sandbox.run("rungproof config show a.rung --timeout 9"), 0);
  write_text(sandbox.path() / "rungproof.toml", sandbox.out());
  EXPECT_EQ(shown(sandbox, ""), before);
}

/// Name to code of every rule.
std::map<std::string, std::string> rules(const Sandbox& sandbox) {
  EXPECT_EQ(sandbox.run("rungproof rule"), 0);
  std::map<std::string, std::string> codes;
  for (const std::string& line : lines_of(sandbox.out())) {
    std::istringstream words(line);
    std::string code;
    std::string name;
    words >> code;
    while (words >> name) {
    }
    codes[name] = code;
  }
  return codes;
}

/// The schema with the rules that the program has.
Json with_rules(Json schema, const std::map<std::string, std::string>& codes) {
  Json& table = schema["properties"]["rules"];
  Json properties = {{"packs", table["properties"]["packs"]}};
  std::vector<std::string> sorted;
  for (const auto& [name, code] : codes) {
    properties[name] = {{"$ref", "#/definitions/severity"}};
    sorted.push_back(code);
  }
  std::sort(sorted.begin(), sorted.end());
  std::string pattern;
  for (const std::string& code : sorted) {
    pattern += (pattern.empty() ? "" : "|") + code;
  }
  table["properties"] = properties;
  table["patternProperties"] = {
      {"^(" + pattern + ")$", {{"$ref", "#/definitions/severity"}}}};
  return schema;
}

TEST(Config, TheSchemaHasTheKeysAndRulesOfTheProgram) {
  const Sandbox sandbox;
  const std::string path = RUNG_ROOT "/docs/rungproof.schema.json";
  const std::string text = read_text(path);
  const Json schema = Json::parse(text);
  const std::string now = with_rules(schema, rules(sandbox)).dump(2) + "\n";
  if (is_update()) {
    std::ofstream(path, std::ios::binary) << now;
  } else {
    EXPECT_EQ(text, now) << "RUNG_UPDATE=1 rewrites the rules in it";
  }
  EXPECT_EQ(sandbox.run("rungproof config show --no-config"), 0);
  std::map<std::string, int> keys;  // 1: shown, 2: in the schema
  std::string table;
  for (std::string line : lines_of(sandbox.out())) {
    if (line.starts_with("[")) table = line;
    if (line.starts_with("# ") && line.find(" = ") == std::string::npos) {
      line.erase(0, 2);
    }
    const std::string key = line.substr(0, line.find(' '));
    const bool is_key = !line.starts_with("[") && !key.empty() && key != "no";
    if (is_key && table != "[rules]") keys[table + key] |= 1;
  }
  for (const auto& [key, value] : schema["properties"].items()) {
    if (key != "check" && key != "rules") keys[key] |= 2;
  }
  for (const auto& [key, value] :
       schema["properties"]["check"]["properties"].items()) {
    keys["[check]" + key] |= 2;
  }
  EXPECT_GE(keys.size(), 13U);
  for (const auto& [key, where] : keys) EXPECT_EQ(where, 3) << key;
}

}  // namespace
}  // namespace rung::test
