#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dump.h"

namespace rung::test {
namespace {

/// "h=(+ h 1) if(x){ ... }else{ ... }": statements of the plant in order.
std::string plant_of(const Ast& ast) {
  using enum AstPlantStatement::Kind;
  std::string text;
  for (const AstPlantStatement& statement : ast.plant) {
    if (!text.empty()) text += ' ';
    switch (statement.kind) {
      case Assign:
        text +=
            std::string(statement.target) + "=" + dump(ast, statement.value);
        break;
      case If:
        text += "if ";
        text += statement.value.has_value() ? dump(ast, statement.value) : "?";
        text += " {";
        break;
      case Else:
        text += "} else {";
        break;
      case End:
        text += "}";
        break;
      case IgnoredCall:
        text += "call " + std::string(statement.target);
        break;
    }
  }
  return text;
}

std::string initials_of(const Ast& ast) {
  std::string text;
  for (const AstAssignment& initial : ast.initials) {
    if (!text.empty()) text += ' ';
    text += std::string(initial.target) + "=" + dump(ast, initial.value);
  }
  return text;
}

struct Section {
  std::string_view text;
  std::string_view codes;
  std::string_view read;
};

TEST(PlantReader, ReadsAndRefusesStatements) {
  const std::vector<Section> table = {
      {"", "", ""},
      {"h=h+1;", "", "h=(+ h 1)"},
      {"h=1 // a\nq=2", "", "h=1 q=2"},
      {"h+=2*q; h-=1; h*=3; h/=q+1", "",
       "h=(+= h (* 2 q)) h=(-= h 1) h=(*= h 3) h=(/= h (+ q 1))"},
      {"h++; ++h; h--; --h", "", "h=(++ h 1) h=(++ h 1) h=(-- h 1) h=(-- h 1)"},
      {"var a=1, b=2, c; let d=3; const e=4", "", "a=1 b=2 d=3 e=4"},
      {"if(h>1)h=0;", "", "if (> h 1) { h=0 }"},
      {"if(h>1){h=0;q=1}", "", "if (> h 1) { h=0 q=1 }"},
      {"if(a)x=1;else y=2", "", "if a { x=1 } else { y=2 }"},
      {"if(a)x=1\nelse y=2", "", "if a { x=1 } else { y=2 }"},
      {"if(a)if(b)x=1;else y=2;z=3", "",
       "if a { if b { x=1 } else { y=2 } } z=3"},
      {"if(a){if(b)x=1}else y=2", "", "if a { if b { x=1 } } else { y=2 }"},
      {"if(a)x=1;else if(b)y=2;else{z=3}w=4", "",
       "if a { x=1 } else { if b { y=2 } else { z=3 } } w=4"},
      {"if(a);else;x=1", "", "if a { } else { } x=1"},
      {"{{x=1}};", "", "x=1"},
      {"if(a){}", "", "if a { }"},
      {"IW0=h\n//Simulasi plant\nqo=h*0.03;", "", "IW0=h qo=(* h 0.03)"},
      {"line(0,0,h*2,(3));", "RP017[line]", "call line"},
      {"line(1);line(2);arc()", "RP017[line] RP017[arc]",
       "call line call line call arc"},
      {"tangki.level(h,Q1,Q0)\nh=1", "RP017[tangki.level]",
       "call tangki.level h=1"},
      {"if(a) draw('x', {}); else draw()", "RP017[draw]",
       "if a { call draw } else { call draw }"},
      // Refused, by name and place.
      {"for(i=0;i<3;i++)h=1\nx=1", "RP014[for]", "x=1"},
      {"while(a)x=1", "RP014[while]", ""},
      {"function f(){}", "RP014[function]", ""},
      {"return;x=1", "RP014[return]", "x=1"},
      {"a.b=1;x=1", "RP014[a.b]", "x=1"},
      {"Math.sin(1)", "RP014[Math.sin]", ""},
      {"x=Math.sin(1);y=1", "RP014[Math]", "y=1"},
      {"x=f(1);y=1", "RP014[f(1)]", "y=1"},
      {"x=a.b;y=1", "RP014[a]", "y=1"},
      {"x=\"a\";y=1", "RP014[\"a\"]", "y=1"},
      {"T(0,1,Q0);y=1", "RP014[T]", "y=1"},
      {"draw(T(0,1,Q0));y=1", "RP014[T]", "y=1"},
      {"draw(x=1);y=1", "RP014[=]", "y=1"},
      {"draw(x++);y=1", "RP014[++]", "y=1"},
      {"draw(function(){});y=1", "RP014[function]", "y=1"},
      {"draw(1", "RP011[draw]", ""},
      {"x=y=1;z=1", "RP012[=]", "x=y z=1"},
      {"x=a?1:2;y=1", "RP012[?]", "x=a y=1"},
      {"x=1,y=2", "RP010[,]", "x=1"},
      {"x", "RP010[]", ""},
      {"5", "RP010[5]", ""},
      {"++5;x=1", "RP012[++]", "x=1"},
      {"var 5;x=1", "RP010[5]", "x=1"},
      {"var if;x=1", "RP010[if]", "x=1"},
      {"if a x=1", "RP010[a]", "if ? { }"},
      {"if(a x=1;y=2", "RP010[x]", "if ? { y=2 }"},
      {"else x=1", "RP016[else]", ""},
      {"if(a)x=1;else y=1;else z=1", "RP016[else]",
       "if a { x=1 } else { y=1 }"},
      {"{x=1", "RP016[{]", "x=1"},
      {"x=1}", "RP016[}]", "x=1"},
      {"if(a){x=1", "RP016[{] RP016[if]", "if a { x=1 }"},
      {"if(a)", "RP016[if]", "if a { }"},
      {"x=(1;y=2", "RP011[(]", "y=2"},
  };
  for (const Section& row : table) {
    Read out;
    read("Q0=I0\n//Sim\n" + std::string(row.text), "", out);
    EXPECT_EQ(codes(out.sources, out.diagnostics, true), row.codes) << row.text;
    EXPECT_EQ(plant_of(out.ast), row.read) << row.text;
    EXPECT_EQ(out.ast.rungs.size(), 1U);
  }
}

TEST(PlantReader, ReadsAndRefusesInitialValues) {
  const std::vector<Section> table = {
      {"", "", ""},
      {"M0=false; h=0;// text", "", "M0=false h=0"},
      {"var M0=true, h=-1", "", "M0=true h=(- 1)"},
      {"sumbu(0,10);h=1", "RP017[sumbu]", "h=1"},
      {"if(a)h=1", "RP014[if]", ""},
      {"h+=1;x=1", "RP012[+=]", "x=1"},
      {"h++;x=1", "RP012[++]", "x=1"},
      {"++h;x=1", "RP012[++]", "x=1"},
      {"h=f();x=1", "RP014[f()]", "x=1"},
  };
  for (const Section& row : table) {
    Read out;
    read("Q0=I0\n//Var\n" + std::string(row.text) + "\n//Sim\n", "", out);
    EXPECT_EQ(codes(out.sources, out.diagnostics, true), row.codes) << row.text;
    EXPECT_EQ(initials_of(out.ast), row.read) << row.text;
    EXPECT_TRUE(out.ast.plant.empty());
  }
}

TEST(PlantReader, SectionMarkers) {
  struct Row {
    std::string_view text;
    std::string_view codes;
    std::size_t rungs, initials, statements;
  };
  const std::vector<Row> table = {
      {"Q0=I0\n//Var\na=1\n//Sim\nb=2", "", 1, 1, 1},
      {"Q0=I0\n// Var , text\na=1\n//\tSim\nb=2", "", 1, 1, 1},
      {"Q0=I0\n//Sim\nb=2", "", 1, 0, 1},
      {"Q0=I0 //Var\na=1", "", 1, 1, 0},
      {"Q0=I0\n//Variable\nQ1=I1\n//Simulasi\nQ2=I1", "", 3, 0, 0},
      {"Q0=I0\n/*Sim*/\nQ1=I1", "", 2, 0, 0},
      {"Q0=I0\n//variables\nQ1=I1\n//var x = 1\nQ2=I2", "", 3, 0, 0},
      {"Q0=I0\n//Sim the tank\nQ1=I1", "RP015[//Sim the tank]", 2, 0, 0},
      {"Q0=I0\n//sim\nQ1=I1", "RP015[//sim]", 2, 0, 0},
      {"Q0=I0\n//VAR, x\nQ1=I1", "RP015[//VAR, x]", 2, 0, 0},
      {"Q0=I0\n//Sim\n//Sim\n", "RP015[//Sim]", 1, 0, 0},
      {"Q0=I0\n//Var\n//Var\n", "RP015[//Var]", 1, 0, 0},
      {"Q0=I0\n//Sim\n//Var\n", "RP015[//Var]", 1, 0, 0},
      {"Q0=I0||\n//Sim\nb=2", "RP010[||]", 0, 0, 1},
      {"Q0=(I0\n//Sim\nb=2", "RP011[(]", 0, 0, 1},
      {"y0=y1\n// Sim the tank\ny2=y3", "", 2, 0, 0},
  };
  for (const Row& row : table) {
    Read out;
    read(row.text, "", out);
    EXPECT_EQ(codes(out.sources, out.diagnostics, true), row.codes) << row.text;
    EXPECT_EQ(out.ast.rungs.size(), row.rungs) << row.text;
    EXPECT_EQ(out.ast.initials.size(), row.initials) << row.text;
    EXPECT_EQ(out.ast.plant.size(), row.statements) << row.text;
  }
}

TEST(PlantReader, OtherDialectHasNoSections) {
  Read out;
  read("y0=y1\n//Sim\ny2=y3 // z\n", "yun", out);
  EXPECT_EQ(out.ast.rungs.size(), 2U);
  ASSERT_EQ(out.ast.comments.size(), 2U);
  EXPECT_EQ(out.ast.comments[0].text, "Sim");
  EXPECT_EQ(out.ast.comments[1].text, " z");
}

TEST(PlantReader, DepthCostsNoStack) {
  constexpr std::size_t kDeep = 100'000;
  std::string text = "Q0=I0\n//Sim\n";
  for (std::size_t i = 0; i < kDeep; ++i) text += "if(a)x=1;else ";
  text += "{x=2}";
  Read out;
  read(text, "", out);
  EXPECT_EQ(codes(out.sources, out.diagnostics, true), "");
  EXPECT_EQ(out.ast.plant.size(), 4 * kDeep + 1);
}

}  // namespace
}  // namespace rung::test
