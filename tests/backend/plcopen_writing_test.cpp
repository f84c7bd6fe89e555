// Ladder diagrams in XML: the schema, the geometry, and what they mean to
// other tools than the one whose meaning is proved.

#include <gtest/gtest.h>
#include <libxml/parser.h>
#include <libxml/xmlschemas.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "backend/plcopen/write.h"
#include "frontend/recognise.h"
#include "lowering.h"

namespace rung {
namespace {

using pugi::xml_node;

const WrittenLanguage kPlcopen = {"plcopen", lower_to_plcopen};

std::string written(const std::string& text,
                    const std::string& from = "script") {
  const auto source = read_program(from, "", text, "folder/test.rung");
  EXPECT_EQ(source->error, "");
  if (!source->error.empty()) return source->error;
  const Lowered lowered = lower(kPlcopen, *source);
  if (!lowered.written) return lowered.refused;
  EXPECT_EQ(validate(kPlcopen, *source, *lowered.written), "")
      << lowered.written->text;
  return lowered.written->text;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// All kinds of rungs: conditions, words, blocks that are not always executed.
constexpr const char* kList =
    "PROGRAM p\nVAR_INPUT a, b : BOOL; n : INT; END_VAR\n"
    "VAR_OUTPUT q, m : BOOL; END_VAR\n"
    "VAR t : TON; u : TP; c : CTU; d : CTD; e : R_TRIG; f : F_TRIG; l : SR;\n"
    "  k : RS; v : INT := 7; w : BOOL := TRUE; END_VAR\n"
    "  LD a\n  JMPCN over\n  CAL t(IN := b, PT := T#3s)\n  LD n\n  ADD v\n"
    "  MUL 3\n  SUB 2\n  DIV 2\n  ST v\nover: CAL c(CU := b, R := a, PV := 7)\n"
    "  LD c.Q\n  ST q\n  CAL e(CLK := q)\n  LD e.Q\n  S m\n  LD t.Q\n  R m\n"
    "  CAL l(S1 := a, R := m)\n  LD l.Q1\n  ST q\n  CAL u(IN := q, PT := "
    "T#1s)\n"
    "  LD n\n  GT v\n  AND u.Q\n  ST w\n  CAL d(CD := w, LD := b, PV := n)\n"
    "  CAL f(CLK := d.Q)\n  CAL k(S := f.Q, R1 := a)\n  LD k.Q1\n  OR w\n"
    "  ANDN q\n  ST q\nEND_PROGRAM\n";

std::vector<std::string> samples() {
  std::vector<std::string> texts = {written(kList, "il-iec")};
  for (const auto& [name, text] : corpus()) {
    const auto source = read_program("script", "", text, name);
    Lowered lowered = lower(kPlcopen, *source);
    if (lowered.written) texts.push_back(std::move(lowered.written->text));
  }
  return texts;
}

// --- the schema --------------------------------------------------------------

TEST(WritingPlcopen, FollowsTheSchema) {
  // Beside the checkout, where there is one: it is not ours to copy.
  const std::string path =
      RUNG_SOURCE_DIR "/../shared/corpus/schema/tc6_xml_v201.xsd";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "there is no schema";
  const std::unique_ptr<xmlSchemaParserCtxt, void (*)(xmlSchemaParserCtxt*)>
      parser(xmlSchemaNewParserCtxt(path.c_str()), xmlSchemaFreeParserCtxt);
  const std::unique_ptr<xmlSchema, void (*)(xmlSchema*)> schema(
      xmlSchemaParse(parser.get()), xmlSchemaFree);
  ASSERT_TRUE(schema);
  const auto valid = [&](const std::string& text) {
    const std::unique_ptr<xmlDoc, void (*)(xmlDoc*)> document(
        xmlReadMemory(text.data(), static_cast<int>(text.size()), "written",
                      nullptr, XML_PARSE_NONET),
        xmlFreeDoc);
    const std::unique_ptr<xmlSchemaValidCtxt, void (*)(xmlSchemaValidCtxt*)>
        validation(xmlSchemaNewValidCtxt(schema.get()), xmlSchemaFreeValidCtxt);
    return document != nullptr &&
           xmlSchemaValidateDoc(validation.get(), document.get()) == 0;
  };
  std::vector<std::string> texts = samples();
  for (const std::string& text : texts) ASSERT_TRUE(valid(text)) << text;
  // It would be noticed.
  std::string& text = texts[0];
  text.replace(text.find("localId"), 7, "localID");
  EXPECT_FALSE(valid(text));
}

// --- the geometry ------------------------------------------------------------

using Point = std::pair<int, int>;
Point point_of(xml_node node) {
  return {node.attribute("x").as_int(), node.attribute("y").as_int()};
}
Point sum(Point a, Point b) { return {a.first + b.first, a.second + b.second}; }

struct Pins {
  std::set<Point> outputs;
  // By name, of a block.
  std::map<std::string, Point> named;
};

/// What is wrong with the geometry of a drawing; empty: nothing.
std::string wrong_geometry(const std::string& text) {
  pugi::xml_document document;
  if (!document.load_string(text.c_str())) return "no XML";
  const xml_node body =
      document.select_node("/project/types/pous/pou/body/LD").node();
  std::map<std::string, Pins> pins;
  std::vector<std::pair<Point, Point>> boxes;
  for (const xml_node element : body) {
    const std::string id = element.attribute("localId").value();
    if (pins.contains(id)) return "two elements " + id;
    const Point at = point_of(element.child("position"));
    const Point size = {element.attribute("width").as_int(),
                        element.attribute("height").as_int()};
    boxes.emplace_back(at, sum(at, size));
    Pins& own = pins[id];
    for (const auto& out : element.select_nodes(".//connectionPointOut")) {
      const Point pin = sum(at, point_of(out.node().child("relPosition")));
      own.outputs.insert(pin);
      own.named[out.node().parent().attribute("formalParameter").value()] = pin;
      if (pin.first != at.first + size.first || pin.second < at.second ||
          pin.second > at.second + size.second) {
        return "an output of " + id + " is not at its right side";
      }
    }
  }
  for (const xml_node element : body) {
    const Point at = point_of(element.child("position"));
    for (const auto& found : element.select_nodes(".//connection")) {
      const xml_node wire = found.node();
      const std::string where =
          std::string(" of ") + element.attribute("localId").value();
      std::vector<Point> corners;
      for (const xml_node one : wire.children("position")) {
        corners.push_back(point_of(one));
      }
      const Pins& source = pins[wire.attribute("refLocalId").value()];
      const Point input = sum(at, point_of(wire.parent().child("relPosition")));
      if (corners.size() < 2 || corners.front() != input ||
          !source.outputs.contains(corners.back())) {
        return "a wire" + where + " does not go from pin to pin";
      }
      const std::string pin = wire.attribute("formalParameter").value();
      if (!pin.empty() && source.named.at(pin) != corners.back()) {
        return "a wire" + where + " begins at another pin";
      }
      for (std::size_t i = 1; i < corners.size(); ++i) {
        if (corners[i].first != corners[i - 1].first &&
            corners[i].second != corners[i - 1].second) {
          return "a wire" + where + " is not square";
        }
        if (corners[i].first > corners[i - 1].first) {
          return "a wire" + where + " goes back";
        }
      }
    }
  }
  std::sort(boxes.begin(), boxes.end());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = i + 1; k < boxes.size(); ++k) {
      if (boxes[k].first.first >= boxes[i].second.first) break;
      if (boxes[k].first.second < boxes[i].second.second &&
          boxes[i].first.second < boxes[k].second.second) {
        return "two elements overlap";
      }
    }
  }
  return {};
}

// Some editors take the wires from their ends, and crash where there are none.
TEST(WritingPlcopen, HasAllOfTheGeometry) {
  for (const std::string& text : samples()) {
    EXPECT_EQ(wrong_geometry(text), "") << text;
  }
}

TEST(WritingPlcopen, GeometryThatIsWrongIsNoticed) {
  std::string text = written("Q0 = (I0 || I2) && !I1;\n");
  const std::size_t at = text.find("<position x=\"230\"");
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, 17, "<position x=\"235\"");
  EXPECT_NE(wrong_geometry(text), "");
}

