#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "analysis/program.h"
#include "frontend/ast.h"
#include "frontend/error_limit.h"

namespace rung::build {

/// What a dialect says about a name.
enum class NameClass : std::uint8_t {
  Unknown,     // not a name of the dialect
  Memory,      // type by use
  BitInput,    // sim I0..I8
  BitOutput,   // sim Q0..Q8
  WordInput,   // sim IW0 IW1, yun A0..A5
  WordOutput,  // sim QW0 QW1
  BitPin,      // yun pin0..pin13: direction by use
};

NameClass classify_name(std::string_view dialect, std::string_view name);

/// A name of the rungs, the initial values or the plant.
struct Symbol {
  std::string_view name;
  SourceRange where;  // first mention; in the rungs, if they have one
  NameClass name_class = NameClass::Memory;
  bool in_rungs = false;
  bool is_word = false;
  const AstAssignment* written = nullptr;            // first rung
  const AstPlantStatement* plant_written = nullptr;  // first statement
  const AstAssignment* initial = nullptr;            // the last one
  CellId cell;                                       // of those in rungs
};

using SymbolIndex = std::uint32_t;

/// All names of a script, in the order of their first mention, with who
/// writes them and of which type they are.
class SymbolTable {
 public:
  /// Errors: names that the dialect does not have or that name functions
  ///         (RP020, RP022); doubtful names (RP035) are warnings.
  SymbolTable(const Ast& ast, ErrorLimit& errors);

  std::vector<Symbol>& symbols() { return symbols_; }
  const std::vector<Symbol>& symbols() const { return symbols_; }
  /// Of the Name node at an index of Ast::nodes.
  const Symbol& of_node(std::uint32_t node) const {
    return symbols_[of_node_[node]];
  }
  const Symbol& named(std::string_view name) const {
    return symbols_[by_name_.at(name)];
  }

 private:
  SymbolIndex intern(std::string_view name, const SourceRange& where,
                     bool in_rung);
  void collect_nodes(const AstExpression& expression, bool in_rung);
  void check_names();
  void check_name(const Symbol& symbol);
  void infer_types();

  const Ast* ast_;
  ErrorLimit* errors_;
  std::vector<Symbol> symbols_;
  std::unordered_map<std::string_view, SymbolIndex> by_name_;
  std::vector<SymbolIndex> of_node_;
};

/// "T", "ORN", ...: all functions that rungs of the dialect may call.
std::vector<std::string_view> function_names(std::string_view dialect);

/// An element's operation by the name that scripts use; nulls when there is
/// none. Edges are no part of the script dialects.
FoundOperation script_operation(std::string_view dialect,
                                std::string_view name);

}  // namespace rung::build
