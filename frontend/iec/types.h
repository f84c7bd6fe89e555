#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/statements.h"

namespace rung::iec {

struct Symbol;

enum class Kind : std::uint8_t { Bool, Integer, Time };

/// An elementary type that is supported. There is one object of each, so types
/// are compared by their addresses.
struct Type {
  std::string_view name;  // "DINT"; `an integer` of literals
  Kind kind = Kind::Bool;
  std::int64_t low = 0;
  std::int64_t high = 1;
  std::string_view wrap = {};  // the conversion that makes a result fit

  CellShape shape() const { return {kind != Kind::Bool, low, high}; }
  bool holds(std::int64_t value) const { return low <= value && value <= high; }
};

extern const Type kBool;
extern const Type kInt;
extern const Type kTime;
/// Of an integer that is written without a type: it takes the other operand's.
extern const Type kLiteral;

/// By its name in capitals; null when there is none.
const Type* find_type(std::string_view upper_name);
std::vector<std::string_view> type_names();

/// What an expression is worth.
struct Value {
  Expression nodes;
  const Type* type = &kBool;
  std::optional<std::int64_t> constant;  // then nodes are one leaf
  SourceRange where;
  Symbol* symbol = nullptr;  // where nodes are one leaf that reads it
};

/// A literal of the source: TRUE, 12, 16#ff, INT#-5, T#1s500ms, 1_000. The
/// type is that which it says, BOOL, TIME or kLiteral.
struct Literal {
  const Type* type = &kLiteral;
  std::int64_t value = 0;
};
std::optional<Literal> read_literal(std::string_view text);

/// As above, but of this type: what a variable's initial value is, `-5` too.
std::optional<std::int64_t> read_initial(std::string_view text,
                                         const Type& type);

/// The milliseconds of a TIME literal; no value when it is none, is not whole
/// milliseconds, or is longer than 24 days.
std::optional<std::int64_t> milliseconds_of(std::string_view literal);

/// `%IX0.1` for every way to write it; empty when it is no address of a bit, a
/// byte (B), a word of 16 bits (W) or of 32 bits (D).
std::string address_key(std::string_view text);
/// What an address of this size (X, B, W, D) holds, if nothing declares it.
const Type& address_type(char size);
/// Does a variable of this type fit an address of this size?
bool fits_address(const Type& type, char size);

}  // namespace rung::iec