// Each end of one part has a wire to each beginning of the next: there are
// bits between parts that have many.
TEST(WritingPlcopen, IsLinearInTheProgram) {
  std::string left;
  std::string right;
  for (int i = 0; i < 300; ++i) {
    left += (i == 0 ? "I" : " || I") + std::to_string(i);
    right += (i == 0 ? "I" : " || I") + std::to_string(i + 300);
  }
  const std::string text = written("Q0 = (" + left + ") && (" + right + ");\n");
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 30'000);
  EXPECT_EQ(wrong_geometry(text), "");
}

// --- what it means -----------------------------------------------------------

/// The rungs that are read under a preset of semantics, as text.
std::string read_under(const std::string& preset, const std::string& text) {
  SourceSet sources;
  const FileId file = sources.add("test", text);
  ReadOptions options;
  options.semantics = find_semantics(preset);
  DiagnosticList found;
  const Ast ast = find_language("plcopen")->read(sources, file, options, found);
  EXPECT_FALSE(found.has_errors());
  const auto program = build_program(ast, {}, found);
  EXPECT_FALSE(found.has_errors());
  std::string rungs;
  for (const Rung& rung : program.rungs) {
    rungs += program.cells[rung.target].name + " :=";
    for (std::uint32_t at = rung.begin; at < rung.end; ++at) {
      const Node& node = program.nodes[at];
      rungs += ' ' + std::to_string(static_cast<int>(node.op));
      if (node.op == NodeOp::Read) rungs += program.cells[node.cell].name;
      if (node.op == NodeOp::Constant) rungs += std::to_string(node.value);
      if (node.op != NodeOp::Call) continue;
      const ElementCall& call = program.calls[node.call];
      rungs += program.instances[call.instance].name;
      rungs += call.operation->name;
    }
    rungs += '\n';
  }
  return rungs;
}

