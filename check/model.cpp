#include "check/model.h"

#include <algorithm>

namespace rung::check {
namespace {

/// Times and counts without an end count as this much where bounds are asked
/// for: no run gets there in 100,000 years.
constexpr std::int64_t kFar = Terms::kExact / 2;

bool is_name_part(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_';
}

std::int64_t divided(std::int64_t a, std::int64_t b) {
  return b == 0 ? 0 : a / b;
}

std::int64_t wrapped(std::int64_t value, std::int64_t bits) {
  const bool has_sign = bits < 0;
  const std::uint64_t count = std::uint64_t{1} << (has_sign ? -bits : bits);
  const auto low = static_cast<std::int64_t>(static_cast<std::uint64_t>(value) &
                                             (count - 1));
  const auto half = static_cast<std::int64_t>(count / 2);
  return has_sign && low >= half ? low - 2 * half : low;
}

/// Far from anything exact, it stays at the ends of 64 bits.
std::int64_t calculate(Op op, std::int64_t a, std::int64_t b) {
  std::int64_t result = 0;
  if (op == Op::Add) {
    return __builtin_add_overflow(a, b, &result)
               ? (a < 0 ? INT64_MIN : INT64_MAX)
               : result;
  }
  if (op == Op::Subtract) {
    return __builtin_sub_overflow(a, b, &result)
               ? (a < 0 ? INT64_MIN : INT64_MAX)
               : result;
  }
  return __builtin_mul_overflow(a, b, &result)
             ? ((a < 0) != (b < 0) ? INT64_MIN : INT64_MAX)
             : result;
}

std::int64_t compute(const Term& term, std::int64_t a, std::int64_t b,
                     std::int64_t c) {
  switch (term.op) {
    case Op::Not:
      return a == 0 ? 1 : 0;
    case Op::And:
      return a & b;
    case Op::Or:
      return a | b;
    case Op::Xor:
      return a ^ b;
    case Op::Equal:
      return a == b ? 1 : 0;
    case Op::Less:
      return a < b ? 1 : 0;
    case Op::LessEqual:
      return a <= b ? 1 : 0;
    case Op::Add:
    case Op::Subtract:
    case Op::Multiply:
      return calculate(term.op, a, b);
    case Op::Divide:
      return divided(a, term.value);
    case Op::Wrap:
      return wrapped(a, term.value);
    case Op::Choose:
      return a != 0 ? b : c;
    case Op::Bit:
    case Op::Number:
    case Op::State:
    case Op::Input:
      break;
  }
  return term.value;
}

}  // namespace

Value Model::add_input(const std::string& name, bool word, std::int64_t low,
                       std::int64_t high) {
  const auto index = static_cast<std::int64_t>(inputs.size());
  const Value now = terms_.leaf(Op::Input, word, index, low, high);
  inputs.push_back({now, low, high});
  scan_names.add(name, now);
  return now;
}

std::uint32_t Model::add_state(std::string name, bool word,
                               std::int64_t initial) {
  const auto index = static_cast<std::uint32_t>(states.size());
  const Value now =
      terms_.leaf(Op::State, word, index, word ? -kFar : 0, word ? kFar : 1);
  states.push_back({std::move(name), now, now, initial, {}, {}});
  return index;
}

void Model::claim(std::uint32_t state, std::optional<std::int64_t> low,
                  std::optional<std::int64_t> high) {
  StateVariable& variable = states[state];
  variable.low = low;
  variable.high = high;
  terms_.set_leaf_bounds(variable.now.id, low.value_or(-kFar),
                         high.value_or(kFar));
}

void Names::add(const std::string& text, Value value) {
  const auto [entry, is_new] = names_.try_emplace(text, value);
  if (!is_new && entry->second.id != value.id) ambiguous_.insert(text);
  const auto at = std::lower_bound(lengths_.begin(), lengths_.end(),
                                   text.size(), std::greater<>());
  if (at == lengths_.end() || *at != text.size()) {
    lengths_.insert(at, text.size());
  }
}

std::optional<Value> Names::find(const std::string& text) const {
  const auto found = names_.find(text);
  if (found == names_.end() || ambiguous_.count(text) != 0) return {};
  return found->second;
}

std::size_t Names::longest(std::string_view text) const {
  for (const std::size_t length : lengths_) {
    if (length > text.size()) continue;
    const bool ends = length == text.size() || !is_name_part(text[length]) ||
                      !is_name_part(text[length - 1]);
    if (ends && names_.count(std::string(text.substr(0, length))) != 0) {
      return length;
    }
  }
  return 0;
}

void Model::name(const std::string& text, Value value) {
  names.add(text, value);
  scan_names.add(text, value);
}

std::vector<std::int64_t> evaluate(const Terms& terms,
                                   const std::vector<std::int64_t>& states,
                                   const std::vector<std::int64_t>& inputs) {
  std::vector<std::int64_t> values(terms.size());
  for (std::uint32_t i = 0; i < terms.size(); ++i) {
    const Term& term = terms[i];
    if (term.op == Op::State || term.op == Op::Input) {
      const std::vector<std::int64_t>& from =
          term.op == Op::State ? states : inputs;
      values[i] = from[static_cast<std::size_t>(term.value)];
    } else {
      values[i] = compute(term, values[term.a], values[term.b], values[term.c]);
    }
  }
  return values;
}

}  // namespace rung::check
