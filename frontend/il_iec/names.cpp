#include "frontend/il_iec/names.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>

#include "frontend/il_iec/token.h"

namespace rung::il_iec {
namespace {

using enum Kind;

constexpr std::array<Pin, 2> kTimerInputs = {{{"IN"}, {"PT", Time}}};
constexpr std::array<Pin, 2> kTimerOutputs = {{{"Q"}, {"ET", Time}}};
constexpr std::array<Pin, 3> kUpInputs = {{{"CU"}, {"R"}, {"PV", Int}}};
constexpr std::array<Pin, 3> kDownInputs = {{{"CD"}, {"LD"}, {"PV", Int}}};
constexpr std::array<Pin, 2> kCounterOutputs = {{{"Q"}, {"CV", Int}}};
constexpr std::array<Pin, 5> kUpDownInputs = {
    {{"CU"}, {"CD"}, {"R"}, {"LD"}, {"PV", Int}}};
constexpr std::array<Pin, 3> kUpDownOutputs = {{{"QU"}, {"QD"}, {"CV", Int}}};
constexpr std::array<Pin, 1> kTriggerInputs = {{{"CLK"}}};
constexpr std::array<Pin, 1> kTriggerOutputs = {{{"Q"}}};
constexpr std::array<Pin, 2> kSetInputs = {{{"S1"}, {"R"}}};
constexpr std::array<Pin, 2> kResetInputs = {{{"S"}, {"R1"}}};
constexpr std::array<Pin, 1> kLatchOutputs = {{{"Q1"}}};

constexpr std::array<Block, 10> kBlocks = {{
    {"CTD", "ctd", kDownInputs, kCounterOutputs},
    {"CTU", "ctu", kUpInputs, kCounterOutputs},
    {"CTUD", "ctud", kUpDownInputs, kUpDownOutputs},
    {"F_TRIG", "f-trig", kTriggerInputs, kTriggerOutputs},
    {"RS", "rs", kResetInputs, kLatchOutputs},
    {"R_TRIG", "r-trig", kTriggerInputs, kTriggerOutputs},
    {"SR", "sr", kSetInputs, kLatchOutputs},
    {"TOF", "tof", kTimerInputs, kTimerOutputs},
    {"TON", "ton", kTimerInputs, kTimerOutputs},
    {"TP", "tp", kTimerInputs, kTimerOutputs},
}};

constexpr std::int64_t kMaxTime = std::numeric_limits<std::int32_t>::max();

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A number that is written in one way only.
bool is_index(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit) &&
         (text.size() == 1 || text[0] != '0');
}

struct Unit {
  std::string_view name;
  std::int64_t milliseconds;
};
// In the order in which a literal has them.
constexpr std::array<Unit, 5> kUnits = {{{"D", 86'400'000},
                                         {"H", 3'600'000},
                                         {"M", 60'000},
                                         {"S", 1000},
                                         {"MS", 1}}};

/// `1_000` without its underscores; none at an end or doubled.
bool drop_underscores(std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '_') continue;
    if (i == 0 || i + 1 == text.size() || text[i + 1] == '_') return false;
  }
  std::erase(text, '_');
  return true;
}