// Coils as they stand in the file, by position, or network by network: it is
// the same order.
TEST(WritingPlcopen, MeansTheSameInEveryOrder) {
  for (const std::string& text : samples()) {
    const std::string rungs = read_under("openplc", text);
    EXPECT_EQ(read_under("beremiz-py2", text), rungs) << text;
    EXPECT_EQ(std::count(rungs.begin(), rungs.end(), '\n') > 0, true);
  }
}

TEST(WritingPlcopen, ConditionsAreCoilsThatSetAndBoxesWithEnable) {
  const std::string text = written(kList, "il-iec");
  EXPECT_TRUE(contains(text, "storage=\"set\"")) << text;
  EXPECT_TRUE(contains(text, "formalParameter=\"EN\"")) << text;
  EXPECT_TRUE(contains(text, "typeName=\"DIV\"")) << text;
  EXPECT_TRUE(contains(text, "<simpleValue value=\"7\" />")) << text;
}

TEST(WritingPlcopen, ReadsWhatItWrote) {
  const std::string once = written(kList, "il-iec");
  const std::string twice = written(once, "plcopen");
  EXPECT_TRUE(contains(twice, "instanceName=\"t\"")) << twice;
}

TEST(WritingPlcopen, TheTaskTakesTheScan) {
  const auto interval = [](const std::string& scan) {
    const std::string text = written("//@ scan " + scan + "\nQ0 = I0;\n");
    const std::size_t at = text.find("interval=\"") + 10;
    return text.substr(at, text.find('"', at) - at);
  };
  EXPECT_EQ(interval("7 ms"), "T#7ms");
  EXPECT_EQ(interval("1..100 ms"), "T#20ms");
  EXPECT_EQ(interval("1..9 ms"), "T#9ms");
  EXPECT_EQ(interval("30..90 ms"), "T#30ms");
}

