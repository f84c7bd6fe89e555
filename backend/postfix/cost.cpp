#include "backend/postfix/cost.h"

#include <algorithm>
#include <iterator>

#include "base/postfix_format.h"

namespace rung {
namespace {

using postfix::Opcode;

struct Row {
  std::uint8_t opcode;
  std::uint16_t cycles;
};

constexpr Row row(Opcode opcode, std::uint16_t cycles) {
  return {static_cast<std::uint8_t>(opcode), cycles};
}

// In the order of the opcodes. The first six are the machine's fast ones.
constexpr Row kRows[] = {
    row(Opcode::False, 149),
    row(Opcode::True, 149),
    row(Opcode::ReadBit, 19),
    row(Opcode::WriteBit, 20),
    row(Opcode::Not, 23),
    row(Opcode::And, 16),
    row(Opcode::Or, 19),
    row(Opcode::Xor, 22),
    row(Opcode::SkipFalse, 262),
    row(Opcode::SkipTrue, 262),
    row(Opcode::Push8, 237),
    row(Opcode::Push16, 237),
    row(Opcode::Push32, 249),
    row(Opcode::ReadWord, 255),
    row(Opcode::WriteWord, 500),
    row(Opcode::Add, 454),
    row(Opcode::Subtract, 459),
    row(Opcode::Multiply, 1273),
    row(Opcode::Divide, 1175),
    row(Opcode::Negate, 408),
    row(Opcode::Wrap16, 292),
    row(Opcode::ToWord, 265),
    row(Opcode::ToBit, 343),
    row(Opcode::Equal, 432),
    row(Opcode::NotEqual, 434),
    row(Opcode::Less, 439),
    row(Opcode::LessEqual, 442),
    row(Opcode::Greater, 445),
    row(Opcode::GreaterEqual, 442),
    {0x40, 537},  // T (yun)
    {0x41, 355},  // TR
    {0x42, 540},  // T (sim)
    {0x43, 555},  // TOF
    {0x48, 561},  // C (yun)
    {0x49, 366},  // CR
    {0x4a, 637},  // C (sim)
    {0x50, 363},  // RISE
    {0x51, 365},  // FALL
};

constexpr std::uint32_t kScanCycles = 433;
constexpr std::uint32_t kTimerCycles = 80;
constexpr std::uint32_t kSlotCycles = 46;
constexpr std::uint32_t kWideCycles = 99;
// Reading and writing a bit leave the fast loop when the address is wide.
constexpr std::uint32_t kWideBitCycles = 361;

std::uint8_t byte_at(std::string_view binary, std::size_t at) {
  return static_cast<std::uint8_t>(binary[at]);
}

bool has_address(std::uint8_t opcode) {
  const auto code = static_cast<Opcode>(opcode);
  return code == Opcode::ReadBit || code == Opcode::WriteBit ||
         code == Opcode::ReadWord || code == Opcode::WriteWord ||
         postfix::find_element(opcode) != nullptr;
}

/// Bytes of the operands behind an opcode.
std::size_t operand_bytes(std::uint8_t opcode, bool wide) {
  switch (static_cast<Opcode>(opcode)) {
    case Opcode::SkipFalse:
    case Opcode::SkipTrue:
    case Opcode::Push16:
      return 2;
    case Opcode::Push8:
      return 1;
    case Opcode::Push32:
      return 4;
    default:
      break;
  }
  if (!has_address(opcode)) return 0;
  const auto* const element = postfix::find_element(opcode);
  const bool preset = element != nullptr &&
                      element->preset != postfix::ElementCode::Preset::None;
  return (wide ? 2U : 1U) + (preset ? 4U : 0U);
}

std::uint64_t slot_cycles(std::string_view binary, std::size_t slots,
                          std::size_t count) {
  std::uint64_t cycles = 0;
  for (std::size_t slot = 0; slot < count; ++slot) {
    const auto* const kind =
        postfix::find_kind(byte_at(binary, slots + postfix::kSlotBytes * slot));
    const bool timer =
        kind != nullptr &&
        kind->preset == postfix::ElementCode::Preset::Milliseconds;
    cycles += timer ? kTimerCycles : kSlotCycles;
  }
  return cycles;
}

}  // namespace

std::uint32_t avr_cycles(std::uint8_t opcode, bool wide) {
  const auto* const found = std::lower_bound(
      std::begin(kRows), std::end(kRows), opcode,
      [](const Row& row, std::uint8_t wanted) { return row.opcode < wanted; });
  if (found == std::end(kRows) || found->opcode != opcode) return 0;
  if (!wide) return found->cycles;
  return opcode <= static_cast<std::uint8_t>(Opcode::WriteBit)
             ? kWideBitCycles
             : found->cycles + kWideCycles;
}

PostfixCost cost_of_postfix(std::string_view binary) {
  PostfixCost cost;
  cost.bytes = binary.size();
  cost.code_bytes = postfix::read_number(binary, postfix::CodeField, 4);
  cost.bit_stack = postfix::read_number(binary, postfix::BitStackField, 2);
  cost.word_stack = postfix::read_number(binary, postfix::WordStackField, 2);
  const std::size_t bits = postfix::read_number(binary, postfix::BitsField, 2);
  const std::size_t words =
      postfix::read_number(binary, postfix::WordsField, 2);
  const std::size_t slot_count =
      postfix::read_number(binary, postfix::SlotsField, 2);
  const std::size_t slots =
      postfix::kHeaderBytes + bits + (1 + postfix::kRangeBytes) * words;
  const std::size_t code = slots + postfix::kSlotBytes * slot_count;
  cost.avr_cycles = kScanCycles + slot_cycles(binary, slots, slot_count);
  for (std::size_t at = code; at < code + cost.code_bytes;) {
    const bool wide =
        byte_at(binary, at) == static_cast<std::uint8_t>(Opcode::Wide);
    if (wide) ++at;
    const std::uint8_t opcode = byte_at(binary, at);
    cost.avr_cycles += avr_cycles(opcode, wide);
    at += 1 + operand_bytes(opcode, wide);
    ++cost.instructions;
  }
  return cost;
}

}  // namespace rung
