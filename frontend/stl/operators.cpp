#include "frontend/stl/operators.h"

#include <array>

namespace rung::stl {
namespace {

using enum Code;
constexpr Mnemonics kBoth = Mnemonics::Both;
constexpr Mnemonics kDe = Mnemonics::German;
constexpr Mnemonics kEn = Mnemonics::English;

constexpr Operator logic(std::string_view name, Mnemonics set, Join join,
                         bool negate = false) {
  return {name, Logic, 1, set, join, negate};
}
constexpr Operator open(std::string_view name, Mnemonics set, Join join,
                        bool negate = false) {
  return {name, Open, 0, set, join, negate};
}
constexpr Operator jump(std::string_view name, Mnemonics set,
                        Condition condition = Condition::None,
                        bool negate = false, bool saves = false) {
  return {name, Jump, 1, set, Join::And, negate, condition, saves};
}
constexpr Operator end(std::string_view name, Mnemonics set,
                       Condition condition = Condition::None) {
  return {name, End, 0, set, Join::And, false, condition};
}
constexpr Operator compare(std::string_view name, AstOp op, bool wide) {
  return {name,  Compare,         0,     kBoth, Join::And,
          false, Condition::None, false, op,    wide};
}
constexpr Operator check(std::string_view name, AstOp op) {
  return {name, Assert, 2, kBoth, Join::And, false, Condition::None, false, op};
}
constexpr Operator timer(std::string_view name, Mnemonics set,
                         std::string_view element) {
  return {name,  Timer,        1,     set,    Join::And, false, Condition::None,
          false, AstOp::Equal, false, element};
}

constexpr std::array kOperators = {
    logic("U", kDe, Join::And),
    logic("A", kEn, Join::And),
    logic("UN", kDe, Join::And, true),
    logic("AN", kEn, Join::And, true),
    logic("O", kBoth, Join::Or),
    logic("ON", kBoth, Join::Or, true),
    logic("X", kBoth, Join::Xor),
    logic("XN", kBoth, Join::Xor, true),
    open("U(", kDe, Join::And),
    open("A(", kEn, Join::And),
    open("UN(", kDe, Join::And, true),
    open("AN(", kEn, Join::And, true),
    open("O(", kBoth, Join::Or),
    open("ON(", kBoth, Join::Or, true),
    open("X(", kBoth, Join::Xor),
    open("XN(", kBoth, Join::Xor, true),
    Operator{")", Close},
    Operator{"=", Assign, 1},
    Operator{"S", Set, 1},
    Operator{"R", Reset, 1},
    Operator{"NOT", Not},
    Operator{"SET", SetResult},
    Operator{"CLR", SetResult, 0, kBoth, Join::And, true},
    Operator{"SAVE", Save},
    Operator{"FP", Edge, 1},
    Operator{"FN", Edge, 1, kBoth, Join::And, true},
    jump("SPA", kDe),
    jump("JU", kEn),
    jump("SPB", kDe, Condition::Result),
    jump("JC", kEn, Condition::Result),
    jump("SPBN", kDe, Condition::Result, true),
    jump("JCN", kEn, Condition::Result, true),
    jump("SPBB", kDe, Condition::Result, false, true),
    jump("JCB", kEn, Condition::Result, false, true),
    jump("SPBNB", kDe, Condition::Result, true, true),
    jump("JNB", kEn, Condition::Result, true, true),
    jump("SPBI", kDe, Condition::Saved),
    jump("JBI", kEn, Condition::Saved),
    jump("SPBIN", kDe, Condition::Saved, true),
    jump("JNBI", kEn, Condition::Saved, true),
    end("BE", kBoth),
    end("BEA", kDe),
    end("BEU", kEn),
    end("BEB", kDe, Condition::Result),
    end("BEC", kEn, Condition::Result),
    Operator{"CALL", Call, 1},
    Operator{"UC", Call, 1},
    Operator{"CC", Call, 1, kBoth, Join::And, false, Condition::Result},
    Operator{"L", Load, 1},
    Operator{"LC", LoadBcd, 1},
    Operator{"T", Transfer, 1},
    compare("==I", AstOp::Equal, false),
    compare("<>I", AstOp::NotEqual, false),
    compare(">I", AstOp::Greater, false),
    compare("<I", AstOp::Less, false),
    compare(">=I", AstOp::GreaterEqual, false),
    compare("<=I", AstOp::LessEqual, false),
    compare("==D", AstOp::Equal, true),
    compare("<>D", AstOp::NotEqual, true),
    compare(">D", AstOp::Greater, true),
    compare("<D", AstOp::Less, true),
    compare(">=D", AstOp::GreaterEqual, true),
    compare("<=D", AstOp::LessEqual, true),
    Operator{"+I", Add},
    Operator{"-I", Subtract},
    Operator{"ITB", ToBcd},
    Operator{"TAK", Swap},
    timer("SI", kDe, "SI"),
    timer("SP", kEn, "SI"),
    timer("SV", kDe, "SV"),
    timer("SE", kEn, "SV"),
    timer("SE", kDe, "SE"),
    timer("SD", kEn, "SE"),
    timer("SS", kBoth, "SS"),
    timer("SA", kDe, "SA"),
    timer("SF", kEn, "SA"),
    Operator{"FR", Release, 1},
    Operator{"ZV", Count, 1, kDe},
    Operator{"CU", Count, 1, kEn},
    Operator{"ZR", Count, 1, kDe, Join::And, true},
    Operator{"CD", Count, 1, kEn, Join::And, true},
    Operator{"MCRA", ZoneOn},
    Operator{"MCR(", ZoneOpen},
    Operator{")MCR", ZoneClose},
    Operator{"MCRD", ZoneOff},
    Operator{"NOP", Nothing, 1},
    Operator{"BLD", Nothing, 1},
    Operator{"__STWRST", ResetStatus},
    check("__ASSERT==", AstOp::Equal),
    check("__ASSERT<>", AstOp::NotEqual),
    check("__ASSERT>", AstOp::Greater),
    check("__ASSERT<", AstOp::Less),
    check("__ASSERT>=", AstOp::GreaterEqual),
    check("__ASSERT<=", AstOp::LessEqual),
};

}  // namespace

const Operator* find_operator(std::string_view upper_name,
                              Mnemonics mnemonics) {
  for (const Operator& op : kOperators) {
    if (op.name != upper_name) continue;
    const bool fits = mnemonics == Mnemonics::Both ||
                      op.mnemonics == Mnemonics::Both ||
                      op.mnemonics == mnemonics;
    if (fits) return &op;
  }
  return nullptr;
}

std::vector<std::string_view> operator_names() {
  std::vector<std::string_view> names;
  names.reserve(kOperators.size());
  for (const Operator& op : kOperators) names.push_back(op.name);
  return names;
}

}  // namespace rung::stl
