#include "analysis/build_program_names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "analysis/build_program_number.h"
#include "base/text.h"

namespace rung::build {
namespace {

struct NameRow {
  std::string_view prefix;
  std::uint32_t count;
  NameClass name_class;
};
constexpr std::array<NameRow, 3> kYunNames = {{
    {"y", 16, NameClass::Memory},
    {"pin", 14, NameClass::BitPin},
    {"A", 6, NameClass::WordInput},
}};
constexpr std::array<NameRow, 4> kSimNames = {{
    {"I", 9, NameClass::BitInput},
    {"Q", 9, NameClass::BitOutput},
    {"IW", 2, NameClass::WordInput},
    {"QW", 2, NameClass::WordOutput},
}};

constexpr std::int64_t kNoNumber = -1;

/// The number behind `prefix`, without leading zeros; kNoNumber when there is
/// none. Large ones are all alike.
std::int64_t number_after(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix)) return kNoNumber;
  name.remove_prefix(prefix.size());
  if (name.empty() || (name.size() > 1 && name[0] == '0')) return kNoNumber;
  std::int64_t value = 0;
  for (const char c : name) {
    if (c < '0' || c > '9') return kNoNumber;
    value = std::min<std::int64_t>(value * 10 + (c - '0'), 1'000'000);
  }
  return value;
}

/// A point that the simulator does not have, such as I9 or q0: nothing sets or
/// shows it.
bool is_missing_point(std::string_view name) {
  std::string upper(name);
  std::transform(upper.begin(), upper.end(), upper.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return std::any_of(
      kSimNames.begin(), kSimNames.end(), [&](const NameRow& row) {
        const std::int64_t number = number_after(upper, row.prefix);
        return number >= row.count || (number != kNoNumber && upper != name);
      });
}

std::vector<std::string> yun_names() {
  std::vector<std::string> names;
  for (const NameRow& row : kYunNames) {
    for (std::uint32_t i = 0; i < row.count; ++i) {
      names.push_back(std::string(row.prefix) + std::to_string(i));
    }
  }
  return names;
}

bool is_arithmetic(AstOp op) {
  return op == AstOp::Negate || op == AstOp::Add || op == AstOp::Subtract ||
         op == AstOp::Multiply || op == AstOp::Divide;
}

/// Does the value make its target a word? 0 and 1 serve as bits as well.
bool is_word_value(const AstNode& root) {
  if (is_arithmetic(root.op)) return true;
  if (root.op != AstOp::Number) return false;
  const auto value = parse_number(root.text);
  return !value || !value->is_whole() ||
         (value->numerator != 0 && value->numerator != 1);
}

}  // namespace

NameClass classify_name(std::string_view dialect, std::string_view name) {
  const auto matches = [name](const NameRow& row) {
    const std::int64_t number = number_after(name, row.prefix);
    return number != kNoNumber && number < row.count;
  };
  if (dialect == "yun") {
    const auto* const row =
        std::find_if(kYunNames.begin(), kYunNames.end(), matches);
    return row == kYunNames.end() ? NameClass::Unknown : row->name_class;
  }
  const auto* const row =
      std::find_if(kSimNames.begin(), kSimNames.end(), matches);
  return row == kSimNames.end() ? NameClass::Memory : row->name_class;
}

FoundOperation script_operation(std::string_view dialect,
                                std::string_view name) {
  const FoundOperation found = find_operation(dialect, name);
  const bool edge =
      found.kind != nullptr && found.kind->family == ElementFamily::Edge;
  return edge ? FoundOperation{} : found;
}

std::vector<std::string_view> function_names(std::string_view dialect) {
  std::vector<std::string_view> names;
  for (const ElementKind& kind : element_kinds()) {
    if (kind.dialect != dialect) continue;
    for (const ElementOperation& operation : kind.operations) {
      names.push_back(operation.name);
    }
  }
  if (dialect == "yun") {
    names.emplace_back("ORN");
    names.emplace_back("Cmp");
  }
  return names;
}

SymbolTable::SymbolTable(const Ast& ast, ErrorLimit& errors)
    : ast_(&ast), errors_(&errors), of_node_(ast.nodes.size()) {
  for (const AstAssignment& rung : ast.rungs) {
    const SymbolIndex target = intern(rung.target, rung.target_where, true);
    if (symbols_[target].written == nullptr) symbols_[target].written = &rung;
    collect_nodes(rung.value, true);
  }
  for (const AstAssignment& initial : ast.initials) {
    const SymbolIndex target =
        intern(initial.target, initial.target_where, false);
    symbols_[target].initial = &initial;
    collect_nodes(initial.value, false);
  }
  for (const AstPlantStatement& statement : ast.plant) {
    collect_nodes(statement.value, false);
    if (statement.kind != AstPlantStatement::Kind::Assign) continue;
    const SymbolIndex target =
        intern(statement.target, statement.target_where, false);
    if (symbols_[target].plant_written == nullptr) {
      symbols_[target].plant_written = &statement;
    }
  }
  check_names();
  infer_types();
}

