#include "frontend/il_mitsubishi/list_reader.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.h"

namespace rung::melsec {
namespace {

using enum Code;

constexpr std::size_t kBranchDepth = 11;  // of the controllers' MPS stack

constexpr Operator contact_row(std::string_view name, Join join,
                               bool negate = false, Edge edge = Edge::None) {
  return {name, Contact, 1, join, negate, edge};
}
constexpr Operator compare_row(std::string_view name, Join join, AstOp op) {
  return {name, Contact, 2, join, false, Edge::None, op};
}

// OUTI, XOR and XORI are those of mitsubishi-il-simulator.
constexpr std::array kOperators = {
    contact_row("LD", Join::Load),
    contact_row("LDI", Join::Load, true),
    contact_row("LDP", Join::Load, false, Edge::Rising),
    contact_row("LDF", Join::Load, false, Edge::Falling),
    contact_row("AND", Join::And),
    contact_row("ANI", Join::And, true),
    contact_row("ANDP", Join::And, false, Edge::Rising),
    contact_row("ANDF", Join::And, false, Edge::Falling),
    contact_row("OR", Join::Or),
    contact_row("ORI", Join::Or, true),
    contact_row("ORP", Join::Or, false, Edge::Rising),
    contact_row("ORF", Join::Or, false, Edge::Falling),
    contact_row("XOR", Join::Xor),
    contact_row("XORI", Join::Xor, true),
    compare_row("LD=", Join::Load, AstOp::Equal),
    compare_row("LD<>", Join::Load, AstOp::NotEqual),
    compare_row("LD<", Join::Load, AstOp::Less),
    compare_row("LD<=", Join::Load, AstOp::LessEqual),
    compare_row("LD>", Join::Load, AstOp::Greater),
    compare_row("LD>=", Join::Load, AstOp::GreaterEqual),
    compare_row("AND=", Join::And, AstOp::Equal),
    compare_row("AND<>", Join::And, AstOp::NotEqual),
    compare_row("AND<", Join::And, AstOp::Less),
    compare_row("AND<=", Join::And, AstOp::LessEqual),
    compare_row("AND>", Join::And, AstOp::Greater),
    compare_row("AND>=", Join::And, AstOp::GreaterEqual),
    compare_row("OR=", Join::Or, AstOp::Equal),
    compare_row("OR<>", Join::Or, AstOp::NotEqual),
    compare_row("OR<", Join::Or, AstOp::Less),
    compare_row("OR<=", Join::Or, AstOp::LessEqual),
    compare_row("OR>", Join::Or, AstOp::Greater),
    compare_row("OR>=", Join::Or, AstOp::GreaterEqual),
    Operator{"ANB", AndBlock},
    Operator{"ORB", OrBlock},
    Operator{"MPS", Push},
    Operator{"MRD", Read},
    Operator{"MPP", Pop},
    Operator{"INV", Invert},
    Operator{"OUT", Out, 1},
    Operator{"OUTI", OutInverse, 1},
    Operator{"SET", Set, 1},
    Operator{"RST", Reset, 1},
    Operator{"PLS", Rise, 1},
    Operator{"PLF", Fall, 1},
    Operator{"MC", Zone, 2},
    Operator{"MCR", ZoneEnd, 1},
    Operator{"END", End},
    Operator{"NOP", Nothing},
};

std::vector<std::string_view> operator_names() {
  std::vector<std::string_view> names;
  names.reserve(kOperators.size());
  for (const Operator& op : kOperators) names.push_back(op.name);
  return names;
}

AstOp sign_of(Join join) {
  if (join == Join::Or) return AstOp::Or;
  return join == Join::Xor ? AstOp::Xor : AstOp::And;
}

}  // namespace

std::string upper(std::string_view word) {
  std::string result(word);
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

const Operator* find_operator(std::string_view upper_word) {
  const auto* const found =
      std::find_if(kOperators.begin(), kOperators.end(),
                   [&](const Operator& op) { return op.name == upper_word; });
  return found == kOperators.end() ? nullptr : found;
}

SourceRange ListReader::range(const Line& line) const {
  const std::size_t last = std::min(line.count, Line::kMost) - 1;
  return cover(range(line, 0), range(line, last));
}

/// An error leaves no result that the lines below could be blamed for.
void ListReader::fail(std::string_view code, SourceRange where,
                      std::string message) {
  errors_.error(code, where, std::move(message));
  give_up();
}

void ListReader::give_up() {
  forget();
  branches_.clear();
  state_ = State::Broken;
}

void ListReader::forget() {
  stack_.clear();
  blocks_.clear();
  state_ = State::None;
}

void ListReader::find_operators() {
  bool first_scan = false;
  for (const Line& line : list_.lines) {
    operators_.push_back(find_operator(upper(text(line, 0))));
    for (std::size_t i = 1; i < std::min(line.count, Line::kMost); ++i) {
      const std::string word = upper(text(line, i));
      first_scan = first_scan || word == "M8002" || word == "M8003";
    }
  }
  if (first_scan) devices_.write_first_scan(range(list_.lines.front(), 0));
}

void ListReader::run() {
  find_operators();
  for (std::size_t i = 0; i < list_.lines.size(); ++i) execute(i);
  finish();
}

void ListReader::execute(std::size_t index) {
  const Line& line = list_.lines[index];
  const Operator* const op = operators_[index];
  if (op == nullptr) {
    std::string hint;
    if (!errors_.is_full()) {
      hint = did_you_mean(upper(text(line, 0)), operator_names());
    }
    return fail("RP040", range(line, 0),
                quoted_excerpt(text(line, 0)) +
                    " is no instruction that is supported" + hint);
  }
  if (ended_ && op->code != Nothing) {
    return fail("RP047", range(line), "an instruction stands below `END`");
  }
  // A preset stands behind a timer or counter.
  const std::size_t extra = op->code == Out && line.count == 3 ? 1 : 0;
  if (line.count != op->operands + 1U + extra && op->code != Nothing) {
    return fail("RP047", range(line),
                quoted_excerpt(op->name) + " has " +
                    std::to_string(op->operands) + " operands, and here " +
                    std::to_string(line.count - 1) + " are given");
  }
  switch (op->code) {
    case Contact:
      return contact(line, *op);
    case AndBlock:
      return join_blocks(AstOp::And, range(line));
    case OrBlock:
      return join_blocks(AstOp::Or, range(line));
    case Push:
    case Read:
    case Pop:
      return branch(*op, range(line));
    case Invert:
      if (!has_result(range(line))) return;
      push_unary(stack_, AstOp::Not, range(line));
      state_ = State::Live;
      return;
    case ZoneEnd:
      return zone_end(line);
    case End:
      ended_ = true;
      return finish();
    case Nothing:
      return;
    default:
      return output(index, *op);
  }
}

/// A result to go on with. After an error nothing more is said until a new one
/// begins.
bool ListReader::has_result(SourceRange where) {
  if (state_ == State::Live || state_ == State::Taken) return true;
  if (state_ == State::None) {
    fail("RP048", where,
         "there is no result here: a circuit begins with `LD` or its kin");
  }
  return false;
}

bool ListReader::is_whole(SourceRange where) {
  if (!has_result(where)) return false;
  if (blocks_.size() == 1) return true;
  fail("RP047", where,
       std::to_string(blocks_.size()) +
           " blocks stand here side by side: `ANB` or `ORB` joins them");
  return false;
}

void ListReader::begin_block(SourceRange where) {
  if (state_ == State::Live) {
    blocks_.push_back(stack_.size());
    return;
  }
  if (!branches_.empty()) {
    fail("RP047", branch_where_,
         "this `MPS` has no `MPP` above the next circuit");
  }
  forget();
  blocks_.push_back(0);
  result_where_ = where;
  state_ = State::Live;
}

void ListReader::contact(const Line& line, const Operator& op) {
  if (op.join != Join::Load && !has_result(range(line))) return;
  const Expression nodes =
      op.compare == AstOp::Name ? operand(line, op) : comparison(line, op);
  if (nodes.empty()) return;
  if (op.join == Join::Load) begin_block(range(line));
  push_all(stack_, nodes);
  if (op.join != Join::Load) push_binary(stack_, sign_of(op.join), range(line));
  state_ = State::Live;
}

/// Empty: an error was said.
Expression ListReader::operand(const Line& line, const Operator& op) {
  Expression nodes;
  const SourceRange where = range(line, 1);
  const Device* const device = devices_.find(text(line, 1), where);
  if (device == nullptr) {
    give_up();
    return nodes;
  }
  if (device->id.letter == 'D') {
    fail("RP049", where,
         quoted_excerpt(device->name) + " is a register, and a bit is needed");
    return nodes;
  }
  devices_.push_contact(nodes, *device, where);
  if (op.negate) push_unary(nodes, AstOp::Not, where);
  if (op.edge == Edge::None) return nodes;
  // Executed in every scan, whatever stands left of it.
  const std::string_view bit = writer_.keep(
      "edge", kBitCell,
      writer_.call(op.edge == Edge::Rising ? "RISE" : "FALL", nodes,
                   writer_.element("edge", {}, where), {}, where),
      where);
  nodes.clear();
  push_leaf(nodes, AstOp::Name, bit, where);
  return nodes;
}

Expression ListReader::comparison(const Line& line, const Operator& op) {
  Expression nodes;
  push_word(nodes, line.words[1]);
  const std::size_t left = nodes.size();
  push_word(nodes, line.words[2]);
  if (left == 0 || nodes.size() == left) {
    give_up();
    return {};
  }
  push_binary(nodes, op.compare, range(line));
  return nodes;
}

/// A constant, a register or a counter's value; nothing where it is none.
void ListReader::push_word(Expression& nodes, const Word& word) {
  const std::string_view text = list_.text_of(word);
  const SourceRange where = list_.range_of(word);
  if (const auto value = constant_of(text)) {
    push_leaf(nodes, AstOp::Number, writer_.keep_text(std::to_string(*value)),
              where);
    return;
  }
  Device* const device = devices_.find(text, where);
  if (device == nullptr) return;
  if (device->id.letter == 'D') {
    push_leaf(nodes, AstOp::Name, device->name, where);
  } else if (device->id.letter == 'C') {
    push_all(nodes, writer_.call("C.VALUE", {},
                                 devices_.element(*device, where), {}, where));
  } else {
    errors_.error("RP049", where,
                  quoted_excerpt(text) +
                      " cannot be compared: constants, registers and the "
                      "values of counters can");
  }
}

void ListReader::join_blocks(AstOp op, SourceRange where) {
  if (!has_result(where)) return;
  if (blocks_.size() < 2) {
    return fail("RP047", where, "there is one block only: nothing to join");
  }
  blocks_.pop_back();
  push_binary(stack_, op, where);
  state_ = State::Live;
}

void ListReader::branch(const Operator& op, SourceRange where) {
  if (!has_result(where)) return;
  if (op.code == Push) {
    if (branches_.size() == kBranchDepth) {
      return fail("RP047", where,
                  "more than 11 `MPS` are open: the controller keeps 11");
    }
    keep_result(where);
    branches_.push_back(stack_.back().text);
    branch_where_ = where;
    state_ = State::Live;
    return;
  }
  if (branches_.empty()) {
    return fail("RP047", where, "no `MPS` is open here");
  }
  if (state_ != State::Taken) {
    return fail("RP047", where, "no output takes the result above this");
  }
  stack_.clear();
  blocks_.assign(1, 0);
  push_leaf(stack_, AstOp::Name, branches_.back(), where);
  if (op.code == Pop) branches_.pop_back();
  state_ = State::Live;
}

}  // namespace rung::melsec
