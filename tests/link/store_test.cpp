// The store: wherever the power is cut, the old or the new program is there.

#include <gtest/gtest.h>

#include <random>

#include "tests/link/eeprom.h"

namespace rung {
namespace {

using rungproof::Store;
using Progress = rungproof::Store::Progress;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kSize = 100;

Bytes program(std::uint8_t seed, std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) {
    bytes[i] = static_cast<std::uint8_t>(seed + 7 * i);
  }
  return bytes;
}

Progress write(Store& store, const Eeprom& eeprom, const Bytes& bytes) {
  store.begin(bytes.data(), static_cast<std::uint16_t>(bytes.size()));
  Progress progress = Progress::Working;
  while (progress == Progress::Working && !eeprom.dead()) {
    progress = store.step();
  }
  return progress;
}

Bytes loaded(const Eeprom& eeprom, std::uint8_t age = 0) {
  Eeprom copy = eeprom;
  Store store(copy);
  Bytes bytes(kSize);
  bytes.resize(store.load(age, bytes.data(), kSize));
  return bytes;
}

TEST(Store, IsEmptyAtFirst) {
  EXPECT_TRUE(loaded(Eeprom(kSize)).empty());
  Eeprom cleared(kSize);
  cleared.bytes().assign(kSize, 0);
  EXPECT_TRUE(loaded(cleared).empty());
}

TEST(Store, GivesTheNewestFirst) {
  Eeprom eeprom(kSize);
  Store store(eeprom);
  for (std::uint8_t i = 1; i < 10; ++i) {
    EXPECT_EQ(write(store, eeprom, program(i, 10 + i)), Progress::Done);
    EXPECT_EQ(loaded(eeprom), program(i, 10 + i));
    if (i > 1) {
      EXPECT_EQ(loaded(eeprom, 1), program(i - 1, 9 + i));
    }
  }
}

TEST(Store, WearsNothingThatIsTheSame) {
  Eeprom eeprom(kSize);
  Store store(eeprom);
  for (int i = 0; i < 2; ++i) write(store, eeprom, program(1, 20));
  const std::size_t before = eeprom.writes();
  write(store, eeprom, program(1, 20));
  // The mark twice, of the sequence number a byte, four of the CRC.
  EXPECT_EQ(eeprom.writes() - before, 7U);
}

TEST(Store, WaitsForAStorageThatIsSlow) {
  Eeprom eeprom(kSize);
  eeprom.slow_down(50);
  Store store(eeprom);
  EXPECT_EQ(write(store, eeprom, program(1, 20)), Progress::Done);
  EXPECT_EQ(loaded(eeprom), program(1, 20));
}

TEST(Store, HoldsWhatFitsAndLoadsWhatFits) {
  for (std::size_t size = 0; size < 60; ++size) {
    Eeprom eeprom(size);
    Store store(eeprom);
    ASSERT_LE(2U * store.capacity(), size);
    Bytes buffer(kSize);
    EXPECT_EQ(store.load(0, buffer.data(), kSize), 0);
    if (store.capacity() == 0) continue;
    for (std::uint8_t i = 1; i < 4; ++i) {
      EXPECT_EQ(write(store, eeprom, program(i, store.capacity())),
                Progress::Done);
    }
    EXPECT_EQ(loaded(eeprom), program(3, store.capacity()));
    const auto less = static_cast<std::uint16_t>(store.capacity() - 1);
    EXPECT_EQ(store.load(0, buffer.data(), less), 0);
  }
}

constexpr std::uint8_t kTorn[] = {0x00, 0xff, 0xa5, 0x5a, 0x01, 0x80};

TEST(Store, SurvivesAPowerCutAtEveryByte) {
  const Bytes first = program(3, 20);
  const Bytes second = program(90, 17);
  const Bytes third = program(200, 22);
  Eeprom before(kSize);
  Store store_before(before);
  write(store_before, before, first);
  write(store_before, before, second);
  Eeprom counted = before;
  Store counting(counted);
  write(counting, counted, third);
  const std::size_t writes = counted.writes() - before.writes();
  ASSERT_GE(writes, 30U);
  for (std::size_t at = 0; at < writes; ++at) {
    for (const std::uint8_t torn : kTorn) {
      Eeprom eeprom = before;
      Store store(eeprom);
      store.use(0);
      eeprom.cut(at, torn);
      write(store, eeprom, third);
      ASSERT_TRUE(eeprom.dead());
      eeprom.power_up();
      const Bytes now = loaded(eeprom);
      EXPECT_TRUE(now == second || now == third) << at << ' ' << int{torn};
      // And the next one comes through.
      Store again(eeprom);
      again.use(0);
      EXPECT_EQ(write(again, eeprom, first), Progress::Done);
      EXPECT_EQ(loaded(eeprom), first);
      EXPECT_EQ(loaded(eeprom, 1), now);
    }
  }
}

TEST(Store, SurvivesOneCutAfterTheOther) {
  std::mt19937 random(3);
  Eeprom eeprom(kSize);
  Bytes old;
  for (int round = 0; round < 3000; ++round) {
    Store store(eeprom);
    store.use(0);
    const Bytes wanted =
        program(static_cast<std::uint8_t>(random()), 1 + random() % 35);
    eeprom.cut(random() % 60, static_cast<std::uint8_t>(random()));
    const Progress progress = write(store, eeprom, wanted);
    eeprom.power_up();
    const Bytes now = loaded(eeprom);
    ASSERT_TRUE(now == wanted || (now == old && progress != Progress::Done));
    old = now;
  }
}

TEST(Store, SaysWhereACellIsWornOut) {
  const Bytes first = program(3, 20);
  const Bytes second = program(91, 20);  // nowhere what the cell is stuck at
  for (std::uint16_t cell = 1; cell < kSize; ++cell) {
    Eeprom eeprom(kSize);
    Store store(eeprom);
    ASSERT_EQ(write(store, eeprom, first), Progress::Done);
    eeprom.wear_out(cell);
    const Progress progress = write(store, eeprom, second);
    EXPECT_EQ(loaded(eeprom), progress == Progress::Done ? second : first);
    EXPECT_EQ(progress == Progress::Done, cell < 50 || cell >= 81) << cell;
  }
}

TEST(Store, KnowsWhatItHasWritten) {
  Eeprom eeprom(kSize);
  Store store(eeprom);
  const auto holds = [&store](std::uint8_t age, const Bytes& wanted) {
    Bytes bytes(kSize);
    bytes.resize(store.load(age, bytes.data(), kSize));
    return bytes == wanted;
  };
  for (std::uint8_t i = 1; i < 5; ++i) {
    write(store, eeprom, program(i, 20));
    EXPECT_TRUE(holds(0, program(i, 20)));
    EXPECT_TRUE(holds(1, i == 1 ? Bytes() : program(i - 1, 20)));
  }
  eeprom.wear_out(15);
  EXPECT_EQ(write(store, eeprom, program(6, 20)), Progress::Failed);
  EXPECT_TRUE(holds(0, program(4, 20)));
  EXPECT_TRUE(holds(1, Bytes()));
}

TEST(Store, TouchesNothingWhereTheMarkStays) {
  Eeprom eeprom(kSize);
  Store store(eeprom);
  for (std::uint8_t i = 1; i < 3; ++i) write(store, eeprom, program(i, 20));
  eeprom.wear_out(11, 0xa5);  // the mark of the first bank, which is older
  EXPECT_EQ(write(store, eeprom, program(3, 20)), Progress::Failed);
  EXPECT_EQ(loaded(eeprom), program(2, 20));
  EXPECT_EQ(loaded(eeprom, 1), program(1, 20));
}

TEST(Store, LeavesAloneTheBankOfWhatRuns) {
  Eeprom eeprom(kSize);
  Store store(eeprom);
  write(store, eeprom, program(1, 20));
  write(store, eeprom, program(2, 20));
  // The newest is refused, say by a smaller machine: the one before runs.
  Store after(eeprom);
  after.use(1);
  write(after, eeprom, program(3, 20));
  EXPECT_EQ(loaded(eeprom), program(3, 20));
  EXPECT_EQ(loaded(eeprom, 1), program(1, 20));
  write(after, eeprom, program(4, 20));
  EXPECT_EQ(loaded(eeprom), program(4, 20));
  EXPECT_EQ(loaded(eeprom, 1), program(3, 20));
}

TEST(Store, NumbersGoRound) {
  Eeprom eeprom(kSize);
  Store store(eeprom);
  write(store, eeprom, program(1, 20));
  // The first bank gets the highest number, and the CRC that belongs to it.
  Bytes& bytes = eeprom.bytes();
  for (std::size_t at = 1; at < 5; ++at) bytes[at] = 0xff;
  std::uint32_t crc = 0xffffffffU;
  const auto add = [&crc](std::uint8_t byte) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0xedb88320U : crc >> 1;
    }
  };
  for (std::size_t at = 1; at < 7; ++at) add(bytes[at]);
  for (std::size_t at = 12; at < 32; ++at) add(bytes[at]);
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[7 + i] = static_cast<std::uint8_t>(~crc >> (8 * i));
  }
  ASSERT_EQ(loaded(eeprom), program(1, 20));
  Store after(eeprom);
  after.use(0);
  write(after, eeprom, program(2, 20));
  EXPECT_EQ(loaded(eeprom), program(2, 20));
  EXPECT_EQ(loaded(eeprom, 1), program(1, 20));
}

TEST(Store, FindsNothingInGarbage) {
  std::mt19937 random(4);
  for (int round = 0; round < 2000; ++round) {
    Eeprom eeprom(kSize);
    for (std::uint8_t& byte : eeprom.bytes()) {
      byte = static_cast<std::uint8_t>(random());
    }
    // With marks, and lengths that are possible.
    for (const std::size_t bank : {1U, 50U}) {
      eeprom.bytes()[bank + 4] %= 45;
      eeprom.bytes()[bank + 5] = 0;
      eeprom.bytes()[bank + 10] = 0xa5;
    }
    EXPECT_TRUE(loaded(eeprom).empty());
  }
}

}  // namespace
}  // namespace rung
