#include "smt/script/encode.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

#include "smt/script/numbers.h"

namespace rung::script {
namespace {

struct Value {
  bool is_int = false;
  int literal = 0;
  Number number;
};

struct Interval {
  std::int64_t low = 0;
  std::int64_t high = 0;
};

/// Where a number lies if a comparison of it with a constant is true, and if it
/// is not.
struct Split {
  std::vector<int> bits;
  Interval yes;
  Interval no;
};

/// Where the symbols lie that have no definition: read off assertions of the
/// forms (<= n s n), (= r (<= n s n)), (=> hypothesis r), (=> initial (= s n)).
class Domains {
 public:
  explicit Domains(const Script& script)
      : script_(script),
        of_range_(script.symbols.size()),
        always_(script.symbols.size()),
        assumed_(script.symbols.size()),
        initial_(script.symbols.size()) {
    for (const Assertion& assertion : script.assertions) {
      read(script.nodes[assertion.root]);
    }
  }

  std::optional<Interval> of(std::int64_t symbol) const {
    const auto i = static_cast<std::size_t>(symbol);
    if (always_[i]) return always_[i];
    if (!assumed_[i] || !initial_[i]) return std::nullopt;
    return Interval{std::min(assumed_[i]->low, *initial_[i]),
                    std::max(assumed_[i]->high, *initial_[i])};
  }

 private:
  const Node& operand(const Node& node, std::uint32_t i) const {
    return script_.nodes[script_.operands[node.first + i]];
  }
  bool is_symbol(const Node& node, std::string_view name) const {
    return node.op == Op::Symbol &&
           script_.symbols[static_cast<std::size_t>(node.value)].name == name;
  }

  struct Range {
    std::size_t symbol;
    Interval interval;
  };
  std::optional<Range> range(const Node& node) const {
    if (node.op != Op::LessEqual || node.count != 3) return std::nullopt;
    const Node& low = operand(node, 0);
    const Node& symbol = operand(node, 1);
    const Node& high = operand(node, 2);
    if (low.op != Op::Number || high.op != Op::Number) return std::nullopt;
    if (symbol.op != Op::Symbol) return std::nullopt;
    return Range{static_cast<std::size_t>(symbol.value),
                 {low.value, high.value}};
  }

  void read(const Node& node) {
    if (const auto always = range(node)) {
      always_[always->symbol] = always->interval;
    }
    if (node.count != 2) return;
    const Node& a = operand(node, 0);
    const Node& b = operand(node, 1);
    if (node.op == Op::Equal && a.op == Op::Symbol) {
      if (const auto named = range(b)) {
        of_range_[static_cast<std::size_t>(a.value)] = named;
      }
    }
    if (node.op != Op::Implies) return;
    if (is_symbol(a, "hypothesis") && b.op == Op::Symbol) {
      const auto& named = of_range_[static_cast<std::size_t>(b.value)];
      if (named) assumed_[named->symbol] = named->interval;
    }
    if (is_symbol(a, "initial") && b.op == Op::Equal && b.count == 2) {
      const Node& symbol = operand(b, 0);
      const Node& value = operand(b, 1);
      if (symbol.op != Op::Symbol || value.op != Op::Number) return;
      initial_[static_cast<std::size_t>(symbol.value)] = value.value;
    }
  }

  const Script& script_;
  std::vector<std::optional<Range>> of_range_;  // by the Bool that states it
  std::vector<std::optional<Interval>> always_;
  std::vector<std::optional<Interval>> assumed_;
  std::vector<std::optional<std::int64_t>> initial_;
};

class Encoder {
 public:
  explicit Encoder(const Script& script)
      : script_(script),
        domains_(script),
        numbers_(encoded_.gates),
        values_(script.nodes.size()),
        of_symbol_(script.symbols.size()) {}

  Encoded run() {
    for (const Assertion& assertion : script_.assertions) {
      if (encoded_.error.empty()) encode(assertion);
    }
    if (numbers_.overflow()) fail("a number is too wide");
    for (std::size_t i = 0; i < script_.symbols.size(); ++i) {
      const Symbol& symbol = script_.symbols[i];
      if (symbol.is_int || !encoded_.error.empty()) continue;
      encoded_.bools.emplace(symbol.name, symbol_value(i).literal);
    }
    return std::move(encoded_);
  }