TEST(WritingPlcopen, PropertyLinesAndCommentsGoAlong) {
  const std::string text = written(
      "// \x40 a]]>b & <c>\n//@ input IW0 in 0..50\n//@ R: never Q0 && s\n"
      "//@ always T(0).q -> I0\n// //@ R: never I0\n"
      "s = T(0, 1, I0); Q0 = IW0 > 20 && s; // (*@ always I0 *)\n");
  const auto back = read_program("plcopen", "", text);
  ASSERT_EQ(back->error, "");
  std::vector<std::string> lines;
  for (const AstAnnotation& one : back->program.annotations) {
    lines.emplace_back(one.text);
  }
  EXPECT_EQ(lines, (std::vector<std::string>{"input IW0 in 0..50",
                                             "R: never Q0 && s_1"}))
      << text;
  EXPECT_TRUE(contains(text, "of the source: always T(0).q -> I0")) << text;
}

// --- refusals ----------------------------------------------------------------

TEST(WritingPlcopen, RefusesWhatItCannotExpress) {
  const auto refused = [](const std::string& text, const std::string& from,
                          const char* words) {
    const std::string said = written(text, from);
    EXPECT_TRUE(contains(said, "RP084 ") && contains(said, words)) << said;
  };
  refused("//@ scan 5 ms\n", "script", "a coil at least");
  refused("N = N + 1; Q0 = N > 3;\n", "script", "`N` may leave");
  refused("Q0 = C(0, 3, I0, I1, false);\n", "script", "counts down");
  const auto block = [](const std::string& type, const std::string& body) {
    return "PROGRAM p\nVAR_INPUT a, b : BOOL; n : INT; END_VAR\n"
           "VAR_OUTPUT q : BOOL; END_VAR\nVAR x : " +
           type + "; END_VAR\n" + body + "END_PROGRAM\n";
  };
  refused(block("CTU", "x(CU := a, R := b, PV := 7); q := x.CV > 9;\n"), "st",
          "one of the two counters stops");
  refused(block("CTU", "x(CU := a, R := b, PV := n); q := x.Q;\n"), "st",
          "its PV is not constant");
  refused(block("CTUD", "x(CU := a, CD := b, PV := 7); q := x.QU;\n"), "st",
          "no standard function block");
  refused(block("TON", "x(IN := a, PT := T#2s); q := x.ET > T#1s;\n"), "st",
          "its elapsed time is a TIME");
  refused(block("TON",
                "x(IN := a, PT := T#2s); x(IN := b, PT := T#3s);\n"
                "q := x.Q;\n"),
          "st", "several presets");
}

// The standard's timers do not wait for a preset of 0, and matiec's do.
TEST(WritingPlcopen, TimersWithoutADelayAreNoBlocks) {
  const std::string text = written(
      "PROGRAM p\nVAR_INPUT a, b, c : BOOL; END_VAR\n"
      "VAR_OUTPUT q, r, s : BOOL; END_VAR\nVAR x : TON; y : TOF; z : TP;\n"
      "END_VAR\nx(IN := a, PT := T#0s); q := x.Q; y(IN := b, PT := T#0s);\n"
      "r := y.Q AND NOT x.Q; z(IN := c, PT := T#0s); s := z.Q OR q;\n"
      "END_PROGRAM\n",
      "st");
  EXPECT_FALSE(contains(text, "<block")) << text;
}

// The other way: what a drawing for OpenPLC has is written as text.
TEST(WritingPlcopen, BlocksOfDrawingsAreThoseOfTheStandard) {
  const auto source =
      read_program("plcopen", "", written(kList, "il-iec"), "test");
  ASSERT_EQ(source->error, "");
  for (const WrittenLanguage& language : written_languages()) {
    if (language.name != "st" && language.name != "il-iec") continue;
    const Lowered lowered = lower(language, *source);
    ASSERT_TRUE(lowered.written) << lowered.refused;
    EXPECT_EQ(validate(language, *source, *lowered.written), "")
        << lowered.written->text;
  }
}

}  // namespace
}  // namespace rung
