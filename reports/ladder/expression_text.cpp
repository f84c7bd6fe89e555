#include "reports/ladder/expression_text.h"

#include <fmt/format.h>

#include "reports/scan_table.h"
#include "reports/unicode.h"

namespace rung {
namespace {

/// How tightly an operator binds; names and calls most.
enum class Strength : std::uint8_t {
  Or,
  Xor,
  And,
  Compare,
  Add,
  Times,
  Unary,
  Atom,
};

struct Piece {
  std::string text;
  Strength strength = Strength::Atom;
};

struct Infix {
  std::string_view sign;
  Strength strength = Strength::Atom;
};

Infix infix(NodeOp op) {
  switch (op) {
    case NodeOp::And:
      return {"&&", Strength::And};
    case NodeOp::Or:
      return {"||", Strength::Or};
    case NodeOp::Xor:
      return {"^", Strength::Xor};
    case NodeOp::Equal:
      return {"==", Strength::Compare};
    case NodeOp::NotEqual:
      return {"!=", Strength::Compare};
    case NodeOp::Less:
      return {"<", Strength::Compare};
    case NodeOp::LessEqual:
      return {"<=", Strength::Compare};
    case NodeOp::Greater:
      return {">", Strength::Compare};
    case NodeOp::GreaterEqual:
      return {">=", Strength::Compare};
    case NodeOp::Add:
      return {"+", Strength::Add};
    case NodeOp::Subtract:
      return {"-", Strength::Add};
    case NodeOp::Multiply:
      return {"*", Strength::Times};
    case NodeOp::Divide:
      return {"/", Strength::Times};
    case NodeOp::Constant:
    case NodeOp::Read:
    case NodeOp::Not:
    case NodeOp::Negate:
    case NodeOp::Wrap16:
    case NodeOp::Wrap:
    case NodeOp::ToWord:
    case NodeOp::ToBit:
    case NodeOp::Call:
    case NodeOp::Branch:
      return {};
  }
  return {};
}

std::string cut(std::string text) {
  if (text.size() <= kMaxText) return text;
  std::size_t end = kMaxText - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) {
    --end;
  }
  text.resize(end);
  return text + "...";
}

std::string enclosed(const Piece& piece, Strength least) {
  return piece.strength < least ? "(" + piece.text + ")" : piece.text;
}

std::string constant(const Node& node) {
  if (node.type == Type::Bit) return node.value != 0 ? "true" : "false";
  return fmt::format("{}", node.value);
}

class Printer {
 public:
  Printer(const Program& program, const Rung& rung)
      : program_(program), rung_(rung), pieces_(rung.end - rung.begin) {}

  std::vector<std::string> print() {
    std::vector<std::string> out;
    for (std::uint32_t i = rung_.begin; i < rung_.end; ++i) {
      Piece& piece = pieces_[i - rung_.begin];
      piece = piece_of(program_.nodes[i]);
      piece.text = cut(std::move(piece.text));
      out.push_back(piece.text);
    }
    return out;
  }

 private:
  const Piece& at(std::uint32_t node) const {
    return pieces_[node - rung_.begin];
  }

  Piece piece_of(const Node& node) const {
    switch (node.op) {
      case NodeOp::Constant:
        return {constant(node), Strength::Atom};
      case NodeOp::Read:
        return {printable(program_.cells[node.cell].name), Strength::Atom};
      case NodeOp::Not:
        return {"!" + enclosed(at(node.a), Strength::Unary), Strength::Unary};
      case NodeOp::Negate:
        return {"-" + enclosed(at(node.a), Strength::Unary), Strength::Unary};
      case NodeOp::Wrap16:
      case NodeOp::Wrap:
      case NodeOp::ToWord:
        return at(node.a);  // a conversion that scripts do not write
      case NodeOp::ToBit:
        return {enclosed(at(node.a), Strength::Add) + " != 0",
                Strength::Compare};
      case NodeOp::Call:
        return {call(program_.calls[node.call]), Strength::Atom};
      case NodeOp::Branch:
        return {};
      default:
        break;
    }
    const Infix sign = infix(node.op);
    const auto tighter =
        static_cast<Strength>(static_cast<std::uint8_t>(sign.strength) + 1);
    return {fmt::format("{} {} {}", enclosed(at(node.a), sign.strength),
                        sign.sign, enclosed(at(node.b), tighter)),
            sign.strength};
  }

  std::string call(const ElementCall& element) const {
    std::string out = call_text(program_, element);
    out += out.ends_with(')') ? " of " : ", ";
    for (std::size_t i = 0; i < element.arguments.size(); ++i) {
      out += (i == 0 ? "" : ", ") + at(element.arguments[i]).text;
    }
    return out;
  }

  const Program& program_;
  const Rung& rung_;
  std::vector<Piece> pieces_;
};

}  // namespace

std::string call_text(const Program& program, const ElementCall& call) {
  const Instance& instance = program.instances[call.instance];
  std::string out = fmt::format("{}({})", call.operation->name, instance.index);
  for (const ElementParameter& parameter : call.operation->parameters) {
    if (parameter.kind == ParameterKind::Seconds) {
      out += " " + duration(call.parameter);
    } else if (parameter.kind == ParameterKind::Count) {
      out += fmt::format(" {}", call.parameter);
    }
  }
  return out;
}

std::vector<std::string> expression_texts(const Program& program,
                                          const Rung& rung) {
  return Printer(program, rung).print();
}

}  // namespace rung
