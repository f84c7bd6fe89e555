#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// The numbers and words of the postfix format: docs/postfix.md. The writer
/// (backend/postfix) and the reader (frontend/postfix) share them; the
/// machine (runtime/) has its own, and a test compares.
namespace rung::postfix {

inline constexpr std::string_view kMagic = "\x9eRPF";
inline constexpr std::uint16_t kVersion = 1;
inline constexpr std::size_t kHeaderBytes = 48;
inline constexpr std::size_t kRangeBytes = 12;
inline constexpr std::size_t kSlotBytes = 5;
inline constexpr std::uint8_t kShortCircuitFlag = 1;
inline constexpr std::uint8_t kInitialBit = 4;
inline constexpr std::uint8_t kRoleMask = 3;
inline constexpr std::int64_t kMaxScanMs = 0x7fff'ffff;
inline constexpr std::int64_t kMaxIndex = 0x7fff'ffff;
inline constexpr std::int64_t kWordMin = -0x8000'0000LL;
inline constexpr std::int64_t kWordMax = 0x7fff'ffff;
inline constexpr std::size_t kMaxName = 255;

/// Byte offsets of the header's fields.
enum HeaderField : std::uint8_t {
  VersionField = 4,
  FlagsField = 6,
  DialectField = 7,
  LengthField = 8,
  ChecksumField = 12,
  ScanMinField = 16,
  ScanMaxField = 20,
  BitsField = 24,
  WordsField = 26,
  SlotsField = 28,
  BitStackField = 30,
  WordStackField = 32,
  BranchesField = 34,
  CodeField = 36,
  NamesField = 40,
  NotesField = 44,
};

enum class Opcode : std::uint8_t {
  End = 0x00,
  False = 0x01,
  True = 0x02,
  ReadBit = 0x03,
  WriteBit = 0x04,
  Not = 0x05,
  And = 0x06,
  Or = 0x07,
  Xor = 0x08,
  SkipFalse = 0x09,
  SkipTrue = 0x0a,
  Wide = 0x0f,
  Push8 = 0x10,
  Push16 = 0x11,
  Push32 = 0x12,
  ReadWord = 0x13,
  WriteWord = 0x14,
  Add = 0x15,
  Subtract = 0x16,
  Multiply = 0x17,
  Divide = 0x18,
  Negate = 0x19,
  Wrap16 = 0x1a,
  ToWord = 0x1b,
  ToBit = 0x1c,
  Equal = 0x20,
  NotEqual = 0x21,
  Less = 0x22,
  LessEqual = 0x23,
  Greater = 0x24,
  GreaterEqual = 0x25,
};

/// An instruction without operands: its token in the text form, and how many
/// bits and words it takes and leaves.
struct Operator {
  Opcode opcode = Opcode::End;
  std::string_view token;
  std::uint8_t bits_in = 0;
  std::uint8_t words_in = 0;
  bool word_out = false;  // else a bit
};
std::span<const Operator> operators();
const Operator* find_operator(std::uint8_t opcode);
const Operator* find_operator(std::string_view token);

/// An instruction that works on an element's slot. `kind` is the slot's kind:
/// the opcode of the kind's first instruction.
struct ElementCode {
  std::uint8_t opcode = 0;
  std::uint8_t kind = 0;
  std::uint8_t bits_in = 1;
  enum class Preset : std::uint8_t { None, Milliseconds, Count } preset;
  std::string_view name;     // "TR"
  std::string_view letter;   // of the slot: "T"
  std::string_view kind_id;  // of the slot: "timer-yun"
};
std::span<const ElementCode> element_codes();
const ElementCode* find_element(std::uint8_t opcode);
/// The instruction that stands for its kind; null when there is no such kind.
const ElementCode* find_kind(std::uint8_t kind);
const ElementCode* find_kind(std::string_view kind_id);

/// "none", "yun", "sim"; the index is the dialect's number in the header.
inline constexpr std::array<std::string_view, 3> kDialects = {"none", "yun",
                                                              "sim"};
inline constexpr std::array<std::string_view, 3> kRoles = {"input", "output",
                                                           "memory"};

/// Numbers of a file: `size` bytes, the lowest first. Those that are read are
/// there.
std::uint32_t read_number(std::string_view bytes, std::size_t at, int size);
void append_number(std::string& bytes, std::uint64_t value, int size);

/// CRC-32 of a file: of all its bytes but those of the checksum itself.
std::uint32_t checksum(std::string_view file);

/// Whether a name can stand in a file at all.
bool is_name(std::string_view name);
/// Whether a name may stand without quotes.
bool is_plain_name(std::string_view name);
/// The name as the text form writes it. Precondition: is_name().
void append_name(std::string& text, std::string_view name);
/// Whether a property line can stand in a file: no control characters, no
/// blanks around it, not empty, not too long.
bool is_note(std::string_view note);

}  // namespace rung::postfix