 private:
  Gates& gates() { return encoded_.gates; }
  void fail(std::string what) {
    if (encoded_.error.empty()) encoded_.error = std::move(what);
  }

  const Value& symbol_value(std::size_t symbol) {
    std::optional<Value>& value = of_symbol_[symbol];
    if (value) return *value;
    value.emplace();
    value->is_int = script_.symbols[symbol].is_int;
    if (!value->is_int) {
      value->literal = gates().fresh();
    } else if (const auto domain =
                   domains_.of(static_cast<std::int64_t>(symbol))) {
      value->number = numbers_.fresh(domain->low, domain->high);
    } else {
      fail("nothing bounds " + std::string(script_.symbols[symbol].name));
      value->number = Numbers::constant(0);
    }
    return *value;
  }

  /// An equation of a symbol that nothing spoke of before defines it.
  void encode(const Assertion& assertion) {
    const Node& root = script_.nodes[assertion.root];
    std::optional<std::size_t> symbol;
    std::uint32_t begin = assertion.begin;
    if (root.op == Op::Equal && root.count == 2) {
      const Node& left = script_.nodes[script_.operands[root.first]];
      const auto named = static_cast<std::size_t>(left.value);
      if (left.op == Op::Symbol && !of_symbol_[named]) {
        symbol = named;
        ++begin;  // its own node stands first
      }
    }
    for (std::uint32_t i = begin; i < assertion.root; ++i) encode(i);
    if (symbol && !of_symbol_[*symbol]) {
      const Value& value = values_[script_.operands[root.first + 1]];
      if (value.is_int != script_.symbols[*symbol].is_int) fail("sorts");
      of_symbol_[*symbol] = value;
      return;
    }
    if (symbol) encode(assertion.begin);
    encode(assertion.root);
    if (values_[assertion.root].is_int) fail("sorts");
    gates().require({values_[assertion.root].literal});
  }

  const Value& operand(const Node& node, std::uint32_t i) const {
    return values_[script_.operands[node.first + i]];
  }
  bool all(const Node& node, bool is_int) {
    for (std::uint32_t i = 0; i < node.count; ++i) {
      if (operand(node, i).is_int != is_int) fail("sorts");
    }
    return encoded_.error.empty();
  }
  bool arity(const Node& node, std::uint32_t count) {
    if (node.count != count) fail("number of operands");
    return encoded_.error.empty();
  }

  void encode(std::uint32_t index) {
    const Node& node = script_.nodes[index];
    Value& value = values_[index];
    switch (node.op) {
      case Op::Symbol:
        value = symbol_value(static_cast<std::size_t>(node.value));
        break;
      case Op::Number:
        value = {true, 0, Numbers::constant(node.value)};
        break;
      case Op::True:
      case Op::False:
        value.literal = Gates::constant(node.op == Op::True);
        break;
      case Op::Not:
      case Op::And:
      case Op::Or:
      case Op::Xor:
      case Op::Implies:
        if (all(node, false)) value.literal = connective(node);
        break;
      case Op::Equal:
        if (arity(node, 2)) value.literal = equality(node);
        break;
      case Op::Less:
      case Op::LessEqual:
      case Op::Greater:
      case Op::GreaterEqual:
        if (all(node, true)) value.literal = comparison(node);
        break;
      case Op::Ite:
        if (arity(node, 3)) value = choice(node);
        break;
      default:
        if (all(node, true)) value = {true, 0, arithmetic(node)};
        break;
    }
  }

  int connective(const Node& node) {
    int result = operand(node, 0).literal;
    if (node.op == Op::Not) return arity(node, 1) ? -result : result;
    if (node.op == Op::Implies) {
      if (!arity(node, 2)) return result;
      return gates().disjunction(-result, operand(node, 1).literal);
    }
    for (std::uint32_t i = 1; i < node.count; ++i) {
      const int next = operand(node, i).literal;
      if (node.op == Op::And) result = gates().conjunction(result, next);
      if (node.op == Op::Or) result = gates().disjunction(result, next);
      if (node.op == Op::Xor) result = gates().exclusive(result, next);
    }
    return result;
  }

  int equality(const Node& node) {
    const Value& a = operand(node, 0);
    const Value& b = operand(node, 1);
    if (a.is_int != b.is_int) fail("sorts");
    if (a.is_int) return numbers_.equal(a.number, b.number);
    return -gates().exclusive(a.literal, b.literal);
  }