/// One part of a literal, `1.5s`, from `at` on.
std::optional<std::int64_t> read_part(std::string_view text, std::size_t& at,
                                      std::size_t& next_unit) {
  std::int64_t number = 0;
  std::int64_t scale = 1;
  const std::size_t begin = at;
  bool fraction = false;
  while (at < text.size() && (is_digit(text[at]) || text[at] == '.')) {
    if (text[at] == '.') {
      if (fraction || at == begin) return std::nullopt;
      fraction = true;
    } else {
      number = number * 10 + (text[at] - '0');
      if (fraction) scale *= 10;
      if (number > kMaxTime || scale > 1'000'000'000) return std::nullopt;
    }
    ++at;
  }
  if (at == begin || text[at - 1] == '.') return std::nullopt;
  std::size_t end = at;
  while (end < text.size() && !is_digit(text[end]) && text[end] != '.') ++end;
  const std::string_view name = text.substr(at, end - at);
  at = end;
  for (; next_unit < kUnits.size(); ++next_unit) {
    if (kUnits[next_unit].name != name) continue;
    // Only the last part may be a fraction.
    if (fraction && at != text.size()) return std::nullopt;
    const std::int64_t total = number * kUnits[next_unit++].milliseconds;
    if (total % scale != 0) return std::nullopt;
    return total / scale;
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_string(Kind kind) {
  switch (kind) {
    case Bool:
      return "BOOL";
    case Int:
      return "INT";
    case Time:
      return "TIME";
  }
  return "";
}

std::span<const Block> blocks() { return kBlocks; }

const Block* find_block(std::string_view upper_name) {
  const auto* const found = std::find_if(
      kBlocks.begin(), kBlocks.end(),
      [&](const Block& block) { return block.name == upper_name; });
  return found == kBlocks.end() ? nullptr : found;
}

AstDeclaration declaration_of(std::string_view name, Kind kind,
                              AstDeclaration::Kind role, SourceRange where) {
  AstDeclaration result;
  result.kind = role;
  result.word = kind != Bool;
  result.name = name;
  result.where = where;
  if (kind == Int) {
    result.low = std::numeric_limits<std::int16_t>::min();
    result.high = std::numeric_limits<std::int16_t>::max();
  } else if (kind == Time) {
    result.high = kMaxTime;
  }
  return result;
}

std::string address_key(std::string_view text) {
  std::string key = upper(text);
  const bool area =
      key.size() > 2 && (key[1] == 'I' || key[1] == 'Q' || key[1] == 'M');
  if (!area) return {};
  if (is_digit(key[2])) key.insert(2, "X");
  const char size = key[2];
  const std::string_view rest = std::string_view(key).substr(3);
  const std::size_t dot = rest.find('.');
  // `%IX3` may be the same bit as `%IX0.3`, so only one way is read.
  const bool fits = size == 'X' ? dot != std::string_view::npos &&
                                      is_index(rest.substr(0, dot)) &&
                                      is_index(rest.substr(dot + 1))
                                : size == 'W' && is_index(rest);
  return fits ? key : std::string();
}

std::optional<std::int64_t> milliseconds_of(std::string_view literal) {
  std::string text = upper(literal.substr(literal.find('#') + 1));
  if (text.empty() || !drop_underscores(text)) return std::nullopt;
  std::int64_t total = 0;
  std::size_t next_unit = 0;
  for (std::size_t at = 0; at < text.size();) {
    const auto part = read_part(text, at, next_unit);
    if (!part || *part > kMaxTime - total) return std::nullopt;
    total += *part;
  }
  return total;
}

Cell* Names::find_cell(const std::string& key) {
  const auto found = cells_.find(key);
  return found == cells_.end() ? nullptr : &found->second;
}

Instance* Names::find_instance(const std::string& key) {
  const auto found = instances_.find(key);
  return found == instances_.end() ? nullptr : &found->second;
}

SourceRange Names::place_of(const std::string& key) const {
  const auto cell = cells_.find(key);
  if (cell != cells_.end()) {
    return ast_->declarations[cell->second.declaration].where;
  }
  const auto instance = instances_.find(key);
  return instance == instances_.end() ? SourceRange{} : instance->second.where;
}

bool Names::overlaps(const std::string& address) const {
  const char other = address[2] == 'X' ? 'W' : 'X';
  return areas_.contains({address[1], other});
}

std::string_view Names::keep(std::string text) {
  ast_->made_names.push_back(
      std::make_shared<const std::string>(std::move(text)));
  return *ast_->made_names.back();
}

Cell& Names::add(const std::string& key, Cell cell,
                 AstDeclaration declaration) {
  cell.name = declaration.name;
  cell.declaration = static_cast<std::uint32_t>(ast_->declarations.size());
  ast_->declarations.push_back(declaration);
  order_.push_back(key);
  return cells_.emplace(key, cell).first->second;
}

void Names::add_instance(const std::string& key, std::string_view name,
                         const Block& block, SourceRange where) {
  const auto index = static_cast<std::uint32_t>(instances_.size());
  instances_.emplace(key, Instance{name, &block, index, {}, where});
  AstDeclaration declaration;
  declaration.kind = AstDeclaration::Kind::Element;
  declaration.name = block.element;
  declaration.index = index;
  declaration.instance = name;
  declaration.where = where;
  ast_->declarations.push_back(declaration);
}

Cell& Names::pin(const Instance& instance, const Pin& pin, SourceRange where) {
  const std::string key = upper(instance.name) + "." + std::string(pin.name);
  if (Cell* const cell = find_cell(key)) return *cell;
  const std::string_view name =
      keep(std::string(instance.name) + "." + std::string(pin.name));
  Cell cell;
  cell.kind = pin.kind;
  AstDeclaration declaration =
      declaration_of(name, pin.kind, AstDeclaration::Kind::Memory, where);
  declaration.made = true;
  return add(key, cell, declaration);
}

std::string_view Names::make(std::string_view prefix, Kind kind,
                             SourceRange where) {
  const std::string_view name =
      keep(std::string(prefix) + "." + std::to_string(++made_));
  AstDeclaration declaration =
      declaration_of(name, kind, AstDeclaration::Kind::Memory, where);
  declaration.made = true;
  ast_->declarations.push_back(declaration);
  return name;
}

std::vector<std::string_view> Names::known() const {
  std::vector<std::string_view> names;
  for (const AstDeclaration& declaration : ast_->declarations) {
    if (declaration.made) continue;
    const bool element = declaration.kind == AstDeclaration::Kind::Element;
    names.push_back(element ? declaration.instance : declaration.name);
  }
  return names;
}

void Names::finish() {
  for (const std::string& key : order_) {
    const Cell& cell = cells_.at(key);
    AstDeclaration& declaration = ast_->declarations[cell.declaration];
    if (cell.by_use) {
      declaration.kind = cell.written ? AstDeclaration::Kind::Output
                                      : AstDeclaration::Kind::Input;
    }
  }
}

}  // namespace rung::il_iec
