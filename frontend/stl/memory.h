#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "frontend/error_limit.h"
#include "frontend/statements.h"

namespace rung::stl {

/// A bit, byte, word or double word of an area: `E 0.1`, `MW 12`.
struct Address {
  char area = 'M';         // E, A, M, L: the German letter
  char letter = 'M';       // as written: I and Q in English
  std::uint32_t byte = 0;  // the first one, which is the highest
  std::uint8_t size = 0;   // bytes; 0: a bit
  std::uint8_t bit = 0;
  std::uint32_t scope = 0;  // of L: the block that it belongs to
};
/// No value when the text is no address. `scope` is the block's, for L.
std::optional<Address> address_of(std::string_view squeezed,
                                  std::uint32_t scope);

Expression bit_constant(bool value, SourceRange where);
/// The value of a constant bit.
std::optional<bool> constant_bit(const Expression& nodes);
void push_number(StatementWriter& writer, Expression& nodes, std::int64_t value,
                 SourceRange where);
/// `nodes op value`, where `value` is a constant.
void push_with(StatementWriter& writer, Expression& nodes, AstOp op,
               std::int64_t value, SourceRange where);

/// What an accumulator holds: 32 bits.
struct Word {
  std::optional<std::uint32_t> constant;
  Expression nodes;   // else: the value, signed
  bool wide = false;  // of 32 bits; else of 16, and the upper half is 0
  bool known = true;  // false: it depends on the path
};

/// The areas. Where accesses of different sizes overlap, cells are the bits or
/// bytes and a word is put together from them; else a word is one cell.
class Memory {
 public:
  Memory(StatementWriter& writer, ErrorLimit& errors)
      : writer_(writer), errors_(errors) {}

  /// All accesses are noted before the first one is made.
  void note(const Address& address);

  /// The name of a bit's cell.
  std::string_view bit(const Address& address, SourceRange where);
  Word load(const Address& address, SourceRange where);
  void store(const Address& address, const Word& value, SourceRange where);

  /// The value as a signed number of 16 or 32 bits, to be read once.
  Expression as_int(const Word& value, bool wide, SourceRange where);
  /// The bits as a number that is not negative, in a made cell.
  std::string_view pattern(const Word& value, bool wide, SourceRange where);

  /// Local data has no value until it is written.
  void begin_block(std::uint32_t scope);
  void mark_written(const Address& address, bool always);
  void check_written(const Address& address, SourceRange where);

 private:
  struct Byte {
    std::uint32_t owner = 0;
    std::uint8_t size = 0;
    bool bits = false;
    bool shared = false;
  };
  using Area = std::pair<std::uint32_t, char>;

  bool is_own(const Address& address) const;
  std::string_view cell(const Address& address, SourceRange where);
  void push_byte(Expression& nodes, const Address& byte, SourceRange where);
  void store_byte(const Address& byte, const Expression& value,
                  SourceRange where);
  void store_constant(const Address& address, std::uint32_t value,
                      SourceRange where);
  Expression digit(std::string_view number, std::uint32_t below,
                   std::uint32_t bits, SourceRange where);

  StatementWriter& writer_;
  ErrorLimit& errors_;
  std::map<Area, std::map<std::uint32_t, Byte>> bytes_;
  std::map<std::string, std::string_view> cells_;
  std::map<char, char> letters_;  // by area: as it was first written
  std::set<std::pair<std::uint32_t, std::uint32_t>> written_;  // scope, bit
};

}  // namespace rung::stl
