#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dump.h"
#include "frontend/script/reader.h"
#include "frontend/script/token.h"

namespace rung::test {
namespace {

std::string repeat(std::string_view text, std::size_t count) {
  std::string all;
  all.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

/// "Q0=I0 | Q1=(! I1)": all rungs.
std::string rungs_of(const Ast& ast) {
  std::string text;
  for (const AstAssignment& rung : ast.rungs) {
    if (!text.empty()) text += " | ";
    text += std::string(rung.target) + "=" + dump(ast, rung.value);
  }
  return text;
}

struct Accepted {
  std::string_view text;
  std::string_view rungs;
};

TEST(ScriptReader, ReadsRungs) {
  const std::vector<Accepted> table = {
      {"", ""},
      {";;", ""},
      {"// nothing", ""},
      {"Q0=I0;", "Q0=I0"},
      {"Q0=I0", "Q0=I0"},
      {"Q0=I0; Q1=I1;Q2=I2", "Q0=I0 | Q1=I1 | Q2=I2"},
      {"\xef\xbb\xbfQ0=I0;", "Q0=I0"},
      {"Q0\xc2\xa0= I0", "Q0=I0"},
      // A line end finishes a rung that is complete ...
      {"Q1=(M1||Q1)&&!M2\nM2=I0;", "Q1=(&& (|| M1 Q1) (! M2)) | M2=I0"},
      {"Q0=I0\r\nQ1=I1\rQ2=I2", "Q0=I0 | Q1=I1 | Q2=I2"},
      {"Q0=I0 /* a\n b */ Q1=I1", "Q0=I0 | Q1=I1"},
      {"Q0=I0 // off\n\nQ1=I1", "Q0=I0 | Q1=I1"},
      // ... and not one that goes on.
      {"Q0 = I0 ||\n I1;", "Q0=(|| I0 I1)"},
      {"Q0 = (I0\n|| I1\n)", "Q0=(|| I0 I1)"},
      {"Q0 = I0 // first\n  || I1 // second", "Q0=(|| I0 I1)"},
      {"Q0\n=\nI0", "Q0=I0"},
      {"Q0 = T(\n0,\n5,\nI0\n)", "Q0=(T 0 5 I0)"},
      // Precedence and association, as in Javascript.
      {"Q0=I0||I1&&I2", "Q0=(|| I0 (&& I1 I2))"},
      {"Q0=I0&&I1||I2", "Q0=(|| (&& I0 I1) I2)"},
      {"Q0=!I0==I1", "Q0=(== (! I0) I1)"},
      {"Q0=IW0<1==IW1>2", "Q0=(== (< IW0 1) (> IW1 2))"},
      {"Q0=IW0-1-2>0", "Q0=(> (- (- IW0 1) 2) 0)"},
      {"Q0=IW0-(1-2)>0", "Q0=(> (- IW0 (- 1 2)) 0)"},
      {"Q0=IW0+2*-3/4<=!I0", "Q0=(<= (+ IW0 (/ (* 2 (- 3)) 4)) (! I0))"},
      {"Q0=I0&&IW0!=1", "Q0=(&& I0 (!= IW0 1))"},
      {"Q0=!!I0", "Q0=(! (! I0))"},
      {"Q0=IW0- -1>=0", "Q0=(>= (- IW0 (- 1)) 0)"},
      {"Q0=I0===I1!==I2", "Q0=(!== (=== I0 I1) I2)"},
      {"Q0=((I0))", "Q0=I0"},
      // Calls and literals.
      {"Q0=f()", "Q0=(f)"},
      {"Q0=f(1,g(2),!I0)&&I1", "Q0=(&& (f 1 (g 2) (! I0)) I1)"},
      {"Q0=true||false", "Q0=(|| true false)"},
      {"Q0=IW0<.5+5.+0x1F+1e3+2.5E-1+0",
       "Q0=(< IW0 (+ (+ (+ (+ (+ .5 5.) 0x1F) 1e3) 2.5E-1) 0))"},
      {"y0=Cmp(1,\"<\",2)", "y0=(Cmp 1 < 2)"},
      {"y0=Cmp(1,'<',2)", "y0=(Cmp 1 < 2)"},
      {"y0=Cmp(1,\u201c<\u201d,2)", "y0=(Cmp 1 < 2)"},
      {"y0=Cmp(1,\u2018<\u2019,2)", "y0=(Cmp 1 < 2)"},
      {"y0=Cmp(1,\u201d<\",2)", "y0=(Cmp 1 < 2)"},
      {"y0=Cmp(1,\"\",2)", "y0=(Cmp 1  2)"},
  };
  for (const Accepted& row : table) {
    Read out;
    read(row.text, "", out);
    EXPECT_EQ(rungs_of(out.ast), row.rungs) << row.text;
    EXPECT_EQ(codes(out.sources, out.diagnostics, true), "") << row.text;
  }
}

struct Refused {
  std::string_view text;
  std::string_view codes;  // each with the text under its caret
  std::string_view rungs;  // what is read all the same
};

TEST(ScriptReader, RefusesRungs) {
  using namespace std::string_view_literals;
  const std::vector<Refused> table = {
      // What is no text.
      {"Q0=I0;\0"sv, "RP001[\0]"sv, ""},
      {"\xff\xfeQ\0"sv, "RP001[\xff]", ""},
      {"\xfe\xff\0Q"sv, "RP001[\xfe]", ""},
      {"Q0=I0; // \xe9", "RP001[\xe9]", ""},
      {"Q0=I0; // \xc0\x80", "RP001[\xc0]", ""},
      {"Q0=I0; // \xed\xa0\x80", "RP001[\xed]", ""},
      {"Q0=I0; // \xf4\x90\x80\x80", "RP001[\xf4]", ""},
      {"Q0=I0; // \xe2\x82", "RP001[\xe2]", ""},
      {"Q0=I0;\x1b[0m", "RP001[\x1b]", ""},
      {"Q0=I0;\x7f", "RP001[\x7f]", ""},
      // Characters and tokens.
      {"Q0=I0\u00a7\u00a7I1;Q1=I1", "RP003[\u00a7\u00a7]", "Q0=I0 | Q1=I1"},
      {"Q0=\u00a7;Q1=I1", "RP003[\u00a7]", "Q1=I1"},
      {"#Q0=I0\nQ1=I1", "RP003[#]", "Q1=I1"},
      {"Q0=IW0\u2264"
       "3",
       "RP003[\u2264]", "Q0=IW0"},
      {"Q0=IW0>5s;Q1=I1", "RP005[5s]", "Q1=I1"},
      {"Q0=IW0>010;Q1=I1", "RP005[010]", "Q1=I1"},
      {"Q0=IW0>1.2.3", "RP005[1.2.3]", ""},
      {"Q0=IW0>0x", "RP005[0x]", ""},
      {"Q0=IW0>0xG", "RP005[0xG]", ""},
      {"Q0=IW0>1e", "RP005[1e]", ""},
      {"Q0=IW0>1e+", "RP005[1e+]", ""},
      {"Q0=IW0>1_000", "RP005[1_000]", ""},
      {"Q0=IW0>10n", "RP005[10n]", ""},
      {"Q0=0b1", "RP005[0b1]", ""},
      {"y0=Cmp(1,\"<,2)\ny1=y2", "RP006[\"<,2)]", "y1=y2"},
      {"y0=Cmp(1,\"\\x3e\",2)", "RP006[\"\\x3e\"]", ""},
      {"y0=Cmp(1,\"<',2)", "RP006[\"<',2)]", ""},
      {"Q0=I0;/* open", "RP007[/*]", "Q0=I0"},
      // Shape.
      {"foo", "RP010[foo]", ""},
      {"foo;Q0=I0", "RP010[foo]", "Q0=I0"},
      {"foo bar\nQ0=I0", "RP010[bar]", "Q0=I0"},
      {"T(0,5,I0);Q0=I0", "RP010[T]", "Q0=I0"},
      {"Q0==I0;Q1=I1", "RP010[==]", "Q1=I1"},
      {"Q0===I0;", "RP010[===]", ""},
      {"Q0=", "RP010[=]", ""},
      {"Q0=;Q1=I1", "RP010[=]", "Q1=I1"},
      {"Q0=\nQ1=I1", "RP010[=]", "Q1=I1"},
      {"Q0=I0||\nQ1=I1", "RP010[||]", "Q1=I1"},
      {"Q0=I0&&!", "RP010[!]", ""},
      {"Q0=I0||&&I1;Q1=I1", "RP010[&&]", "Q1=I1"},
      {"Q0=I0 I1;Q1=I1", "RP010[I1]", "Q0=I0 | Q1=I1"},
      {"Q0=I0 Q1=I1", "RP010[Q1]", "Q0=I0"},
      {"Q0=(I0 I1);Q1=I1", "RP010[I1]", "Q1=I1"},
      {"Q0=();Q1=I1", "RP010[)]", "Q1=I1"},
      {"Q0=T(0,,I0)", "RP010[,]", ""},
      {"Q0=T(0,I0,)", "RP010[)]", ""},
      {"Q0=(I0,I1)", "RP010[,]", ""},
      {"Q0=I0,I1", "RP010[,]", "Q0=I0"},
      {"5=I0;Q1=I1", "RP010[5]", "Q1=I1"},
      {"=I0", "RP012[=]", ""},
      {"Q0={}", "RP010[{]", ""},
      {"Q0=I0 AND I1", "RP010[AND]", "Q0=I0"},
      {"Q0=f.x", "RP014[f]", ""},
      {"Q0=Math.abs(1)", "RP014[Math]", ""},
      // Parentheses.
      {"Q0=(I0||I1\nQ1=I1", "RP011[(]", "Q1=I1"},
      {"Q0=((I0)", "RP011[(]", ""},
      {"Q0=T(0,5,I0;Q1=I1", "RP011[T]", "Q1=I1"},
      {"Q0=I0);Q1=I1", "RP011[)]", "Q0=I0 | Q1=I1"},
      {")", "RP010[)]", ""},
      // Operators that rungs do not have; the paper's own slip is the first.
      {"Q0=((IW0<20)||Q0|)&&!(IW0>50)", "RP012[|]", ""},
      {"Q0=I0&I1;Q1=I1", "RP012[&]", "Q0=I0 | Q1=I1"},
      {"Q0=(I0|I1);Q1=I1", "RP012[|]", "Q1=I1"},
      {"Q0=IW0%2;Q1=I1", "RP012[%]", "Q0=IW0 | Q1=I1"},
      {"Q0=I0?I1:I2", "RP012[?]", "Q0=I0"},
      {"Q0=I0=I1", "RP012[=]", "Q0=I0"},
      {"Q0=IW0=>3", "RP012[=>]", "Q0=IW0"},
      {"Q0=IW0=<3", "RP012[=<]", "Q0=IW0"},
      {"Q0=IW0<>3", "RP012[<>]", "Q0=IW0"},
      {"Q0=I0++", "RP012[++]", "Q0=I0"},
      {"Q0=++I0", "RP012[++]", ""},
      {"Q0=--I0", "RP012[--]", ""},
      {"Q0=~I0", "RP012[~]", ""},
      {"Q0=IW0[1]", "RP012[[]", "Q0=IW0"},
      {"Q0=+IW0>1", "RP010[+]", ""},
      {"Q0+=1;Q1=I1", "RP012[+=]", "Q1=I1"},
      {"Q0++;Q1=I1", "RP012[++]", "Q1=I1"},
      // Words with a meaning of their own.
      {"if(I0)Q0=I1;Q1=I1", "RP013[if]", "Q1=I1"},
      {"var M0=1;Q1=I1", "RP013[var]", "Q1=I1"},
      {"true=I0", "RP013[true]", ""},
      {"Q0=TRUE", "RP013[TRUE]", ""},
      {"Q0=null", "RP013[null]", ""},
      {"Q0=I0&&this", "RP013[this]", ""},
      // All errors of a file in one run.
      {"Q0=;\nQ1=I0|I1;\nQ2=I2;\nQ3=(I3\nfoo", "RP010[=] RP012[|] RP011[(]",
       "Q1=I0 | Q2=I2"},
  };
  for (const Refused& row : table) {
    Read out;
    read(row.text, "", out);
    EXPECT_EQ(codes(out.sources, out.diagnostics, true), row.codes) << row.text;
    EXPECT_EQ(rungs_of(out.ast), row.rungs) << row.text;
  }
}

TEST(ScriptReader, SaysWhatWasMeant) {
  const std::vector<std::pair<std::string_view, std::string_view>> table = {
      {"Q0=I0|I1", "`||`"},       {"Q0=I0&I1", "`&&`"},   {"Q0=IW0=>1", "`>=`"},
      {"Q0=I0 OR I1", "`||`"},    {"Q0=TRUE", "`true`"},  {"Q0=I0=I1", "`==`"},
      {"Q0=IW0\u22651", "`>=`"},  {"Q0=\u00acI0", "`!`"}, {"Q0=NOT I0", "`!`"},
      {"Q0=IW0\u22121>0", "`-`"},
  };
  for (const auto& [text, meant] : table) {
    Read out;
    read(text, "", out);
    ASSERT_EQ(out.diagnostics.size(), 1U) << text;
    EXPECT_NE(
        out.diagnostics[0].message.find("did you mean " + std::string(meant)),
        std::string::npos)
        << out.diagnostics[0].message;
  }
}

TEST(ScriptReader, OperandsStandRightBeforeTheirOperator) {
  Read out;
  read("Q0 = T(0, 5, I0 && (I1 || !I2)) == (IW0 + 1 > 2);", "", out);
  for (const AstAssignment& rung : out.ast.rungs) {
    for (std::uint32_t i = rung.value.begin; i < rung.value.end; ++i) {
      const AstNode& node = out.ast.nodes[i];
      std::uint32_t size = 1;
      for (std::uint32_t k = 0; k < node.arguments; ++k) {
        size += out.ast.nodes[i - size].size;
      }
      EXPECT_EQ(node.size, size);
    }
    EXPECT_EQ(out.ast.nodes[rung.value.root()].size,
              rung.value.end - rung.value.begin);
  }
}

TEST(ScriptReader, RangesCoverTheParenthesesOfOperands) {
  Read out;
  read("Q0 = (I0||I1) && T(0, 5, (I2));", "", out);
  const AstAssignment& rung = out.ast.rungs[0];
  EXPECT_EQ(out.sources.text(rung.where), "Q0 = (I0||I1) && T(0, 5, (I2))");
  EXPECT_EQ(out.sources.text(rung.target_where), "Q0");
  EXPECT_EQ(out.sources.text(out.ast.nodes[rung.value.root()].where),
            "(I0||I1) && T(0, 5, (I2))");
  EXPECT_EQ(out.sources.text(out.ast.nodes[2].where), "I0||I1");
  EXPECT_EQ(out.sources.text(out.ast.nodes[5].where), "I2");
  EXPECT_EQ(out.sources.text(out.ast.nodes[6].where), "T(0, 5, (I2))");
}

TEST(ScriptReader, CommentsAndPropertyLines) {
  Read out;
  read(
      "// one\nQ0=I0; /* two */ //@  never Q0 \n//@interlock Q0, Q1\n"
      "// @ three\n//@ language script\n//@ dialect sim\n",
      "", out);
  ASSERT_EQ(out.ast.comments.size(), 3U);
  EXPECT_EQ(out.ast.comments[0].text, " one");
  EXPECT_EQ(out.ast.comments[1].text, " two ");
  EXPECT_EQ(out.sources.text(out.ast.comments[1].where), "/* two */");
  EXPECT_EQ(out.ast.comments[2].text, " @ three");
  ASSERT_EQ(out.ast.annotations.size(), 2U);  // the reader's own lines are not
  EXPECT_EQ(out.ast.annotations[0].text, "never Q0");
  EXPECT_EQ(out.sources.text(out.ast.annotations[0].where), "never Q0");
  EXPECT_EQ(out.ast.annotations[1].text, "interlock Q0, Q1");
  EXPECT_EQ(codes(out.sources, out.diagnostics, true), "");
}

struct Recognised {
  std::string_view text;
  std::string_view given;
  std::string_view dialect;
  std::string_view codes;
};

/// The reader and the file agree on where a line ends: with a lone \r too.
TEST(ScriptReader, LineEndsAreThoseOfTheFile) {
  SourceSet sources;
  const FileId file =
      sources.add("test.rung", "// a\rQ0=I0\r\n\r\rQ1=I1\nQ2=I2\r");
  DiagnosticList sink;
  const Ast ast = read_script(sources, file, "sim", sink);
  ASSERT_EQ(ast.rungs.size(), 3U);
  std::vector<std::uint32_t> lines;
  for (const AstAssignment& rung : ast.rungs) {
    const LineColumn at = sources[file].position(rung.where.begin);
    EXPECT_EQ(at.column, 1U);
    lines.push_back(at.line);
  }
  EXPECT_EQ(lines, (std::vector<std::uint32_t>{2, 5, 6}));
  EXPECT_EQ(sources[file].line(1), "// a");
  EXPECT_EQ(sources[file].line(2), "Q0=I0");
  EXPECT_EQ(sources[file].line(3), "");
  EXPECT_EQ(sources[file].line(6), "Q2=I2");
  EXPECT_EQ(sources[file].line_count(), 7U);
}

TEST(ScriptReader, RecognisesTheDialect) {
  const std::vector<Recognised> table = {
      {"", "", "sim", ""},
      {"M0=M1;", "", "sim", ""},
      {"M0=T(0,1,M1);", "", "sim", ""},  // in both
      {"y0=y1;", "", "yun", ""},
      {"pin3=M0;", "", "yun", ""},
      {"M0=A5>3;", "", "yun", ""},
      {"M0=TR(0,M1);", "", "yun", ""},
      {"M0=CR(0,M1);", "", "yun", ""},
      {"M0=ORN(a,b,c);", "", "yun", ""},
      {"M0=Cmp(1,\"<\",2);", "", "yun", ""},
      {"M0=Cnt(0,1,M1);", "", "yun", ""},
      {"M0=ORN;", "", "sim", ""},  // not called
      {"Q0=M0;", "", "sim", ""},
      {"M0=I8;", "", "sim", ""},
      {"M0=IW0>1;", "", "sim", ""},
      {"QW0=2;", "", "sim", ""},
      {"M0=TOF(0,1,M1);", "", "sim", ""},
      {"M0=M1;\n//Var\ny1=1;", "", "sim", ""},
      {"y0=M1;\n//Sim\n", "", "yun", "RP004[//Sim]"},
      {"y0=I0;", "", "yun", "RP004[I0]"},
      {"Q0=pin1;", "", "sim", "RP004[pin1]"},
      {"y0=I0;", "yun", "yun", ""},
      {"y0=I0;", "sim", "sim", ""},
      {"Q0=I0;", "yun", "yun", ""},
      {"//@ dialect yun\nQ0=y0;", "", "yun", ""},
      {"Q0=y0;\n//@ dialect sim", "", "sim", ""},
      {"//@ dialect yun\nQ0=y0;", "sim", "sim", ""},
      {"//@ dialect foo\nQ0=I0;", "", "sim", "RP004[dialect foo]"},
      {"//@ dialect yun\n//@ dialect sim", "", "yun", "RP004[dialect sim]"},
      {"y0=y1;", "foo", "yun", "RP004[]"},
  };
  for (const Recognised& row : table) {
    Read out;
    read(row.text, row.given, out);
    EXPECT_EQ(out.ast.dialect, row.dialect) << row.text;
    EXPECT_EQ(codes(out.sources, out.diagnostics, true), row.codes) << row.text;
  }
}

TEST(ScriptReader, LeavesOutErrorsAboveTheLimit) {
  Read out;
  read(repeat("Q0=;\n", 150), "", out);
  ASSERT_EQ(out.diagnostics.size(), 101U);
  EXPECT_EQ(out.diagnostics.back().code, "RP002");
  EXPECT_EQ(out.diagnostics.back().severity, Severity::Note);
  EXPECT_EQ(out.diagnostics.back().message,
            "too many errors: 50 more are left out");
  Read few;
  read(repeat("Q0=;\n", 100), "", few);
  EXPECT_EQ(few.diagnostics.size(), 100U);
}

// None of these may need stack, nor more than linear time.
TEST(ScriptReader, DepthCostsNoStack) {
  constexpr std::size_t kDeep = 1'000'000;
  constexpr std::size_t kLong = 100'000;
  const std::vector<std::pair<std::string, std::size_t>> table = {
      {"Q0=" + repeat("(", kDeep) + "I0" + repeat(")", kDeep), 1},
      {"Q0=" + repeat("!", kDeep) + "I0", kDeep + 1},
      {"Q0=" + repeat("f(", kLong) + "I0" + repeat(")", kLong), kLong + 1},
      {"Q0=I0" + repeat("||I1", kLong), 2 * kLong + 1},
      {"Q0=" + repeat("I0||(", kLong) + "I1" + repeat(")", kLong),
       2 * kLong + 1},
  };
  for (const auto& [text, nodes] : table) {
    Read out;
    read(text, "sim", out);
    EXPECT_EQ(codes(out.sources, out.diagnostics, true), "");
    EXPECT_EQ(out.ast.nodes.size(), nodes);
  }
  for (const std::string_view text : {"(", "!", "f(", "I0||(", ")", "\"\n"}) {
    Read out;
    read("Q0=" + repeat(text, kLong), "sim", out);
    EXPECT_EQ(out.diagnostics.size(), 1U) << text;
  }
}

TEST(ScriptReader, AnyBytesGiveAnAnswer) {
  std::uint32_t state = 1;
  for (int round = 0; round < 300; ++round) {
    std::string text;
    for (int i = 0; i < 200; ++i) {
      state = state * 1664525U + 1013904223U;
      const auto byte = static_cast<char>(state >> 24U);
      // Half of the rounds are text, so that more than the first stage is hit.
      text += round % 2 == 0 ? byte : static_cast<char>(' ' + (byte & 63));
    }
    Read out;
    read(text, "", out);
    EXPECT_FALSE(out.diagnostics.empty()) << text;
  }
}

TEST(ScriptReader, LongTextsAreCutInMessages) {
  EXPECT_EQ(quoted_excerpt("abc"), "`abc`");
  EXPECT_EQ(quoted_excerpt(repeat("a", 41)), "`" + repeat("a", 40) + "...`");
  // Not inside a character.
  EXPECT_EQ(quoted_excerpt(repeat("a", 39) + "\u00e9" + "bc"),
            "`" + repeat("a", 39) + "...`");
}

}  // namespace
}  // namespace rung::test
