// The format's numbers stand in three places: the host tools' table, the
// machine's, and the definitions of the elements. They must say the same.

#include <gtest/gtest.h>

#include <set>

#include "analysis/element.h"
#include "base/postfix_format.h"
#include "rungproof_format.h"
#include "tests/postfix/image.h"

namespace rung {
namespace {

TEST(PostfixFormat, ElementsAreThoseOfTheDefinitions) {
  std::set<unsigned> defined;
  for (const ElementKind& kind : element_kinds()) {
    for (const ElementOperation& operation : kind.operations) {
      if (operation.opcode == 0) continue;  // the format does not have it
      const auto* code = postfix::find_element(operation.opcode);
      ASSERT_NE(code, nullptr) << operation.name;
      defined.insert(operation.opcode);
      EXPECT_EQ(code->kind, kind.operations.front().opcode) << operation.name;
      EXPECT_EQ(code->kind_id, kind.id);
      EXPECT_EQ(code->letter, kind.letter);
      unsigned bits = 0;
      auto preset = postfix::ElementCode::Preset::None;
      for (const ElementParameter& parameter : operation.parameters) {
        bits += parameter.kind == ParameterKind::Bit ? 1 : 0;
        if (parameter.kind == ParameterKind::Seconds) {
          preset = postfix::ElementCode::Preset::Milliseconds;
        } else if (parameter.kind == ParameterKind::Count) {
          preset = postfix::ElementCode::Preset::Count;
        }
      }
      EXPECT_EQ(code->bits_in, bits) << operation.name;
      EXPECT_EQ(code->preset, preset) << operation.name;
      // `Cnt` is another name of `C`; a file says `C`.
      EXPECT_EQ(code->name, find_operation(operation.opcode).operation->name);
    }
  }
  EXPECT_EQ(defined.size(), postfix::element_codes().size());
}

TEST(PostfixFormat, ElementsAreThoseOfTheMachine) {
  for (unsigned opcode = 0; opcode < 256; ++opcode) {
    const auto byte = static_cast<std::uint8_t>(opcode);
    const std::uint8_t shape = rungproof::shape_of(byte);
    const bool element =
        rungproof::is_element(byte) && shape != rungproof::kNoShape;
    const auto* code = postfix::find_element(byte);
    ASSERT_EQ(code != nullptr, element) << opcode;
    EXPECT_EQ(postfix::find_kind(byte) != nullptr,
              rungproof::is_element_kind(byte));
    if (code == nullptr) continue;
    EXPECT_EQ(code->kind, rungproof::kind_of(byte)) << opcode;
    EXPECT_EQ(code->bits_in, shape & rungproof::kShapeBitsIn) << opcode;
    EXPECT_EQ(code->preset != postfix::ElementCode::Preset::None,
              (shape & rungproof::kShapePreset) != 0)
        << opcode;
    EXPECT_EQ(
        code->preset == postfix::ElementCode::Preset::Milliseconds,
        rungproof::is_element_kind(byte) && rungproof::is_timer_kind(byte))
        << opcode;
  }
}

TEST(PostfixFormat, OperatorsAreThoseOfTheMachine) {
  for (unsigned opcode = 0; opcode < rungproof::kTimerYun; ++opcode) {
    const auto byte = static_cast<std::uint8_t>(opcode);
    const auto* entry = postfix::find_operator(byte);
    if (entry == nullptr) continue;
    const unsigned shape = rungproof::shape_of(byte);
    EXPECT_EQ(entry->bits_in, shape & rungproof::kShapeBitsIn) << opcode;
    EXPECT_EQ(entry->words_in, (shape & rungproof::kShapeWordsIn) >> 2)
        << opcode;
    const unsigned taken = rungproof::kShapeBitsIn | rungproof::kShapeWordsIn;
    EXPECT_EQ(
        entry->word_out ? rungproof::kShapeWordOut : rungproof::kShapeBitOut,
        shape & ~taken)
        << opcode;
  }
}

TEST(PostfixFormat, HeaderIsThatOfTheMachine) {
  EXPECT_EQ(postfix::kMagic,
            Image::bytes_of({rungproof::kMagic0, rungproof::kMagic1,
                             rungproof::kMagic2, rungproof::kMagic3}));
  EXPECT_EQ(unsigned{postfix::kVersion}, unsigned{rungproof::kVersion});
  EXPECT_EQ(postfix::kHeaderBytes, std::size_t{rungproof::kHeaderBytes});
  EXPECT_EQ(postfix::kRangeBytes, std::size_t{rungproof::kRangeBytes});
  EXPECT_EQ(postfix::kSlotBytes, std::size_t{rungproof::kSlotBytes});
  EXPECT_EQ(postfix::kDialects.size(), std::size_t{rungproof::kDialects});
  EXPECT_EQ(int{postfix::ChecksumField}, int{rungproof::kAtChecksum});
  EXPECT_EQ(int{postfix::BitsField}, int{rungproof::kAtBits});
  EXPECT_EQ(int{postfix::NotesField}, int{rungproof::kAtNoteBytes});
}

// The worked value of the CRC-32 in common use.
TEST(PostfixFormat, ChecksumIsTheIeeeOne) {
  // The checksum's own four bytes do not count, so they stand inside.
  EXPECT_EQ(postfix::checksum("123456789"), 0xcbf43926U);
  const std::string file = Image().file();
  std::string other = file;
  other.replace(postfix::ChecksumField, 4, "abcd");
  EXPECT_EQ(postfix::checksum(file), postfix::checksum(other));
}

}  // namespace
}  // namespace rung
