// Frames: every content comes back, and nothing but a content that was sent.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/link/controller.h"

namespace rung {
namespace {

std::string random_bytes(std::mt19937& random, std::size_t size, int zeros) {
  std::string bytes(size, '\0');
  for (char& byte : bytes) {
    if (static_cast<int>(random() % 4) >= zeros) {
      byte = static_cast<char>(random());
    }
  }
  return bytes;
}

TEST(Frame, EveryContentComesBack) {
  std::mt19937 random(1);
  for (std::size_t size = 1; size <= rungproof::kFrameContent; ++size) {
    for (int zeros = 0; zeros <= 4; ++zeros) {
      const std::string content = random_bytes(random, size, zeros);
      const std::string bytes = frame(content);
      EXPECT_LE(bytes.size(), rungproof::kFrameWire);
      EXPECT_EQ(std::count(bytes.begin(), bytes.end(), '\0'), 2);
      EXPECT_EQ(contents(bytes), std::vector<std::string>{content});
    }
  }
}

TEST(Frame, IsFoundBehindAnyGarbage) {
  std::mt19937 random(2);
  for (int round = 0; round < 2000; ++round) {
    const std::string content = random_bytes(random, 1 + random() % 60, 1);
    const std::string bytes =
        random_bytes(random, random() % 200, 1) + frame(content);
    const std::vector<std::string> found = contents(bytes);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.back(), content);
  }
}

TEST(Frame, AnyChangedByteLosesIt) {
  const std::string bytes = frame(std::string("\1\0\0pieces\0", 10));
  for (std::size_t at = 1; at + 1 < bytes.size(); ++at) {
    for (int value = 0; value < 256; ++value) {
      std::string changed = bytes;
      if (changed[at] == static_cast<char>(value)) continue;
      changed[at] = static_cast<char>(value);
      EXPECT_TRUE(contents(changed).empty()) << at << ' ' << value;
    }
  }
}

TEST(Frame, EveryBeginningOfOneIsNone) {
  const std::string bytes = frame("begun");
  for (std::size_t size = 0; size + 1 < bytes.size(); ++size) {
    EXPECT_TRUE(contents(bytes.substr(0, size)).empty());
    EXPECT_TRUE(contents(bytes.substr(0, size) + '\0').empty());
  }
}

TEST(Frame, OneThatIsTooLongIsNone) {
  for (std::size_t size = 64; size < 300; ++size) {
    // One group, or many: neither is written over what lies behind.
    EXPECT_TRUE(contents(std::string(size, '\1') + '\0').empty());
    std::string group(size, 'x');
    group[0] = static_cast<char>(std::min<std::size_t>(size, 255));
    EXPECT_TRUE(contents(group + '\0').empty());
  }
}

TEST(Frame, WithoutContentIsNone) {
  EXPECT_TRUE(contents(std::string(9, '\0')).empty());
  EXPECT_TRUE(contents(frame("")).empty());
}

}  // namespace
}  // namespace rung
