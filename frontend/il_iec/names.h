#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/ast.h"

namespace rung::il_iec {

enum class Kind : std::uint8_t { Bool, Int, Time };
std::string_view to_string(Kind kind);

/// An input or an output of a standard function block.
struct Pin {
  std::string_view name;
  Kind kind = Kind::Bool;
};

/// A standard function block: the operands of its call are the inputs in this
/// order, without PT. The first output is the call's own result.
struct Block {
  std::string_view name;     // "TON"
  std::string_view element;  // "ton", in the tables of elements
  std::span<const Pin> inputs;
  std::span<const Pin> outputs;
};
std::span<const Block> blocks();
const Block* find_block(std::string_view upper_name);

/// A variable, or a pin of an instance.
struct Cell {
  std::string_view name;
  Kind kind = Kind::Bool;
  std::uint32_t declaration = 0;  // in Ast::declarations
  bool constant = false;
  std::int64_t initial = 0;
  bool input = false;   // of the program
  bool by_use = false;  // not declared: its role follows from its use
  bool written = false;
};

struct Instance {
  std::string_view name;
  const Block* block = nullptr;
  std::uint32_t index = 0;
  std::optional<std::int64_t> preset;  // PT, as the statements above leave it
  SourceRange where;
};

/// What the names of a text stand for. Keys are in capitals.
class Names {
 public:
  explicit Names(Ast& ast) : ast_(&ast) {}

  Cell* find_cell(const std::string& key);
  Instance* find_instance(const std::string& key);
  bool is_known(const std::string& key) const {
    return cells_.contains(key) || instances_.contains(key);
  }
  /// Where a known name was declared.
  SourceRange place_of(const std::string& key) const;

  Cell& add(const std::string& key, Cell cell, AstDeclaration declaration);
  void add_instance(const std::string& key, std::string_view name,
                    const Block& block, SourceRange where);
  /// The cell of an instance's pin; made where it is new.
  Cell& pin(const Instance& instance, const Pin& pin, SourceRange where);
  /// Addresses, as address_key() gives them, and the keys of their variables.
  void add_address(const std::string& address, const std::string& key) {
    addresses_.emplace(address, key);
    areas_.insert(address.substr(1, 2));
  }
  const std::string* at_address(const std::string& address) const {
    const auto found = addresses_.find(address);
    return found == addresses_.end() ? nullptr : &found->second;
  }
  /// Are there addresses of another size in the same area?
  bool overlaps(const std::string& address) const;
  /// A bit that the text does not name: `run.1`.
  std::string_view make(std::string_view prefix, Kind kind, SourceRange where);

  /// All names, for "did you mean".
  std::vector<std::string_view> known() const;
  /// Roles that only the whole text decides.
  void finish();
  /// Text that the Ast may point into.
  std::string_view keep(std::string text);

 private:
  Ast* ast_;
  std::unordered_map<std::string, Cell> cells_;
  std::unordered_map<std::string, Instance> instances_;
  std::unordered_map<std::string, std::string> addresses_;
  std::set<std::string> areas_;     // "IX", "QW": of the addresses so far
  std::vector<std::string> order_;  // keys of cells_
  std::uint32_t made_ = 0;
};

/// The declaration of a cell of this kind: its range.
AstDeclaration declaration_of(std::string_view name, Kind kind,
                              AstDeclaration::Kind role, SourceRange where);

/// `%IX0.1` for every way to write it; empty when it is no address of a bit or
/// of a word of 16 bits.
std::string address_key(std::string_view text);

/// The milliseconds of a TIME literal; no value when it is none, is not whole
/// milliseconds, or is longer than 24 days.
std::optional<std::int64_t> milliseconds_of(std::string_view literal);

}  // namespace rung::il_iec