SymbolIndex SymbolTable::intern(std::string_view name, const SourceRange& where,
                                bool in_rung) {
  const auto [at, added] =
      by_name_.emplace(name, static_cast<SymbolIndex>(symbols_.size()));
  if (added) {
    Symbol symbol;
    symbol.name = name;
    symbol.where = where;
    symbol.name_class = classify_name(ast_->dialect, name);
    symbol.is_word = symbol.name_class == NameClass::WordInput ||
                     symbol.name_class == NameClass::WordOutput;
    symbols_.push_back(symbol);
  }
  if (in_rung) symbols_[at->second].in_rungs = true;
  return at->second;
}

void SymbolTable::collect_nodes(const AstExpression& expression, bool in_rung) {
  for (std::uint32_t i = expression.begin; i < expression.end; ++i) {
    const AstNode& node = ast_->nodes[i];
    if (node.op != AstOp::Name) continue;
    of_node_[i] = intern(node.text, node.where, in_rung);
  }
}

void SymbolTable::check_names() {
  for (const Symbol& symbol : symbols_) {
    if (symbol.in_rungs) check_name(symbol);
  }
}

void SymbolTable::check_name(const Symbol& symbol) {
  const std::string name = "`" + std::string(symbol.name) + "`";
  if (script_operation(ast_->dialect, symbol.name).kind != nullptr ||
      (ast_->dialect == "yun" &&
       (symbol.name == "ORN" || symbol.name == "Cmp"))) {
    errors_->error("RP022", symbol.where,
                   name + " is a function and cannot be used as a name");
    return;
  }
  if (symbol.name_class == NameClass::Unknown) {
    if (errors_->is_full()) {
      errors_->error("RP020", symbol.where, {});
      return;
    }
    const std::vector<std::string> names = yun_names();
    errors_->error("RP020", symbol.where,
                   name + " is no name of the yun dialect" +
                       did_you_mean(symbol.name, {names.begin(), names.end()}) +
                       ": names are y0..y15, pin0..pin13 and A0..A5");
  } else if (ast_->dialect == "sim" && is_missing_point(symbol.name)) {
    errors_->report(
        {.code = "RP035",
         .severity = Severity::Warning,
         .where = symbol.where,
         .message = name +
                    " is a memory cell: the simulator has I0..I8, Q0..Q8, "
                    "IW0, IW1, QW0 and QW1 only",
         .labels = {}});
  }
}

/// A memory cell is a word when some word expression is assigned to it; a
/// cell that is copied passes its type on.
void SymbolTable::infer_types() {
  std::vector<std::vector<SymbolIndex>> copied_to(symbols_.size());
  std::vector<SymbolIndex> work;
  const auto make_word = [&](SymbolIndex index) {
    if (symbols_[index].name_class != NameClass::Memory) return;
    if (symbols_[index].is_word) return;
    symbols_[index].is_word = true;
    work.push_back(index);
  };
  const auto assign = [&](std::string_view target, const AstExpression& value) {
    if (!value.has_value()) return;
    const SymbolIndex index = by_name_.at(target);
    const AstNode& root = ast_->nodes[value.root()];
    if (root.op == AstOp::Name) {
      copied_to[of_node_[value.root()]].push_back(index);
    } else if (is_word_value(root)) {
      make_word(index);
    }
  };
  for (SymbolIndex i = 0; i < symbols_.size(); ++i) {
    if (symbols_[i].is_word) work.push_back(i);
  }
  for (const AstAssignment& rung : ast_->rungs) assign(rung.target, rung.value);
  for (const AstAssignment& initial : ast_->initials) {
    assign(initial.target, initial.value);
  }
  for (const AstPlantStatement& statement : ast_->plant) {
    if (statement.kind == AstPlantStatement::Kind::Assign) {
      assign(statement.target, statement.value);
    }
  }
  while (!work.empty()) {
    const SymbolIndex index = work.back();
    work.pop_back();
    for (const SymbolIndex target : copied_to[index]) make_word(target);
  }
}

}  // namespace rung::build
