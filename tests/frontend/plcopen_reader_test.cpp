#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/program.h"
#include "dump.h"
#include "frontend/plcopen/reader.h"
#include "frontend/recognise.h"

namespace rung::test {
namespace {

struct Xml {
  explicit Xml(std::string text, std::string_view semantics = "openplc")
      : file(sources.add("plc.xml", std::move(text))) {
    ReadOptions options;
    options.semantics = find_semantics(semantics);
    ast = read_plcopen(sources, file, options, list);
    if (!list.has_errors()) program = build_program(ast, {}, list);
  }
  std::string rungs() const {
    std::string result;
    for (const AstAssignment& rung : ast.rungs) {
      result += (result.empty() ? "" : " | ") + std::string(rung.target) + "=" +
                dump(ast, rung.value);
    }
    return result;
  }
  std::string problems() const {
    std::string result;
    for (const Diagnostic& item : list.items()) {
      result += std::string(item.code) + "[" +
                std::string(sources.text(item.where)) + "] " + item.message +
                "\n";
    }
    return result;
  }
  std::string first_code() const {
    return list.items().empty() ? "none"
                                : std::string(list.items().front().code);
  }

  SourceSet sources;
  DiagnosticList list;
  FileId file;
  Ast ast;
  Program program;
};

std::string project(std::string_view pous, std::string_view after = "") {
  return "<project><types><dataTypes/><pous>" + std::string(pous) +
         "</pous></types>" + std::string(after) + "</project>";
}

std::string variables(std::string_view section, std::string_view names,
                      std::string_view type = "<BOOL/>") {
  std::string text = "<" + std::string(section) + ">";
  for (std::size_t at = 0; at < names.size();) {
    const std::size_t end = std::min(names.find(' ', at), names.size());
    text += "<variable name=\"" + std::string(names.substr(at, end - at)) +
            "\"><type>" + std::string(type) + "</type></variable>";
    at = end + 1;
  }
  return text + "</" + std::string(section) + ">";
}

const std::string& interface() {
  static const std::string text =
      "<interface>" + variables("inputVars", "a b c d") +
      variables("inputVars", "n", "<INT/>") + variables("outputVars", "q o p") +
      variables("outputVars", "w", "<INT/>") + variables("localVars", "m") +
      variables("localVars", "t", "<derived name=\"TON\"/>") +
      variables("localVars", "f", "<derived name=\"SR\"/>") + "</interface>";
  return text;
}

std::string program(std::string_view body) {
  return "<pou name=\"main\" pouType=\"program\">" + interface() + "<body>" +
         std::string(body) + "</body></pou>";
}

/// A drawing of one program.
std::string ld(std::string_view elements) {
  return project(program("<LD><leftPowerRail localId=\"1\"/>" +
                         std::string(elements) + "</LD>"));
}

/// `<connection>`s from elements: "2", "2 3", "5.Q".
std::string from(std::string_view sources) {
  std::string text = "<connectionPointIn>";
  for (std::size_t at = 0; at < sources.size();) {
    const std::size_t end = std::min(sources.find(' ', at), sources.size());
    const std::string_view one = sources.substr(at, end - at);
    const std::size_t dot = one.find('.');
    text +=
        "<connection refLocalId=\"" + std::string(one.substr(0, dot)) + "\"";
    if (dot != std::string_view::npos) {
      text += " formalParameter=\"" + std::string(one.substr(dot + 1)) + "\"";
    }
    text += "/>";
    at = end + 1;
  }
  return text + "</connectionPointIn>";
}

std::string relay(std::string_view kind, std::string_view id,
                  std::string_view variable, std::string_view sources,
                  std::string_view attributes = "", int y = 0) {
  return "<" + std::string(kind) + " localId=\"" + std::string(id) + "\" " +
         std::string(attributes) + "><position x=\"0\" y=\"" +
         std::to_string(y) + "\"/>" + from(sources) + "<variable>" +
         std::string(variable) + "</variable></" + std::string(kind) + ">";
}
std::string contact(std::string_view id, std::string_view variable,
                    std::string_view sources,
                    std::string_view attributes = "") {
  return relay("contact", id, variable, sources, attributes);
}
std::string coil(std::string_view id, std::string_view variable,
                 std::string_view sources, std::string_view attributes = "",
                 int y = 0) {
  return relay("coil", id, variable, sources, attributes, y);
}

std::string in_variable(std::string_view id, std::string_view expression) {
  return "<inVariable localId=\"" + std::string(id) + "\"><expression>" +
         std::string(expression) + "</expression></inVariable>";
}
std::string out_variable(std::string_view id, std::string_view expression,
                         std::string_view sources) {
  return "<outVariable localId=\"" + std::string(id) + "\">" + from(sources) +
         "<expression>" + std::string(expression) +
         "</expression></outVariable>";
}

std::string input(std::string_view name, std::string_view sources,
                  std::string_view attributes = "") {
  return "<variable formalParameter=\"" + std::string(name) + "\" " +
         std::string(attributes) + ">" + from(sources) + "</variable>";
}
std::string block(std::string_view id, std::string_view type,
                  std::string_view instance, std::string_view inputs,
                  std::string_view outputs, std::string_view attributes = "") {
  std::string text = "<block localId=\"" + std::string(id) + "\" typeName=\"" +
                     std::string(type) + "\" " + std::string(attributes);
  if (!instance.empty()) {
    text += " instanceName=\"" + std::string(instance) + "\"";
  }
  text += "><inputVariables>" + std::string(inputs) +
          "</inputVariables><inOutVariables/><outputVariables>";
  for (std::size_t at = 0; at < outputs.size();) {
    const std::size_t end = std::min(outputs.find(' ', at), outputs.size());
    text += "<variable formalParameter=\"" +
            std::string(outputs.substr(at, end - at)) +
            "\"><connectionPointOut/></variable>";
    at = end + 1;
  }
  return text + "</outputVariables></block>";
}

std::string rungs(const std::string& text,
                  std::string_view semantics = "openplc") {
  const Xml xml(text, semantics);
  return xml.list.has_errors() ? xml.problems() : xml.rungs();
}

TEST(PlcopenReader, ContactsInSeriesAreAnAnd) {
  EXPECT_EQ(rungs(ld(contact("2", "a", "1") + contact("3", "b", "2") +
                     coil("4", "q", "3"))),
            "q=(&& a b)");
}

TEST(PlcopenReader, WiresThatMeetAreAnOr) {
  EXPECT_EQ(rungs(ld(contact("2", "a", "1") + contact("3", "b", "1") +
                     contact("4", "c", "2 3", "negated=\"true\"") +
                     coil("5", "q", "4"))),
            "q=(&& (|| a b) (! c))");
}

TEST(PlcopenReader, AWireFromTheRailIsAlwaysOn) {
  EXPECT_EQ(rungs(ld(coil("2", "q", "1"))), "q=true");
}

// A part that two branches share is written once: linear, not 2^n.
TEST(PlcopenReader, SharedWiresAreKept) {
  EXPECT_EQ(rungs(ld(contact("2", "a", "1") + contact("3", "b", "2") +
                     contact("4", "c", "3") + contact("5", "d", "3") +
                     coil("6", "q", "4 5"))),
            "wire.1=(&& a b) | q=(|| (&& wire.1 c) (&& wire.1 d))");
}

TEST(PlcopenReader, CoilsSetResetAndNegate) {
  EXPECT_EQ(
      rungs(ld(contact("2", "a", "1") + coil("3", "q", "2", "storage=\"set\"") +
               coil("4", "o", "2", "storage=\"reset\"") +
               coil("5", "p", "2", "negated=\"true\""))),
      "run.1=a | q=(|| (&& run.1 true) (&& (! run.1) q)) | run.2=a | o=(|| (&& "
      "run.2 false) (&& (! run.2) o)) | p=(! a)");
}

// As the generator has it: `negated` wins over `storage` and `edge`.
TEST(PlcopenReader, NegatedWins) {
  const std::string text =
      ld(contact("2", "a", "1", "negated=\"true\" edge=\"rising\"") +
         coil("3", "q", "2", "negated=\"true\" storage=\"set\""));
  EXPECT_EQ(rungs(text), "q=(! (! a))");
  EXPECT_EQ(rungs(text, "iec").substr(0, 5), "RP094");
}

TEST(PlcopenReader, EdgesAreOfTheContact) {
  EXPECT_EQ(
      rungs(ld(contact("2", "a", "1", "edge=\"rising\"") +
               contact("3", "b", "2", "edge=\"falling\"") +
               coil("4", "q", "3"))),
      "F_TRIG.1.CLK=b | F_TRIG.1.Q=(F_TRIG F_TRIG.1.CLK 2) | R_TRIG.2.CLK=a | "
      "R_TRIG.2.Q=(R_TRIG R_TRIG.2.CLK 3) | q=(&& R_TRIG.2.Q F_TRIG.1.Q)");
}

// Each coil passes its wires anew, and has edges of its own.
TEST(PlcopenReader, EverySinkHasItsOwnEdges) {
  EXPECT_EQ(
      rungs(ld(contact("2", "a", "1", "edge=\"rising\"") + coil("3", "q", "2") +
               coil("4", "o", "2"))),
      "R_TRIG.1.CLK=a | R_TRIG.1.Q=(R_TRIG R_TRIG.1.CLK 2) | q=R_TRIG.1.Q | "
      "R_TRIG.2.CLK=a | R_TRIG.2.Q=(R_TRIG R_TRIG.2.CLK 3) | o=R_TRIG.2.Q");
}

TEST(PlcopenReader, ASeriesOfCoilsPassesItsPower) {
  EXPECT_EQ(rungs(ld(contact("2", "a", "1") + coil("3", "q", "2") +
                     coil("4", "o", "3"))),
            "q=a | o=a");
}

TEST(PlcopenReader, TheOrderOfCoilsIsTheSemantics) {
  const std::string text =
      ld(contact("2", "a", "1") + contact("3", "q", "1") +
         coil("5", "o", "3", "", 100) + coil("4", "q", "2", "", 0));
  EXPECT_EQ(rungs(text, "openplc"), "o=q | q=a");
  EXPECT_EQ(rungs(text, "beremiz-py2"), "q=a | o=q");
  EXPECT_EQ(rungs(text, "iec"), "q=a | o=q");
}

// One network: the second coil's contact does not see what the first wrote.
TEST(PlcopenReader, ANetworkIsASnapshot) {
  const std::string text =
      ld(contact("2", "a", "1") + coil("3", "q", "2", "", 0) +
         contact("4", "q", "2") + coil("5", "o", "4", "", 100));
  EXPECT_EQ(rungs(text, "openplc"), "q=a | o=(&& a q)");
  EXPECT_EQ(rungs(text, "esbmc"),
            "wire.1=a | wire.2=(&& a q) | q=wire.1 | o=wire.2");
}

TEST(PlcopenReader, BlocksAreCalledWhereTheyAreNeeded) {
  EXPECT_EQ(rungs(ld(contact("2", "a", "1") + in_variable("3", "T#2s") +
                     block("4", "TON", "t", input("IN", "2") + input("PT", "3"),
                           "Q ET") +
                     coil("5", "q", "4.Q"))),
            "t.IN=a | t.Q=(TON t.IN 0 2000) | t.ET=(TON.ET 0 2000) | q=t.Q");
}

TEST(PlcopenReader, PinsNegateAndHaveEdges) {
  EXPECT_EQ(rungs(ld(contact("2", "a", "1") +
                     block("4", "SR", "f",
                           input("S1", "2", "negated=\"true\"") +
                               input("R", "1", "edge=\"rising\""),
                           "Q1") +
                     coil("5", "q", "4"))),
            "R_TRIG.1.CLK=true | R_TRIG.1.Q=(R_TRIG R_TRIG.1.CLK 2) | f.S1=(! "
            "a) | f.R=R_TRIG.1.Q | f.Q1=(SR f.S1 f.R 1) | q=f.Q1");
}

TEST(PlcopenReader, FunctionsGiveValues) {
  EXPECT_EQ(
      rungs(ld(
          in_variable("3", "n") + in_variable("2", "12") +
          block("4", "GT", "", input("IN1", "3") + input("IN2", "2"), "OUT") +
          coil("5", "q", "4") +
          block("6", "ADD", "", input("IN1", "3") + input("IN2", "2"), "OUT") +
          out_variable("7", "w", "6"))),
      "wire.1=(> n 12) | q=wire.1 | wire.2=(wrap16 (+ n 12)) | w=wire.2");
}

// What comes out of a block with EN is taken only where it was executed.
TEST(PlcopenReader, EnAndEno) {
  EXPECT_EQ(
      rungs(ld(contact("8", "a", "1") + in_variable("3", "n") +
               block("6", "MOVE", "", input("EN", "8") + input("IN", "3"),
                     "ENO OUT") +
               out_variable("7", "w", "6.OUT") + coil("9", "q", "6.ENO"))),
      "wire.1=a | wire.2=(+ (* (to_word wire.1) n) (* (to_word (! wire.1)) 0)) "
      "| run.3=wire.1 | w=(+ (* (to_word run.3) wire.2) (* (to_word (! run.3)) "
      "w)) | q=wire.1");
}

TEST(PlcopenReader, ConnectorsAreContinued) {
  EXPECT_EQ(rungs(ld(contact("2", "a", "1") +
                     "<connector localId=\"3\" name=\"k\">" + from("2") +
                     "</connector><continuation localId=\"4\" name=\"k\"/>" +
                     contact("5", "b", "4") + coil("6", "q", "5"))),
            "q=(&& a b)");
}

// A kept value is a copy: a later coil may write the variable.
TEST(PlcopenReader, AFunctionKeepsItsValue) {
  EXPECT_EQ(rungs(ld(in_variable("3", "w") +
                     block("4", "MOVE", "", input("IN", "3"), "OUT") +
                     out_variable("5", "w", "6") + in_variable("6", "n") +
                     out_variable("7", "w", "4"))),
            "w=n | wire.1=w | w=wire.1");
}

TEST(PlcopenReader, OrderedBlocksComeFirst) {
  EXPECT_EQ(rungs(ld(contact("2", "a", "1") + coil("3", "q", "2") +
                     contact("4", "b", "1") + in_variable("5", "T#1s") +
                     block("6", "TON", "t", input("IN", "4") + input("PT", "5"),
                           "Q", "executionOrderId=\"1\""))),
            "t.IN=b | t.Q=(TON t.IN 0 1000) | q=a");
}

TEST(PlcopenReader, ReadsRungsOfEsbmc) {
  const std::string body =
      "<LD><rung localId=\"1\"><contact variable=\"a\"/>"
      "<contact variable=\"b\" negated=\"negated\"/>"
      "<coil kind=\"set\" variable=\"q\"/></rung>"
      "<rung localId=\"2\"><block typeName=\"SR\" instanceName=\"g\">"
      "<variable formalParameter=\"S1\">c</variable>"
      "<variable formalParameter=\"R\">d</variable></block></rung></LD>";
  EXPECT_EQ(rungs(project(program(body))),
            "run.1=(&& a (! b)) | q=(|| (&& run.1 true) (&& (! run.1) q)) | "
            "g.S1=c | g.R=d | g.Q1=(SR g.S1 g.R 2)");
}

// 2^40 paths, 80 contacts.
TEST(PlcopenReader, IsLinearInTheDrawing) {
  std::string text;
  std::string last = "1";
  for (int stage = 0; stage < 40; ++stage) {
    const std::string left = std::to_string(2 * stage + 2);
    const std::string right = std::to_string(2 * stage + 3);
    text += contact(left, "a", last) + contact(right, "b", last);
    last = left + " " + right;
  }
  const Xml xml(ld(text + coil("999", "q", last)));
  EXPECT_EQ(xml.problems(), "");
  EXPECT_LT(xml.ast.nodes.size(), 1000U);
}

TEST(PlcopenReader, LongChainsNeedNoStack) {
  std::string text = contact("2", "a", "1");
  constexpr int kLength = 20'000;
  for (int at = 3; at < kLength; ++at) {
    text += contact(std::to_string(at), "b", std::to_string(at - 1));
  }
  const Xml xml(ld(text + coil("99999", "q", std::to_string(kLength - 1))));
  EXPECT_EQ(xml.problems(), "");
}

TEST(PlcopenReader, PropertyLinesAreWhereCommentsAre) {
  const Xml xml(
      "<!-- //@ never q && !a -->\n" +
      ld(contact("2", "a", "1") + coil("3", "q", "2") +
         "<comment localId=\"9\"><content><p xmlns=\"x\"><![CDATA[(*@ always "
         "q || !a *)]]></p></content></comment>"
         "<!-- not a property -->"));
  EXPECT_EQ(xml.problems(), "");
  ASSERT_EQ(xml.ast.annotations.size(), 2U);
  EXPECT_EQ(xml.ast.annotations[0].text, "never q && !a");
  EXPECT_EQ(xml.ast.annotations[1].text, "always q || !a");
  EXPECT_EQ(xml.sources.text(xml.ast.annotations[1].where), "always q || !a");
  EXPECT_EQ(xml.ast.comments.size(), 1U);
}

TEST(PlcopenReader, NamespacesDoNotMatter) {
  std::string text = ld(contact("2", "a", "1") + coil("3", "q", "2"));
  for (const std::string_view name : {"contact", "coil", "LD", "variable"}) {
    for (const std::string mark : {"<", "</"}) {
      for (std::size_t at = 0;
           (at = text.find(mark + std::string(name), at)) != text.npos;) {
        text.insert(at + mark.size(), "x:");
        at += mark.size() + name.size();
      }
    }
  }
  EXPECT_EQ(rungs(text), "q=a");
}

TEST(PlcopenReader, ErrorsHaveTheirPlace) {
  const Xml xml(
      "<project>\n <types><pous>\n  <pou name=\"m\" "
      "pouType=\"program\"><interface/>\n<body>\n   <SFC/></body>"
      "</pou></pous></types></project>");
  ASSERT_EQ(xml.list.items().size(), 1U);
  const LineColumn at =
      xml.sources[xml.file].position(xml.list.items()[0].where.begin);
  EXPECT_EQ(at.line, 5U);
  EXPECT_EQ(at.column, 5U);
  EXPECT_EQ(xml.problems(), "RP094[SFC] `SFC` in `body` is not supported\n");
}

std::string task(std::string_view interval, std::string_view type = "main") {
  return "<instances><configurations><configuration name=\"c\"><resource "
         "name=\"r\"><task name=\"t\" interval=\"" +
         std::string(interval) + "\"><pouInstance name=\"i\" typeName=\"" +
         std::string(type) +
         "\"/></task></resource></configuration></configurations></instances>";
}

TEST(PlcopenReader, UnitsInTextAreReadWhereTheyStand) {
  const std::string block =
      "<pou name=\"latch\" pouType=\"functionBlock\"><interface>" +
      variables("inputVars", "s r") + variables("outputVars", "y") +
      "</interface><body><ST><xhtml:p>IF s &amp; NOT r\nTHEN <br/>y := s;"
      " END_IF;</xhtml:p></ST></body></pou>";
  const std::string main =
      "<pou name=\"main\" pouType=\"program\"><interface>" +
      variables("inputVars", "a b") + variables("outputVars", "q") +
      variables("localVars", "l", "<derived name=\"latch\"/>") +
      "</interface><body><LD><leftPowerRail localId=\"1\"/>" +
      contact("2", "a", "1") + contact("3", "b", "1") +
      ::rung::test::block("4", "latch", "l", input("s", "2") + input("r", "3"),
                          "y") +
      coil("5", "q", "4") + "</LD></body></pou>";
  const Xml xml(project(block + main, task("T#20ms")));
  EXPECT_EQ(xml.problems(), "");
  EXPECT_NE(xml.rungs().find("l.s=a | l.r=b"), std::string::npos);
  EXPECT_NE(xml.rungs().find("(&& l.s (! l.r))"), std::string::npos);
  EXPECT_TRUE(xml.rungs().ends_with("q=l.y"));
  // Places are those of the file: `&gt;=` is `>=` at its end.
  EXPECT_EQ(Xml(project(program("<ST><p>q := a &gt;= b;</p></ST>"))).problems(),
            "RP049[;=] GE of two BOOL is not supported\n");
}

TEST(PlcopenReader, ABodyInText) {
  const Xml xml(project(program("<ST><xhtml:p><![CDATA[//@ never q && !a\n"
                                "q := a AND n < 3; (* a comment *)]]>"
                                "</xhtml:p></ST>"),
                        task("T#20ms")));
  EXPECT_EQ(xml.problems(), "");
  EXPECT_EQ(xml.rungs(), "q=(&& a (< n 3))");
  EXPECT_EQ(xml.ast.annotations.size(), 1U);
  EXPECT_EQ(xml.ast.comments.size(), 1U);
  EXPECT_EQ(xml.ast.scan_min_ms, 20);
  EXPECT_EQ(xml.ast.scan_max_ms, 20);
  EXPECT_EQ(rungs(project(program("<ST><p>q := n &lt;&gt; 3;</p></ST>"))),
            "q=(!= n 3)");
  EXPECT_EQ(rungs(project(program("<IL><p>LD a\nANDN b\nST q</p></IL>"))),
            "q=(&& a (! b))");
}

TEST(PlcopenReader, ExpressionsAtVariables) {
  EXPECT_EQ(rungs(ld(in_variable("2", "n &gt; 3 OR a") + coil("3", "q", "2"))),
            "q=(|| (> n 3) a)");
}

struct Refused {
  std::string_view code;
  std::string text;
};

std::vector<Refused> refused_files() {
  const std::string power = contact("2", "a", "1");
  const std::string good = power + coil("3", "q", "2");
  return {
      // XML.
      {"RP093", ""},
      {"RP093", "<project>"},
      {"RP093", "<project></projekt>"},
      {"RP093", "<project/><project/>"},
      {"RP093", "<project/>text"},
      {"RP093", "<!DOCTYPE p [<!ENTITY a \"b\">]><project>&a;</project>"},
      {"RP093", "<!DOCTYPE p [<!ENTITY a \"aa\"><!ENTITY b \"&a;&a;\">]>" +
                    ld(contact("2", "&b;", "1") + coil("3", "q", "2"))},
      {"RP093", ld(contact("2", "&nbsp;", "1") + coil("3", "q", "2"))},
      {"RP093", ld(contact("2", "&#0;", "1") + coil("3", "q", "2"))},
      {"RP093", ld(contact("2", "&#xD800;", "1") + coil("3", "q", "2"))},
      {"RP093", ld(contact("2", "a & b", "1") + coil("3", "q", "2"))},
      {"RP093", ld(contact("2", "a", "1", "edge=\"none\" edge=\"rising\"") +
                   coil("3", "q", "2"))},
      {"RP001", std::string("<project>\0</project>", 20)},
      // Not supported, by name.
      {"RP094", "<html/>"},
      {"RP094", "<project><addData/></project>"},
      {"RP094", project("<method/>")},
      {"RP094", project(program("<SFC/>"))},
      {"RP094", ld(good + "<jump localId=\"7\" label=\"x\"/>")},
      {"RP094", ld(good + "<label localId=\"7\" label=\"x\"/>")},
      {"RP094", ld(good + "<return localId=\"7\"/>")},
      {"RP094", ld(good + "<vendorElement localId=\"7\"/>")},
      {"RP094", ld(good + "<step localId=\"7\"/>")},
      {"RP094", ld(power + coil("3", "q", "2", "enabled=\"false\""))},
      {"RP094",
       ld(contact("2", "a", "1", "storage=\"set\"") + coil("3", "q", "2"))},
      {"RP094", ld("<inVariable localId=\"2\" negated=\"true\"><expression>a"
                   "</expression></inVariable>" +
                   coil("3", "q", "2"))},
      {"RP094", ld(power + "<block localId=\"4\" typeName=\"SR\" "
                           "instanceName=\"f\"><inOutVariables><variable/>"
                           "</inOutVariables></block>")},
      {"RP094", project("<pou name=\"f\" pouType=\"program\"><actions/>"
                        "<body><LD/></body></pou>")},
      // Missing, or not well formed.
      {"RP095", project("<pou name=\"1x\" pouType=\"program\"><body><LD/>"
                        "</body></pou>")},
      {"RP095", project("<pou name=\"x\" pouType=\"class\"><body><LD/>"
                        "</body></pou>")},
      {"RP095", project("<pou name=\"x\" pouType=\"program\"/>")},
      {"RP095", project("<pou name=\"x\" pouType=\"program\"><body/></pou>")},
      {"RP095", ld(contact("", "a", "1") + coil("3", "q", "2"))},
      {"RP095", ld(power + contact("2", "b", "1") + coil("3", "q", "2"))},
      {"RP095", ld("<contact localId=\"2\">" + from("1") + "</contact>" +
                   coil("3", "q", "2"))},
      {"RP095", ld(contact("2", "", "1") + coil("3", "q", "2"))},
      {"RP095",
       ld(contact("2", "a", "1", "negated=\"maybe\"") + coil("3", "q", "2"))},
      {"RP095",
       ld(contact("2", "a", "1", "edge=\"both\"") + coil("3", "q", "2"))},
      {"RP095", ld(power + coil("3", "q", "2", "storage=\"keep\""))},
      {"RP095", ld(power + coil("3", "q", "2", "executionOrderId=\"x\""))},
      {"RP095", ld(good + block("4", "", "f", "", "Q1"))},
      {"RP095", ld(good + block("4", "SR", "f f", "", "Q1"))},
      {"RP095", ld(good + block("4", "TON", "f", input("IN", "2"), "Q"))},
      // Wires.
      {"RP096", ld(power + coil("3", "q", ""))},
      {"RP096", ld(power + coil("3", "q", "7"))},
      {"RP096", ld(contact("2", "a", "") + coil("3", "q", "2"))},
      {"RP096", ld(power + out_variable("3", "q", ""))},
      {"RP096", ld(good + "<rightPowerRail localId=\"5\">" + from("77") +
                   "</rightPowerRail>")},
      {"RP096", ld(good + "<rightPowerRail localId=\"5\">" + from("3") +
                   "</rightPowerRail>" + coil("6", "o", "5"))},
      {"RP096", ld(power + block("4", "SR", "f", input("S1", "2"), "Q1") +
                   coil("5", "q", "4.Q2"))},
      {"RP096", ld(power + block("4", "TON", "t", input("IN", "2"), "Q ET") +
                   coil("5", "q", "4"))},
      {"RP096",
       ld("<continuation localId=\"4\" name=\"k\"/>" + coil("6", "q", "4"))},
      {"RP096", ld(power + "<connector localId=\"4\" name=\"k\">" + from("2") +
                   "</connector><connector localId=\"5\" name=\"k\">" +
                   from("2") + "</connector>" + coil("6", "q", "2"))},
      {"RP097", ld(contact("2", "a", "3") + contact("3", "b", "2") +
                   coil("4", "q", "3"))},
      {"RP097", ld(contact("2", "a", "2") + coil("4", "q", "2"))},
      {"RP097", ld("<connector localId=\"4\" name=\"k\">" + from("5") +
                   "</connector><continuation localId=\"5\" name=\"k\"/>" +
                   coil("6", "q", "5"))},
      // Nothing is written: a proof of it would be a proof of nothing.
      {"RP098", project(program("<LD/>"))},
      {"RP098", ld("")},
      {"RP098", ld(power)},
      {"RP098", project(program("<LD><rung localId=\"1\"><contact "
                                "variable=\"a\"/></rung></LD>"))},
      // What names stand for.
      {"RP041", ld(contact("2", "nobody", "1") + coil("3", "q", "2"))},
      {"RP041", ld(power + coil("3", "nobody", "2"))},
      {"RP044", ld(power + coil("3", "b", "2"))},
      {"RP049", ld(contact("2", "n", "1") + coil("3", "q", "2"))},
      {"RP049", ld(power + coil("3", "w", "2"))},
      {"RP041", ld(in_variable("2", "'text'") + out_variable("3", "w", "2"))},
      {"RP041", ld(power + block("4", "FROB", "", input("IN", "2"), "OUT") +
                   coil("5", "q", "4"))},
      {"RP041", ld(power + block("4", "FROB", "g", input("IN", "2"), "Q") +
                   coil("5", "q", "4"))},
      {"RP049", ld(power + block("4", "SR", "f", input("S9", "2"), "Q1") +
                   coil("5", "q", "4"))},
      {"RP041", project("")},
      {"RP095", ld(contact("2", "a b", "1") + coil("3", "q", "2"))},
      {"RP095", ld(in_variable("2", "a; q := a") + coil("3", "q", "2"))},
      {"RP047", ld(in_variable("2", "(a") + coil("3", "q", "2"))},
      {"RP095", ld(in_variable("2", "a) OR (b") + coil("3", "q", "2"))},
      // Units in text.
      {"RP007", project(program("<ST><p>q := a; (* open</p></ST>"))},
      {"RP041",
       project(program("<ST><p>WHILE a DO a := b; END_WHILE;</p></ST>"))},
      {"RP041", project(program("<ST><p>q := nobody;</p></ST>"))},
      {"RP094", project(program("<ST><table>q := a;</table></ST>"))},
      {"RP095", project(program("<LD/><ST/>"))},
      {"RP095", project(program("<ST><p>q := a;</p></ST>"), task("PT20S"))},
      {"RP095", project(program("<ST><p>q := a;</p></ST>"), task("T#0ms"))},
      {"RP041", project(program("<ST><p>q := a;</p></ST>"), task("T#1s", "x"))},
  };
}

TEST(PlcopenReader, RefusesWhatItDoesNotRead) {
  for (const Refused& one : refused_files()) {
    const Xml xml(one.text);
    EXPECT_TRUE(xml.list.has_errors()) << one.text;
    EXPECT_EQ(xml.first_code(), one.code) << one.text << xml.problems();
  }
}

TEST(PlcopenReader, DeepFilesAreRefusedInBoundedTime) {
  std::string text;
  for (int depth = 0; depth < 100'000; ++depth) text += "<a>";
  EXPECT_EQ(Xml(text).first_code(), "RP093");
  for (int depth = 0; depth < 100'000; ++depth) text += "</a>";
  EXPECT_EQ(Xml(text).first_code(), "RP094");
}

TEST(PlcopenReader, IsRecognised) {
  EXPECT_TRUE(is_plcopen("\xef\xbb\xbf<?xml version='1.0'?><project/>"));
  EXPECT_TRUE(is_plcopen("// by hand\n\n <project>"));
  EXPECT_TRUE(is_plcopen("<!-- x -->"));
  EXPECT_FALSE(is_plcopen("Q0 = I0;"));
  EXPECT_FALSE(is_plcopen(""));
  EXPECT_EQ(recognise("<project/>").name, "plcopen");
}

}  // namespace
}  // namespace rung::test