  /// Of each operand with the next one.
  int comparison(const Node& node) {
    int result = Gates::kTrue;
    for (std::uint32_t i = 0; i + 1 < node.count; ++i) {
      const Number& a = operand(node, i).number;
      const Number& b = operand(node, i + 1).number;
      int holds = 0;
      if (node.op == Op::Less) holds = numbers_.less(a, b);
      if (node.op == Op::Greater) holds = numbers_.less(b, a);
      if (node.op == Op::LessEqual) holds = -numbers_.less(b, a);
      if (node.op == Op::GreaterEqual) holds = -numbers_.less(a, b);
      result = gates().conjunction(result, holds);
    }
    const bool open = result != Gates::kTrue && result != -Gates::kTrue;
    if (node.count == 2 && open) note_split(node, result);
    return result;
  }

  /// `result` is the comparison's literal.
  void note_split(const Node& node, int result) {
    const Number& a = operand(node, 0).number;
    const Number& b = operand(node, 1).number;
    const bool backwards =
        node.op == Op::Greater || node.op == Op::LessEqual;  // b < a, or not
    const bool negated =
        node.op == Op::LessEqual || node.op == Op::GreaterEqual;
    const Number& left = backwards ? b : a;
    const Number& right = backwards ? a : b;
    Split split;
    if (right.low == right.high) {  // left < constant
      split = {left.bits, {left.low, right.low - 1}, {right.low, left.high}};
    } else if (left.low == left.high) {  // constant < right
      split = {right.bits, {left.low + 1, right.high}, {right.low, left.low}};
    } else {
      return;
    }
    if (negated) result = -result;
    splits_[result] = split;
    std::swap(split.yes, split.no);
    splits_[-result] = std::move(split);
  }

  /// A choice looks at a number only where its condition says where it lies: so
  /// `x < 9 ? x : 9` is 9 at most, and nothing has to be searched for that.
  Number within_branch(const Number& number, int condition, bool yes) const {
    const auto split = splits_.find(condition);
    if (split == splits_.end() || split->second.bits != number.bits) {
      return number;
    }
    const Interval& lies = yes ? split->second.yes : split->second.no;
    Number narrow = number;
    narrow.low = std::max(number.low, lies.low);
    narrow.high = std::min(number.high, lies.high);
    return narrow.low <= narrow.high ? narrow : number;
  }

  Value choice(const Node& node) {
    const Value& condition = operand(node, 0);
    const Value& yes = operand(node, 1);
    const Value& no = operand(node, 2);
    if (condition.is_int || yes.is_int != no.is_int) fail("sorts");
    if (!encoded_.error.empty()) return {};
    if (yes.is_int) {
      return {
          true, 0,
          numbers_.choose(condition.literal,
                          within_branch(yes.number, condition.literal, true),
                          within_branch(no.number, condition.literal, false))};
    }
    return {
        false, gates().choice(condition.literal, yes.literal, no.literal), {}};
  }

  Number arithmetic(const Node& node) {
    Number result = operand(node, 0).number;
    if (node.op == Op::Subtract && node.count == 1) {
      return numbers_.negate(result);
    }
    if (node.op == Op::Divide || node.op == Op::Modulo) {
      return division(node);
    }
    for (std::uint32_t i = 1; i < node.count; ++i) {
      const Number& next = operand(node, i).number;
      if (node.op == Op::Add) result = numbers_.add(result, next);
      if (node.op == Op::Multiply) result = numbers_.multiply(result, next);
      if (node.op == Op::Subtract) {
        result = numbers_.add(result, numbers_.negate(next));
      }
    }
    return result;
  }

  Number division(const Node& node) {
    if (!arity(node, 2)) return {};
    const Number& by = operand(node, 1).number;
    if (by.low != by.high || by.low == 0) {
      fail("a divisor that is no constant");
      return Numbers::constant(0);
    }
    auto [quotient, remainder] =
        numbers_.divide(operand(node, 0).number, by.low);
    return node.op == Op::Divide ? quotient : remainder;
  }

  const Script& script_;
  Domains domains_;
  Encoded encoded_;
  Numbers numbers_;
  std::vector<Value> values_;                    // by node
  std::vector<std::optional<Value>> of_symbol_;  // those spoken of so far
  std::unordered_map<int, Split> splits_;        // by the comparison's literal
};

}  // namespace

Encoded encode(const Script& script) { return Encoder(script).run(); }

}  // namespace rung::script
