#include "frontend/ascii/cells.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>

#include "frontend/token_list.h"

namespace rung::ascii {
namespace {

using Role = AstDeclaration::Kind;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<std::int64_t> number_of(std::string_view text) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, value);
  if (problem != std::errc() || stop != end) return std::nullopt;
  return value;
}

bool is_number(std::string_view text) {
  return is_digit(text.front()) || text.front() == '-';
}

/// %IX0.1, %QW2: an area, a size, numbers.
bool is_address(std::string_view name) {
  if (name.size() < 4 || name[0] != '%') return false;
  if (std::string_view("IQM").find(name[1]) == name.npos) return false;
  if (name[2] != 'X' && name[2] != 'W') return false;
  return is_digit(name.back()) &&
         name.substr(3).find_first_not_of("0123456789.") == name.npos &&
         is_digit(name[3]) && name.find("..") == name.npos;
}

bool is_name(std::string_view name) {
  return !is_digit(name.front()) && name.find_first_of(".%") == name.npos;
}

Role role_of(std::string_view name, bool written) {
  const char area = is_address(name) ? name[1] : (written ? 'Q' : 'I');
  if (area == 'I') return Role::Input;
  return area == 'Q' ? Role::Output : Role::Memory;
}

}  // namespace

Cells::Cells(const Wires& wires, StatementWriter& out, ErrorLimit& errors)
    : out_(out), errors_(errors) {
  for (const Element& element : wires.elements) survey(element);
  check_areas();
  for (const std::string_view name : order_) {
    const Use& use = uses_.at(name);
    const Role role = role_of(name, use.written);
    if (role == Role::Input && use.written) {
      fail("RP052", name, use.where, "is an input: no coil writes it");
    }
    out_.declare(name, use.word ? kInt16Cell : kBitCell, role, use.where);
  }
}

void Cells::fail(std::string_view code, std::string_view name,
                 SourceRange where, std::string_view why) {
  errors_.error(code, where, quoted_excerpt(name) + " " + std::string(why));
}

void Cells::survey(const Element& it) {
  switch (it.symbol) {
    case Symbol::Contact:
    case Symbol::NegatedContact:
      return mention(it.operand, it.operand_where, false, false);
    case Symbol::Coil:
    case Symbol::NegatedCoil:
    case Symbol::Set:
    case Symbol::Reset:
      return mention(it.operand, it.operand_where, false, true);
    case Symbol::Greater:
    case Symbol::Less:
      mention(it.operand, it.operand_where, true, false);
      return mention(it.second, it.second_where, true, false);
    case Symbol::Jump:
    case Symbol::Timer:
      return;
  }
}

void Cells::mention(std::string_view name, SourceRange where, bool word,
                    bool written) {
  if (name.empty()) return;  // it is missing, which is told already
  if (word && is_number(name)) return;
  if (!is_name(name) && !is_address(name)) {
    return fail("RP052", name, where,
                "is no name and no address of a bit or a word: `start`, "
                "`%IX0.1`, `%IW2`");
  }
  if (is_address(name) && (name[2] == 'W') != word) {
    return fail("RP054", name, where,
                word ? "is a bit: a comparison looks at words"
                     : "is a word: contacts and coils have bits");
  }
  const auto [at, fresh] = uses_.emplace(name, Use{word, written, where});
  if (fresh) {
    order_.push_back(name);
  } else if (at->second.word != word) {
    errors_.error("RP054", where,
                  quoted_excerpt(name) + " is used as a bit and as a word",
                  {{at->second.where, "the other is here"}});
  }
  at->second.written = at->second.written || written;
}

// Where a bit and a word of one area may be the same memory.
void Cells::check_areas() {
  std::array<std::string_view, 3> bits;
  for (const std::string_view name : order_) {
    if (!is_address(name) || name[2] != 'X') continue;
    bits[std::string_view("IQM").find(name[1])] = name;
  }
  for (const std::string_view name : order_) {
    if (!is_address(name) || name[2] != 'W') continue;
    const std::string_view bit = bits[std::string_view("IQM").find(name[1])];
    if (bit.empty()) continue;
    fail("RP052", name, uses_.at(name).where,
         "may overlap with a bit of its area: that is not supported");
  }
}

Expression Cells::operand(std::string_view text, SourceRange where) {
  Expression nodes;
  if (text.empty() || !is_number(text)) {
    push_leaf(nodes, AstOp::Name, text, where);
    return nodes;
  }
  const auto value = number_of(text);
  if (!value || *value < -32'768 || *value > 32'767) {
    fail("RP053", text, where, "is no number of 16 bits");
  }
  push_leaf(nodes, AstOp::Number,
            out_.keep_text(std::to_string(value.value_or(0))), where);
  return nodes;
}

}  // namespace rung::ascii
