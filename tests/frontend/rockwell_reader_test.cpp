#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/obligation.h"
#include "analysis/property.h"
#include "analysis/transition_system.h"
#include "declared_text.h"
#include "frontend/rockwell/rung_text.h"

namespace rung::test {
namespace {

struct Row {
  std::string_view text;
  std::string_view rungs;
};

TEST(RungsReader, ReadsInstructions) {
  const std::vector<Row> table = {
      {"", ""},
      {"XIC(a)OTE(b);", "b=a"},
      {"XIO(a) OTE( b ) ;", "b=(! a)"},
      {"0: XIC(a)[XIO(b),XIO(c)]OTE(d);", "d=(&& a (|| (! b) (! c)))"},
      // An empty leg is a wire.
      {"XIC(a)[,XIO(c)]OTE(d);", "d=(&& a (|| true (! c)))"},
      {"XIC(a)OTE(b)OTE(c);", "power.1=a | b=power.1 | c=power.1"},
      {"XIC(a)[OTE(b),XIC(c)OTE(d)];",
       "power.1=a | b=power.1 | d=(&& power.1 c)"},
      {"XIC(a)OTL(b);XIC(c)OTU(b);",
       "power.1=a | b=(|| power.1 b) | power.2=c | b=(&& (! power.2) b)"},
      {"AFI()OTE(a);NOP();", "a=false"},
      {"XIC(a)ONS(s)OTE(b);",
       "power.1=a | pulse.2=(&& power.1 (! s)) | s=power.1 | b=pulse.2"},
      {"XIC(a)OSR(s,b);", "power.1=a | b=(&& power.1 (! s)) | s=power.1"},
      {"XIC(a)OSF(s,b);", "power.1=a | b=(&& (! power.1) s) | s=power.1"},
      {"XIC(a)TON(t,500,0);XIC(t.DN)OTE(b);",
       "power.1=a | t.DN=(TON power.1 0 500) | b=t.DN"},
      {"XIC(a)TOF(t,500,0)OTE(b);XIC(t.EN)OTE(c);XIC(t.TT)OTE(d);",
       "power.1=a | done.2=(TOF power.1 0 500) | t.EN=power.1 | t.TT=(&& (! "
       "power.1) done.2) | b=power.1 | c=t.EN | d=t.TT"},
      // Above its timer, a rung sees what the last scan left.
      {"XIC(t.DN)OTE(b);XIC(a)TON(t,500,0);",
       "b=t.DN | power.1=a | t.DN=(TON power.1 0 500)"},
      {"EQU(n,3)OTE(a);LIM(1,n,5)OTE(b);",
       "a=(== n 3) | b=(|| (&& (<= 1 5) (&& (>= n 1) (<= n 5))) (&& (> 1 5) "
       "(|| (>= n 1) (<= n 5))))"},
      {"GT(n,-3)LT(n,16#ff)OTE(a);", "a=(&& (> n -3) (< n 255))"},
      {"MOV(3,n);", "n=3"},
      {"XIC(a)ADD(n,m,n);",
       "power.1=a | n=(+ (* (to_word power.1) (+ n m)) (* (to_word (! "
       "power.1)) n))"},
      {"XIC(a)JMP(x);OTE(b);LBL(x)OTE(c);",
       "power.1=a | jump.2=power.1 | here.3=(! jump.2) | b=(|| (&& here.3 "
       "true) (&& (! here.3) b)) | c=true"},
      {"XIC(a)TND();OTE(b);",
       "power.1=a | jump.2=power.1 | here.3=(! jump.2) | b=(|| (&& here.3 "
       "true) (&& (! here.3) b))"},
      {"XIC(a)MCR();OTE(b);MCR();OTE(c);", "power.1=a | b=power.1 | c=true"},
      {"XIC(n.3)OTE(a);", "a=n.3"},
      // The editor's form.
      {"SOR XIC a BST XIO b NXB XIO c BND OTE d EOR",
       "d=(&& a (|| (! b) (! c)))"},
      {"SOR [0,1] BST XIC [1,0] (*a*) NXB XIC b BND OTE [2,0] (*c*) EOR [3,0]",
       "c=(|| a b)"},
      {"//@ never a\n// text\nXIC(a)OTE(b);", "b=a"},
  };
  for (const Row& row : table) {
    const DeclaredText text("rungs", std::string(row.text));
    EXPECT_EQ(text.rungs(), row.rungs) << row.text << "\n" << text.problems();
    EXPECT_FALSE(text.list.has_errors()) << row.text << "\n" << text.problems();
  }
  EXPECT_EQ(recognise("XIC(a)OTE(b);").name, "rungs");
  EXPECT_EQ(recognise("// x\n0: [XIC(a),XIC(b)]OTE(b);").name, "rungs");
  EXPECT_EQ(recognise("SOR XIC a OTE b EOR").name, "rungs");
}

struct Refused {
  std::string_view text;
  std::string_view problem;
};

TEST(RungsReader, RefusesWithNameAndPlace) {
  const std::vector<Refused> table = {
      {"XIC(a)SCL(b,1.0,0.0,c);", "RP087 1:7 the instruction `SCL` is not"},
      {"PID(a,b,c,1);", "RP087"},
      {"GSV(a,b,c);", "RP087"},
      {"CPT(a,b+1);", "RP087"},
      {"CMP(a>1)OTE(b);", "RP087"},
      {"COP(a,b,1);", "RP087"},
      {"my_aoi(a,b);", "RP087 1:1 the instruction `my_aoi`"},
      {"xic(a)OTE(b);", "RP087"},
      {"XIC()OTE(b);", "RP054 1:1 `XIC` has 1 operands, not 0"},
      {"XIC(a,b)OTE(b);", "RP054"},
      {"XIC(,)OTE(b);", "RP054"},
      {"TON(t)OTE(b);", "RP054"},
      {"EQU(a)OTE(b);", "RP054"},
      {"XIC(a)OTE(b)", "RP051 1:13 this rung has no end"},
      {"SOR XIC a OTE b", "RP051"},
      {"SOR SOR XIC a OTE b EOR", "RP051 1:5 `SOR` and `EOR` come in turns"},
      {"XIC a OTE b EOR", "RP051"},
      {"[XIC(a)OTE(b);", "RP051 1:1 this branch has no end"},
      {"XIC(a)]OTE(b);", "RP051 1:7 no branch is open here"},
      {"XIC(a),OTE(b);", "RP051 1:7 no branch is open here"},
      {"XIC(a OTE(b);", "RP051 1:4 this bracket is not closed"},
      {"XIC(a])OTE(b);", "RP051"},
      {"XIC(a)?OTE(b);", "RP051 1:7 an instruction is expected"},
      {"XIC(5)OTE(b);", "RP052 1:5 `5` is no name"},
      {"XIC(a[0])OTE(b);", "RP052"},
      {"XIC(Local:1:I.Data.0)OTE(b);", "RP052"},
      {"XIC(a.32)OTE(b);", "RP052"},
      {"XIC(a)OTE(b);EQU(a,1)OTE(c);", "RP054 1:18 `a` is a BOOL elsewhere"},
      {"TON(t,?,?);", "RP053 1:7 the preset is neither here nor"},
      {"TON(t,-1,0);", "RP053"},
      {"TON(t,9999999999,0);", "RP053"},
      {"TON(t,x,0);", "RP053"},
      {"EQU(a,1.5)OTE(c);", "RP053 1:7 `1.5` is no integer"},
      {"EQU(a,99999999999)OTE(c);", "RP053 1:7"},
      {"DIV(a,0,b);", "RP053"},
      {"DIV(a,b,c);", "RP053"},
      {"TON(t,5,0);TOF(t,5,0);", "RP088 1:16 `t` is the timer of a TON"},
      {"TON(t,5,0);CTU(t,5,0);", "RP054"},
      {"TON(t,5,0);EQU(t.ACC,3)OTE(a);", "RP087"},
      {"TON(t,5,0);OTL(t.DN);", "RP087 1:16 `t.DN` is written"},
      {"CTU(c,5,0);MOV(1,c.PRE);", "RP087"},
      {"RES(t);", "RP087 1:5 `t` is no timer and no counter"},
      {"TOF(t,5,0);RES(t);", "RP087 1:16 `t` is an off-delay timer"},
      {"JMP(x);", "RP089 1:5 there is no label `x`"},
      {"LBL(x)OTE(a);JMP(x);", "RP089"},
      {"OTE(a)LBL(x);", "RP089 1:7 a label stands first"},
      {"LBL(x);LBL(x);", "RP089 1:12 the label `x` stands"},
      {"XIC(a)MCR();OTE(b);", "RP088 1:7 the zone of this MCR"},
      {"JSR(x);", "RP087 1:5 there is no ladder routine `x`"},
      {"MOV(a,n);XIC(n.1)OTE(b);", "RP087 1:7 `n` is used bit by bit"},
      {"XIC(a)\x02OTE(b);", "RP001"},
  };
  for (const Refused& row : table) {
    const DeclaredText text("rungs", std::string(row.text));
    EXPECT_NE(text.problems().find(row.problem), std::string::npos)
        << row.text << "\n"
        << text.problems();
  }
}

// Names of bits in integers were no names to formulas, those of built-in
// properties among them.
TEST(RungsReader, PropertiesSpeakOfBitsOfIntegers) {
  DeclaredText text("rungs", "//@ reach n.3\nXIC(a)OTL(n.3);XIC(b)OTU(n.3);");
  ASSERT_FALSE(text.list.has_errors()) << text.problems();
  const PropertySet set =
      read_properties(text.program, {}, text.sources, text.list);
  EXPECT_FALSE(text.list.has_errors()) << text.problems();
  EXPECT_GT(set.properties.size(), 1U);
  TransitionSystem ts = build_transition_system(text.program);
  EXPECT_GT(make_obligations(text.program, set, ts).size(), 1U);
}

struct Behaviour {
  std::string_view text;
  std::string_view stimulus;  // a scan takes 1 ms
  std::string_view watch;
  std::string_view expected;
};

TEST(RungsReader, RunsAsControllersDo) {
  const std::vector<Behaviour> table = {
      // The first true scan only sets EN.
      {"XIC(a)TON(t,2,0);XIC(t.EN)OTE(e);XIC(t.TT)OTE(r);XIC(t.DN)OTE(x);",
       "a=1;;;;a=0;a=1;", "t.DN e r",
       "0,1,1 0,1,1 1,1,0 1,1,0 0,0,0 0,1,1 0,1,1"},
      {"XIC(a)TON(t,0,0);XIC(t.DN)OTE(x);", "a=1;;a=0", "t.DN", "0 1 0"},
      {"XIC(a)TOF(t,2,0);XIC(t.DN)OTE(x);", ";a=1;a=0;;;", "t.DN",
       "0 1 1 1 0 0"},
      // The time before the scan that ends it is not counted.
      {"XIC(a)RTO(t,2,0);XIC(b)RES(t);XIC(t.DN)OTE(x);",
       "a=1;;a=0;a=1;;a=0;b=1;b=0", "t.DN", "0 0 0 0 1 1 0 0"},
      {"XIC(a)TON(t,2,0);XIC(b)RES(t);XIC(t.DN)OTE(x);", "a=1;;;b=1;b=0;;",
       "t.DN", "0 0 1 0 0 0 1"},
      // Counters go on past their preset; the prescan sets CU.
      {"XIC(a)CTU(c,1,0);XIC(b)RES(c);EQU(c.ACC,0)XIC(c.DN)OTE(x);",
       "a=1;;a=0;a=1;a=0;a=1;b=1", "c.ACC c.DN", "0,0 0,0 0,0 1,1 1,1 2,1 0,0"},
      {"XIC(a)CTD(c,0,0);EQU(c.ACC,0)XIC(c.DN)OTE(x);", ";a=1", "c.ACC c.DN",
       "0,1 -1,0"},
      {"XIC(a)ONS(s)OTE(b);", "a=1;a=0;a=1;", "b", "0 0 1 0"},
      {"XIC(a)OSF(s,b);", "a=0;a=1;a=0;", "b", "0 0 1 0"},
      // A false zone writes zeros and clears timers; latches stay.
      {"XIC(z)MCR();OTE(b);OTL(l);TON(t,1,0);MCR();XIC(t.DN)OTE(x);",
       "z=1;;z=0", "b l t.DN", "1,1,0 1,1,1 0,1,0"},
      // What is jumped over keeps its value.
      {"XIC(a)JMP(x);XIC(b)OTE(c);LBL(x)NOP();", "b=1;a=1 b=0;a=0", "c",
       "1 1 0"},
      {"XIC(a)MOV(-1,n);XIC(n.0)XIC(n.31)OTE(b);XIC(c)CLR(n);EQU(n,-1)OTE(d);",
       ";a=1;a=0;c=1", "b d", "0,0 1,1 1,1 1,0"},
      {"LIM(2,n,4)OTE(a);LIM(4,n,2)OTE(b);", "n=1;n=2;n=3;n=5", "a b",
       "0,1 1,1 1,0 0,1"},
      {"SUB(n,5,n);DIV(n,2,m);", ";", "n m", "-5,-2 -10,-5"},
  };
  for (const Behaviour& row : table) {
    const DeclaredText text("rungs", std::string(row.text));
    ASSERT_FALSE(text.list.has_errors()) << row.text << "\n" << text.problems();
    EXPECT_EQ(text.run(row.stimulus, row.watch), row.expected) << row.text;
  }
}

// --- exports -----------------------------------------------------------------

constexpr std::string_view kExport =
    "<?xml version=\"1.0\"?>\n<RSLogix5000Content>\n<Controller>\n"
    "<DataTypes><DataType Name=\"U\"><Members>"
    "<Member Name=\"W\" DataType=\"SINT\" Dimension=\"0\"/>"
    "<Member Name=\"A\" DataType=\"BIT\" Dimension=\"0\" Target=\"W\" "
    "BitNumber=\"0\"/>"
    "<Member Name=\"B\" DataType=\"BIT\" Dimension=\"0\" Target=\"W\" "
    "BitNumber=\"1\"/>"
    "<Member Name=\"R\" DataType=\"REAL\" Dimension=\"0\"/>"
    "</Members></DataType></DataTypes>\n"
    "<Tags>"
    "<Tag Name=\"a\" DataType=\"BOOL\"/><Tag Name=\"b\" DataType=\"BOOL\"/>"
    "<Tag Name=\"c\" DataType=\"BOOL\" Constant=\"true\"><Data "
    "Format=\"Decorated\"><DataValue DataType=\"BOOL\" Value=\"1\"/></Data>"
    "</Tag>"
    "<Tag Name=\"n\" DataType=\"INT\"><Data Format=\"Decorated\"><DataValue "
    "DataType=\"INT\" Value=\"16#0007\"/></Data></Tag>"
    "<Tag Name=\"f\" DataType=\"REAL\"/>"
    "<Tag Name=\"x\" DataType=\"BOOL\" AliasFor=\"a\"/>"
    "<Tag Name=\"r\" DataType=\"DINT\" Dimensions=\"2\"><Data "
    "Format=\"Decorated\"><Array DataType=\"DINT\"><Element Index=\"[0]\" "
    "Value=\"4\"/><Element Index=\"[1]\" Value=\"5\"/></Array></Data></Tag>"
    "<Tag Name=\"u\" DataType=\"U\"><Data Format=\"Decorated\"><Structure "
    "DataType=\"U\"><DataValueMember Name=\"W\" DataType=\"SINT\" "
    "Value=\"3\"/></Structure></Data></Tag>"
    "<Tag Name=\"t\" DataType=\"TIMER\"><Data Format=\"Decorated\"><Structure "
    "DataType=\"TIMER\"><DataValueMember Name=\"PRE\" DataType=\"DINT\" "
    "Value=\"70\"/></Structure></Data></Tag>"
    "<Tag Name=\"k\" DataType=\"COUNTER\"/>"
    "</Tags>\n<Programs><Program Name=\"P\" MainRoutineName=\"M\"><Routines>\n";

/// Routines from `name: rung rung | name: ...`.
std::string export_of(std::string_view routines) {
  std::string text(kExport);
  for (std::size_t at = 0; at < routines.size();) {
    const std::size_t end = std::min(routines.find('|', at), routines.size());
    const std::string_view one = routines.substr(at, end - at);
    const std::size_t colon = one.find(':');
    text += "<Routine Name=\"" + std::string(one.substr(0, colon)) +
            "\" Type=\"RLL\"><RLLContent>";
    std::istringstream rungs{std::string(one.substr(colon + 1))};
    for (std::string rung; rungs >> rung;) {
      text += "<Rung Type=\"N\"><Text><![CDATA[" + rung + "]]></Text></Rung>\n";
    }
    text += "</RLLContent></Routine>\n";
    at = end + 1;
  }
  return text +
         "</Routines></Program></Programs></Controller>"
         "</RSLogix5000Content>\n";
}

TEST(L5xReader, ReadsRoutines) {
  const std::vector<Row> table = {
      {"M:XIC(a)OTE(b);", "b=a"},
      {"M:XIC(a)TON(t,?,?);", "power.1=a | done.2=(TON power.1 0 70)"},
      {"M:XIC(u.A)OTE(b);", "b=u.A"},
      {"M:XIC(n.3)OTE(b);", "b=n.3"},
      {"M:EQU(r[1],n)OTE(b);", "b=(== r[1] n)"},
      {"M:ADD(n,1,n);", "n=(wrap16 (+ n 1))"},
      {"M:XIC(a)JSR(S); XIC(b)OTE(b);|S:OTE(b);",
       "power.1=a | b=(|| (&& power.1 true) (&& (! power.1) b)) | b=b"},
      // A call in a call, and a return.
      {"M:JSR(S); OTE(b);|S:XIC(a)RET(); JSR(V,0);|V:MOV(1,n);",
       "power.1=a | jump.2=power.1 | here.3=(! jump.2) | n=(+ (* (to_word "
       "here.3) (wrap16 1)) (* (to_word (! here.3)) n)) | b=true"},
      // A routine that nobody calls is not executed.
      {"M:XIC(a)OTE(b);|V:OTE(a);", "b=a"},
  };
  for (const Row& row : table) {
    const DeclaredText text("l5x", export_of(row.text));
    EXPECT_EQ(text.rungs(), row.rungs) << row.text << "\n" << text.problems();
    EXPECT_FALSE(text.list.has_errors()) << row.text << "\n" << text.problems();
  }
}

TEST(L5xReader, InitialValuesAreThoseOfTheFile) {
  const DeclaredText text(
      "l5x", export_of("M:XIC(c)EQU(r[1],n)XIC(u.A)XIC(u.B)OTE(b); MOV(0,r[0]);"
                       " EQU(u.W,1)MOV(0,u.W); EQU(r[0],1)MOV(0,n);"));
  ASSERT_FALSE(text.list.has_errors()) << text.problems();
  std::map<std::string, std::int64_t> initial;
  for (const AstDeclaration& cell : text.ast.declarations) {
    initial[std::string(cell.name)] = cell.initial;
  }
  EXPECT_EQ(initial["c"], 1);
  EXPECT_EQ(initial["r[0]"], 4);
  EXPECT_EQ(initial["n"], 7);
  EXPECT_EQ(initial["u.A"], 1);
  EXPECT_EQ(initial["u.B"], 1);
  EXPECT_EQ(initial["u.W.2"], 0);
  EXPECT_EQ(initial.count("u.W"), 0U);
}

TEST(L5xReader, RefusesWithNameAndPlace) {
  const std::vector<Refused> table = {
      {"M:XIC(nope)OTE(b);", "RP052 7:76 `nope` is no tag"},
      {"M:XIC(u.Z)OTE(b);", "RP052 7:76 `u.Z` is no member of `U`"},
      {"M:XIC(u)OTE(b);", "RP087"},
      {"M:XIC(u.W)OTE(b);", "RP054"},
      {"M:XIC(a.b)OTE(b);", "RP052"},
      {"M:XIC(n.16)OTE(b);", "RP052 7:76 `n.16` is no bit of INT"},
      {"M:XIC(n.1.1)OTE(b);", "RP052"},
      {"M:EQU(f,1)OTE(b);", "RP087 7:76 `f` has the type `REAL`"},
      {"M:EQU(u.R,1)OTE(b);", "RP087"},
      {"M:EQU(r,1)OTE(b);", "RP087 7:76 `r` is a whole array"},
      {"M:EQU(r[2],1)OTE(b);", "RP087"},
      {"M:EQU(r[n],1)OTE(b);", "RP087"},
      {"M:EQU(r[0,EQU(r[0],1)OTE(b);", "RP051"},
      {"M:XIC(x)OTE(b);", "RP087 7:76 `x` is an alias"},
      {"M:OTE(c);", "RP052 7:76 `c` is a constant"},
      {"M:XIC(t)OTE(b);", "RP054"},
      {"M:TON(a,5,0);", "RP054"},
      {"M:TON(k,5,0);", "RP054"},
      {"M:CTU(k,?,?);", "RP053"},
      {"M:XIC(t.CU)OTE(b);", "RP052"},
      {"M:EQU(t.PRE,1)OTE(b);", "RP087"},
      {"M:JSR(M);", "RP088 7:76 the routine `M` calls itself"},
      {"M:JSR(S);|S:JSR(V);|V:JSR(S);", "calls itself"},
      {"M:JSR(S,n,n);|S:NOP();", "RP087"},
      {"M:JSR(no);", "RP087 7:76 there is no ladder routine `no`"},
      {"V:NOP();", "RP051 6:12 there is no main routine"},
      {"M:NOP();|M:NOP();", "RP052"},
      {"M:MOV(n,u.W); XIC(u.A)OTE(b);", "RP087"},
  };
  for (const Refused& row : table) {
    const DeclaredText text("l5x", export_of(row.text));
    EXPECT_NE(text.problems().find(row.problem), std::string::npos)
        << row.text << "\n"
        << text.problems();
  }
  for (const auto& [text, problem] :
       {std::pair{"<a/>", "RP051"}, std::pair{"<RSLogix5000Content", "RP093"},
        std::pair{"<RSLogix5000Content/>", "RP051"},
        std::pair{"<RSLogix5000Content><Controller/></RSLogix5000Content>",
                  "RP087"},
        std::pair{"<!DOCTYPE a [<!ENTITY b \"c\">]><RSLogix5000Content/>",
                  "RP093"}}) {
    const DeclaredText refused("l5x", text);
    EXPECT_NE(refused.problems().find(problem), std::string::npos)
        << text << refused.problems();
  }
}

std::string file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Every file of the collection is read, or refused for the reason given here.
TEST(L5xReader, ReadsTheCorpus) {
  const std::string root = RUNG_SOURCE_DIR "/../shared/corpus/l5x";
  if (!std::filesystem::exists(root)) GTEST_SKIP() << "no " << root;
  const std::map<std::string, std::string_view> refused = {
      {"custom__rungs_compare.L5X", "`Process` has the type `REAL`"},
      {"custom__rungs_process.L5X", "`SCL`"},
      {"custom__rungs_prog_control.L5X", "parameters of a routine"},
      {"invalid__EC001_undefined_tag.L5X", "`NonExistentTag` is no tag"},
      {"invalid__EC004_invalid_subroutine.L5X", "`NonExistentRoutine`"},
      {"invalid__EC005_invalid_member.L5X", "`MyTag.NonExistentMember`"},
      {"invalid__EC007_duplicate_tag.L5X", "declared a second time"},
      {"invalid__EC010_cross_scope_tag.L5X", "several programs"},
      {"invalid__EC017_constant_modification.L5X", "is a constant"},
      {"invalid__ER009_wrong_operand_count.L5X", "`XIC` has 1 operands"},
      {"invalid__ER014_otl_without_otu.L5X", "`MyBit` is no tag"},
      {"invalid__ER015_mcr_zone.L5X", "the zone of this MCR"},
      {"invalid__WC103_cyclomatic_complexity.L5X", "`A` is no tag"},
      {"invalid__WR009_gsv_invalid_class.L5X", "`GSV`"},
      {"valid__instructions__aoi_Test.L5X", "there is no program"},
      {"valid__routines__ST.L5X", "the main routine is no ladder"},
      {"valid__rungs__Rung1_from_Main.L5X", "`aoi5094IB16`"},
      {"valid__rungs__Rung2_from_Main.L5X", "`aoi_Test`"},
  };
  int read = 0;
  int all = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".L5X") continue;
    const std::string bytes = file_text(entry.path());
    EXPECT_EQ(recognise(bytes).name, "l5x") << entry.path();
    const DeclaredText text("l5x", bytes);
    const auto reason = refused.find(entry.path().filename().string());
    EXPECT_EQ(text.list.has_errors(), reason != refused.end())
        << entry.path() << "\n"
        << text.problems();
    if (reason != refused.end()) {
      EXPECT_NE(text.problems().find(reason->second), std::string::npos)
          << entry.path() << "\n"
          << text.problems();
    }
    ++all;
    read += text.list.has_errors() ? 0 : 1;
  }
  EXPECT_EQ(all, 28);
  EXPECT_EQ(read, 10);
}

// The rungs of those files as a list: the form of each is read.
TEST(L5xReader, ReadsTheListOfRungs) {
  const std::string path =
      RUNG_SOURCE_DIR "/../shared/corpus/l5x/RUNGS.dev.tsv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  std::istringstream lines(file_text(path));
  std::int64_t rungs = 0;
  std::int64_t instructions = 0;
  std::string line;
  std::getline(lines, line);  // the names of the columns
  while (std::getline(lines, line)) {
    const std::int64_t count =
        rockwell::count_instructions(line.substr(line.rfind('\t') + 1));
    EXPECT_GE(count, 0) << line;
    ++rungs;
    instructions += count;
  }
  EXPECT_EQ(rungs, 95);
  EXPECT_EQ(instructions, 304);
}

}  // namespace
}  // namespace rung::test
