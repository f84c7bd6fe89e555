// Every refusal has its smallest input here. The loader of the machine and the
// reader of the tools are two programs: both must refuse, for the same reason.

#include <gtest/gtest.h>

#include <cstring>

#include "frontend/postfix/disassemble.h"
#include "rungproof_machine.h"
#include "tests/postfix/image.h"
#include "tests/postfix/machine_adapter.h"

namespace rung {
namespace {

int loaded(const std::string& file) {
  MachineRun run(file);
  return static_cast<int>(run.machine().refusal());
}

std::string code(const std::vector<unsigned>& bytes) {
  return Image::bytes_of(bytes);
}

Image with_code(const std::vector<unsigned>& bytes) {
  Image image;
  image.code = code(bytes);
  return image;
}

// Two bits and a word, memory all, and the deepest stacks that a case asks for.
Image with_word(const std::vector<unsigned>& bytes) {
  Image image = with_code(bytes);
  image.words = 1;
  image.attributes += '\2';
  image.ranges = Image::number(0) + Image::number(0) + Image::number(9);
  image.names += "\1w";
  image.word_stack = 2;
  return image;
}

Image with_slot(unsigned kind, const std::vector<unsigned>& bytes) {
  Image image = with_code(bytes);
  image.slots = 1;
  image.slot_table = code({kind}) + Image::number(0);
  return image;
}

// Short-circuit, with room for one skip.
Image with_skip(const std::vector<unsigned>& bytes) {
  Image image = with_slot(0x50, bytes);
  image.flags = 1;
  image.branches = 1;
  return image;
}

struct Case {
  const char* name;
  int refusal;
  std::string file;
};

std::ostream& operator<<(std::ostream& out, const Case& item) {
  return out << item.name;
}

Image changed(void (*change)(Image&)) {
  Image image;
  change(image);
  return image;
}

std::vector<Case> header_cases() {
  const std::string good = Image().file();
  std::string magic = good;
  magic[3] = 'f';
  std::string length = good;
  length[8] = static_cast<char>(length[8] + 1);
  std::string crc = good;
  crc[12] = static_cast<char>(crc[12] ^ 1);
  return {
      {"empty", 1, ""},
      {"header_cut", 1, good.substr(0, 47)},
      {"magic", 2, sealed(magic)},
      {"version_0", 3, changed([](Image& i) { i.version = 0; }).file()},
      {"version_2", 3, changed([](Image& i) { i.version = 2; }).file()},
      {"version_257", 3, changed([](Image& i) { i.version = 257; }).file()},
      {"length", 4, length},
      {"byte_too_many", 4, good + '\0'},
      {"byte_too_few", 4, good.substr(0, good.size() - 1)},
      {"checksum", 5, crc},
      {"flag", 6, changed([](Image& i) { i.flags = 2; }).file()},
      {"dialect", 6, changed([](Image& i) { i.dialect = 3; }).file()},
      {"scan_turned", 6, changed([](Image& i) { i.scan_min = 101; }).file()},
      {"scan_long", 6,
       changed([](Image& i) { i.scan_max = 0x80000000U; }).file()},
      {"header_only", 7, sealed(good.substr(0, 48))},
      {"sections_long", 7, changed([](Image& i) { i.code_excess = 1; }).file()},
      {"sections_short", 7,
       changed([](Image& i) { i.code_excess = -1; }).file()},
      {"sections_huge", 7,
       changed([](Image& i) { i.code_excess = 0x7ffffff0; }).file()},
      {"sections_wrap", 7,
       changed([](Image& i) { i.code_excess = -16; }).file()},
      {"cells_beyond", 7, changed([](Image& i) { i.bits = 65535; }).file()},
      {"slots_beyond", 7, changed([](Image& i) { i.slots = 65535; }).file()},
  };
}

std::vector<Case> table_cases() {
  Image range = with_word({0});
  range.bit_stack = 0;
  range.word_stack = 0;
  Image high = range;
  high.ranges = Image::number(10) + Image::number(0) + Image::number(9);
  Image low = range;
  low.ranges = Image::number(0xffffffffU) + Image::number(0) + Image::number(9);
  Image word_initial = range;
  word_initial.attributes[2] = '\6';
  Image slot = with_slot(0x41, {0});
  Image index = with_slot(0x40, {0});
  index.slot_table = code({0x40}) + Image::number(0x80000000U);
  return {
      {"role_3", 8, changed([](Image& i) { i.attributes[0] = 3; }).file()},
      {"attribute_8", 8, changed([](Image& i) { i.attributes[0] = 8; }).file()},
      {"word_initial_bit", 8, word_initial.file()},
      {"initial_above", 8, high.file()},
      {"initial_below", 8, low.file()},
      {"slot_kind", 9, slot.file()},
      {"slot_index", 9, index.file()},
      {"name_empty", 10,
       changed([](Image& i) { i.names = std::string("\0\1b", 3); }).file()},
      {"name_missing", 10, changed([](Image& i) { i.names = "\1a"; }).file()},
      {"names_none", 10, changed([](Image& i) { i.names = ""; }).file()},
      {"name_cut", 10, changed([](Image& i) { i.names = "\1a\2b"; }).file()},
      {"name_too_many", 10,
       changed([](Image& i) { i.names = "\1a\1b\1c"; }).file()},
      {"name_quote", 10, changed([](Image& i) { i.names = "\1\"\1b"; }).file()},
      {"name_control", 10,
       changed([](Image& i) { i.names = "\1\n\1b"; }).file()},
      {"name_delete", 10,
       changed([](Image& i) { i.names = "\1\x7f\1b"; }).file()},
      {"note_cut", 11, changed([](Image& i) { i.notes = "\1"; }).file()},
      {"note_short", 11,
       changed([](Image& i) { i.notes = std::string("\2\0x", 3); }).file()},
      {"note_empty", 11,
       changed([](Image& i) { i.notes = std::string("\0\0", 2); }).file()},
      {"note_blank", 11,
       changed([](Image& i) { i.notes = std::string("\2\0 x", 4); }).file()},
      {"note_tab", 11,
       changed([](Image& i) { i.notes = std::string("\2\0x\t", 4); }).file()},
      {"note_line", 11,
       changed([](Image& i) { i.notes = std::string("\3\0x\ny", 5); }).file()},
  };
}

std::vector<Case> code_cases() {
  return {
      {"opcode_0b", 12, with_code({0x0b, 0}).file()},
      {"opcode_1d", 12, with_code({0x1d, 0}).file()},
      {"opcode_26", 12, with_code({0x26, 0}).file()},
      {"opcode_44", 12, with_code({0x44, 0}).file()},
      {"opcode_ff", 12, with_code({0xff, 0}).file()},
      {"wide_not", 12, with_code({0x03, 0, 0x0f, 0x05, 0x04, 1, 0}).file()},
      {"wide_wide", 12, with_code({0x0f, 0x0f, 0x03, 0, 1, 0}).file()},
      {"wide_end", 12, with_code({0x0f, 0}).file()},
      {"no_code", 13, with_code({}).file()},
      {"no_end", 13, with_code({0x03, 0, 0x04, 1}).file()},
      {"end_twice", 13, with_code({0, 0}).file()},
      {"code_after_end", 13, with_code({0, 0x03, 0, 0x04, 1, 0}).file()},
      {"wide_cut", 13, with_code({0x0f}).file()},
      {"address_cut", 13, with_code({0x03}).file()},
      {"wide_address_cut", 13, with_code({0x0f, 0x03, 0}).file()},
      {"push8_cut", 13, with_word({0x10}).file()},
      {"push16_cut", 13, with_word({0x11, 0}).file()},
      {"push32_cut", 13, with_word({0x12, 0, 0, 1}).file()},
      {"preset_cut", 13, with_slot(0x40, {0x03, 0, 0x40, 0, 1, 0, 0}).file()},
      {"skip_cut", 13, with_skip({0x03, 0, 0x09, 0}).file()},
      {"wide_below_256", 14, with_code({0x0f, 0x03, 0, 0, 0x04, 1, 0}).file()},
      {"push16_of_127", 14, with_word({0x11, 0x7f, 0, 0x14, 0, 0}).file()},
      {"push16_of_minus_128", 14,
       with_word({0x11, 0x80, 0xff, 0x14, 0, 0}).file()},
      {"push32_of_32767", 14,
       with_word({0x12, 0xff, 0x7f, 0, 0, 0x14, 0, 0}).file()},
      {"push32_of_minus_32768", 14,
       with_word({0x12, 0, 0x80, 0xff, 0xff, 0x14, 0, 0}).file()},
      {"read_bit_beyond", 15, with_code({0x03, 2, 0x04, 1, 0}).file()},
      {"read_bit_wide", 15, with_code({0x0f, 0x03, 0, 1, 0x04, 1, 0}).file()},
      {"write_bit_beyond", 15, with_code({0x03, 0, 0x04, 2, 0}).file()},
      {"read_word_beyond", 15, with_word({0x13, 1, 0x14, 0, 0}).file()},
      {"write_word_beyond", 15, with_word({0x13, 0, 0x14, 1, 0}).file()},
      {"no_slot", 16, with_code({0x03, 0, 0x50, 0, 0x04, 1, 0}).file()},
      {"slot_beyond", 16,
       with_slot(0x50, {0x03, 0, 0x50, 1, 0x04, 1, 0}).file()},
      {"slot_of_another_kind", 16,
       with_slot(0x48, {0x03, 0, 0x41, 0, 0x04, 1, 0}).file()},
      {"writes_input", 17, with_code({0x03, 1, 0x04, 0, 0}).file()},
  };
}

std::vector<Case> stack_cases() {
  Image deep_bits;  // claims more than it uses
  deep_bits.bit_stack = 2;
  Image flat = Image();
  flat.bit_stack = 0;
  Image words;
  words.word_stack = 1;
  Image skips = Image();
  skips.branches = 1;
  Image two_deep = with_code({0x03, 0, 0x03, 0, 0x06, 0x04, 1, 0});
  Image division = with_word({0x13, 0, 0x10, 0, 0x18, 0x14, 0, 0});
  return {
      {"write_nothing", 18, with_code({0x04, 1, 0}).file()},
      {"not_nothing", 18, with_code({0x05, 0x04, 1, 0}).file()},
      {"and_one", 18, with_code({0x03, 0, 0x06, 0x04, 1, 0}).file()},
      {"add_one", 18, with_word({0x13, 0, 0x15, 0x14, 0, 0}).file()},
      {"word_as_bit", 18, with_word({0x13, 0, 0x04, 1, 0}).file()},
      {"bit_as_word", 18, with_word({0x03, 0, 0x14, 0, 0}).file()},
      {"element_of_nothing", 18, with_slot(0x50, {0x50, 0, 0x04, 1, 0}).file()},
      {"counter_of_two", 18,
       [] {
         Image image = with_slot(
             0x4a, {0x03, 0, 0x03, 0, 0x4a, 0, 1, 0, 0, 0, 0x04, 1, 0});
         image.bit_stack = 2;
         return image.file();
       }()},
      {"value_left_by_rung", 19,
       [] {
         Image image = with_code({0x03, 0, 0x03, 0, 0x04, 1, 0x04, 1, 0});
         image.bit_stack = 2;
         return image.file();
       }()},
      {"value_left_at_end", 19, with_code({0x03, 0, 0}).file()},
      {"divisor_0", 22, division.file()},
      {"divisor_read", 22,
       with_word({0x13, 0, 0x13, 0, 0x18, 0x14, 0, 0}).file()},
      {"divisor_negated", 22,
       with_word({0x13, 0, 0x10, 1, 0x19, 0x18, 0x14, 0, 0}).file()},
      {"depth_above", 23, deep_bits.file()},
      {"depth_0", 23, flat.file()},
      {"depth_of_words", 23, words.file()},
      {"depth_of_skips", 23, skips.file()},
      {"depth_below", 23, two_deep.file()},
  };
}

std::vector<Case> skip_cases() {
  // a, skip if false, b, RISE(0), =b: well formed but for what is named.
  Image inner = with_skip({0x03, 0, 0x09, 4, 0,  //
                           0x03, 0, 0x0a, 3, 0,  //
                           0x03, 0, 0x50, 0, 0x04, 1, 0});
  inner.branches = 2;
  return {
      {"skip_into_operand", 20,
       with_skip({0x03, 0, 0x09, 3, 0, 0x03, 0, 0x50, 0, 0x04, 1, 0}).file()},
      {"skip_past_rung", 20,
       with_skip({0x03, 0, 0x09, 6, 0, 0x03, 0, 0x50, 0, 0x04, 1, 0}).file()},
      {"skip_past_end", 20,
       with_skip({0x03, 0, 0x09, 7, 0, 0x03, 0, 0x50, 0, 0x04, 1, 0}).file()},
      {"skip_far", 20,
       with_skip({0x03, 0, 0x09, 0xff, 0xff, 0x03, 0, 0x50, 0, 0x04, 1, 0})
           .file()},
      {"skip_backward", 20,
       with_skip({0x03, 0, 0x09, 0xfb, 0xff, 0x03, 0, 0x50, 0, 0x04, 1, 0})
           .file()},
      {"skip_nothing", 20,
       with_skip({0x03, 0, 0x09, 0, 0, 0x03, 0, 0x04, 1, 0}).file()},
      {"skip_across", 20, inner.file()},
      {"skip_leaves_two", 20,
       [] {
         Image image = with_skip({0x03, 0, 0x09, 6, 0,        //
                                  0x03, 0, 0x03, 0, 0x50, 0,  //
                                  0x06, 0x04, 1, 0});
         image.bit_stack = 2;
         return image.file();
       }()},
      {"skip_to_end", 19,
       with_skip({0x03, 0, 0x09, 4, 0, 0x03, 0, 0x50, 0, 0}).file()},
  };
}

std::vector<Case> skip_stack_cases() {
  // a, skip if false, b, RISE(0), =b: well formed but for its flag.
  Image strict = with_skip({0x03, 0, 0x09, 4, 0, 0x03, 0, 0x50, 0, 0x04, 1, 0});
  strict.flags = 0;
  return {
      {"skip_of_nothing", 18, with_skip({0x09, 0, 0, 0}).file()},
      // The skipped part takes the bit below the left operand.
      {"skip_takes_below", 18,
       [] {
         Image image = with_skip({0x03, 0, 0x03, 0, 0x09, 6, 0,  //
                                  0x05, 0x03, 0, 0x03, 0, 0x06,  //
                                  0x06, 0x04, 1, 0});
         image.bit_stack = 3;
         return image.file();
       }()},
      {"skip_takes_word_below", 18,
       [] {
         Image image = with_word({0x10, 1, 0x03, 0, 0x09, 3, 0,  //
                                  0x1c, 0x10, 1,                 //
                                  0x1c, 0x06, 0x04, 1, 0});
         image.flags = 1;
         image.branches = 1;
         image.bit_stack = 2;
         image.word_stack = 1;
         return image.file();
       }()},
      {"skip_into_next_rung", 20,
       with_skip({0x03, 0, 0x09, 6, 0, 0x03, 0, 0x04, 1,  //
                  0x03, 0, 0x04, 1, 0})
           .file()},
      {"skip_in_strict", 21, strict.file()},
      // More open at a time than the machine has memory for.
      {"skips_beyond_memory", 23,
       [] {
         std::vector<unsigned> bytes;
         for (unsigned i = 0; i < 20; ++i) {
           bytes.insert(bytes.end(), {0x03, 0, 0x09, 5 * (19 - i) + 4, 0});
         }
         bytes.insert(bytes.end(), {0x03, 0, 0x50, 0, 0x04, 1, 0});
         return with_skip(bytes).file();
       }()},
      {"skip_depth", 23,
       [] {
         Image image =
             with_skip({0x03, 0, 0x09, 4, 0, 0x03, 0, 0x50, 0, 0x04, 1, 0});
         image.branches = 0;
         return image.file();
       }()},
  };
}

class Refused : public ::testing::TestWithParam<Case> {};

TEST_P(Refused, ByTheMachineAndByTheReader) {
  const Case& item = GetParam();
  EXPECT_EQ(loaded(item.file), item.refusal);
  const Disassembly text = disassemble_postfix(item.file);
  ASSERT_FALSE(text.has_value()) << text.text;
  // The reader has bits and words on one stack; there a value of the other
  // type is seen before the missing one.
  if (text.code != 0) {
    EXPECT_EQ(int{text.code}, item.refusal);
  }
}

std::string case_name(const ::testing::TestParamInfo<Case>& info) {
  return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(Header, Refused, ::testing::ValuesIn(header_cases()),
                         case_name);
INSTANTIATE_TEST_SUITE_P(Tables, Refused, ::testing::ValuesIn(table_cases()),
                         case_name);
INSTANTIATE_TEST_SUITE_P(Code, Refused, ::testing::ValuesIn(code_cases()),
                         case_name);
INSTANTIATE_TEST_SUITE_P(Stacks, Refused, ::testing::ValuesIn(stack_cases()),
                         case_name);
INSTANTIATE_TEST_SUITE_P(Skips, Refused, ::testing::ValuesIn(skip_cases()),
                         case_name);
INSTANTIATE_TEST_SUITE_P(SkipStacks, Refused,
                         ::testing::ValuesIn(skip_stack_cases()), case_name);

// Each of the images that the cases above break runs when it is not broken.
TEST(Accepted, TheImagesBeforeTheyAreBroken) {
  Image word = with_word({0x13, 0, 0x10, 1, 0x18, 0x14, 0, 0});
  word.bit_stack = 0;
  const std::vector<std::string> files = {
      Image().file(),
      word.file(),
      with_slot(0x50, {0x03, 0, 0x50, 0, 0x04, 1, 0}).file(),
      with_skip({0x03, 0, 0x09, 4, 0, 0x03, 0, 0x50, 0, 0x04, 1, 0}).file(),
      changed([](Image& i) {
        i.code = std::string(1, '\0');
        i.bit_stack = 0;
      }).file(),
      changed([](Image& i) { i.notes = std::string("\3\0x\ty", 5); }).file(),
  };
  for (const std::string& file : files) {
    EXPECT_EQ(loaded(file), 0);
    EXPECT_EQ(disassemble_postfix(file).refusal, "");
  }
}

TEST(Refused, MemoryThatIsTooSmall) {
  const std::string file = Image().file();
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(file.data());
  const auto length = static_cast<std::uint32_t>(file.size());
  EXPECT_EQ(rungproof::Machine::memory_words(bytes, length), 1U);
  EXPECT_EQ(rungproof::Machine::memory_words(bytes, 47), 0U);
  rungproof::Machine machine;
  EXPECT_EQ(machine.begin(bytes, length, nullptr, 0),
            rungproof::Refusal::NoMemory);
  EXPECT_FALSE(machine.scan(1));
}

// What a refused program leaves behind: nothing to run.
TEST(Refused, AMachineDoesNotScan) {
  MachineRun run(Image().file());
  ASSERT_EQ(run.error(), "");
  EXPECT_TRUE(run.scan(1));
  std::string bad = Image().file();
  bad.back() ^= 1;
  std::uint32_t memory[8];
  EXPECT_NE(
      run.machine().begin(reinterpret_cast<const std::uint8_t*>(bad.data()),
                          static_cast<std::uint32_t>(bad.size()), memory, 8),
      rungproof::Refusal::None);
  EXPECT_FALSE(run.scan(1));
  run.machine().reset();
  EXPECT_FALSE(run.scan(1));
  EXPECT_EQ(run.machine().cell_count(), 0U);
  EXPECT_EQ(run.machine().value(0), 0);
  EXPECT_FALSE(run.machine().set(0, 1));
}

const std::string& large_file() {
  static const std::string file = [] {
    Image image =
        with_skip({0x03, 0, 0x09, 4, 0, 0x03, 0, 0x50, 0, 0x04, 1, 0});
    image.words = 1;
    image.attributes += '\2';
    image.ranges = Image::number(0) + Image::number(0) + Image::number(9);
    image.names += "\4wort";
    image.notes = std::string("\5\0reach", 7);
    return image.file();
  }();
  return file;
}

TEST(Refused, TruncatedAnywhere) {
  const std::string& file = large_file();
  ASSERT_EQ(loaded(file), 0);
  for (std::size_t size = 0; size < file.size(); ++size) {
    const std::string cut = file.substr(0, size);
    EXPECT_NE(loaded(cut), 0) << size;
    EXPECT_FALSE(disassemble_postfix(cut).has_value()) << size;
    if (size < 48) continue;
    EXPECT_NE(loaded(sealed(cut)), 0) << size;  // with length and sum put right
    EXPECT_FALSE(disassemble_postfix(sealed(cut)).has_value()) << size;
  }
}

TEST(Refused, AnyOneByteChanged) {
  const std::string& file = large_file();
  for (std::size_t at = 0; at < file.size(); ++at) {
    for (unsigned change = 1; change < 256; ++change) {
      std::string bad = file;
      bad[at] = static_cast<char>(static_cast<unsigned char>(bad[at]) ^ change);
      ASSERT_NE(loaded(bad), 0) << at;
      ASSERT_FALSE(disassemble_postfix(bad).has_value()) << at;
    }
  }
}

// With a right checksum a changed byte may give another program, but never one
// that only the reader accepts; and what the machine accepts, it executes.
TEST(Refused, ReaderAndMachineAgreeOnChangedBytes) {
  const std::string& file = large_file();
  unsigned accepted = 0;
  for (std::size_t at = 0; at < file.size(); ++at) {
    for (unsigned change = 1; change < 256; ++change) {
      std::string bad = file;
      bad[at] = static_cast<char>(static_cast<unsigned char>(bad[at]) ^ change);
      bad = sealed(bad);
      const Disassembly text = disassemble_postfix(bad);
      MachineRun run(bad);
      if (!run.error().empty()) {
        ASSERT_FALSE(text.has_value()) << at << ": " << run.error();
        continue;
      }
      if (!text.has_value()) {
        ASSERT_EQ(int{text.code}, 0) << text.refusal;
      }
      ++accepted;
      run.machine().set(0, 1);
      ASSERT_TRUE(run.scan(1));
      ASSERT_TRUE(run.scan(1));
    }
  }
  EXPECT_GT(accepted, 0U);
}

}  // namespace
}  // namespace rung
