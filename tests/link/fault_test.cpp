// What goes wrong on a wire, and around it: a verified program runs, always.

#include <gtest/gtest.h>

#include <random>

#include "tests/link/controller.h"
#include "tests/postfix/image.h"

namespace rung {
namespace {

using rungproof::Answer;
using rungproof::Command;

constexpr std::size_t kEeprom = 512;

/// The old program or the new one, by its bytes and by what it does.
void expect_whole(EmulatedController& controller) {
  ASSERT_TRUE(controller.runs_verified());
  const bool old = controller.running() == copy_program();
  ASSERT_TRUE(old || controller.running() == invert_program());
  ASSERT_EQ(controller.output(1), old ? 1 : 0);
  ASSERT_EQ(controller.output(0), old ? 0 : 1);
}

std::string joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += part;
  return all;
}

std::string damaged(std::string bytes, std::mt19937& random) {
  const std::size_t at = random() % bytes.size();
  switch (random() % 4) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      break;
    case 1:
      bytes.erase(at, 1 + random() % 4);
      break;
    case 2:
      bytes.insert(at, 1, static_cast<char>(random()));
      break;
    default:
      for (std::size_t i = at; i < bytes.size() && i < at + 5; ++i) {
        bytes[i] = static_cast<char>(random());
      }
  }
  return bytes;
}

TEST(LinkFaults, TenThousandDamagedFrames) {
  std::mt19937 random(5);
  Eeprom eeprom(kEeprom);
  EmulatedController controller(copy_program(), &eeprom);
  const auto requests = upload_requests(invert_program());
  for (int i = 0; i < 10000; ++i) {
    const std::string& whole = requests[random() % requests.size()];
    const std::string bytes = damaged(whole, random);
    // Without a zero byte in front, say, it is the same frame.
    if (contents(bytes + '\0') == contents(whole)) continue;
    controller.exchange(bytes);
    ASSERT_EQ(controller.running(), copy_program()) << i;
    if (i % 100 == 0) expect_whole(controller);
  }
  // The wire is as good as before.
  EXPECT_EQ(upload(controller, invert_program()).answer,
            static_cast<int>(Answer::Ack));
  expect_whole(controller);
}

/// Frames that are whole and contents that are not: what only the receiver and
/// the verifier can find.
TEST(LinkFaults, TenThousandFramesOfAnyContent) {
  std::mt19937 random(6);
  EmulatedController controller(copy_program(), nullptr);
  const auto requests = upload_requests(invert_program());
  for (int i = 0; i < 10000; ++i) {
    std::string content =
        contents(requests[random() % requests.size()]).front();
    if (random() % 8 != 0) {
      content[random() % content.size()] = static_cast<char>(random());
    }
    content.resize(1 + random() % content.size());
    controller.exchange(frame(content));
    ASSERT_TRUE(controller.runs_verified()) << i;
    if (i % 100 == 0) expect_whole(controller);
  }
}

TEST(LinkFaults, EveryTruncationOfAnUpload) {
  const std::string all = joined(upload_requests(invert_program()));
  for (std::size_t size = 0; size < all.size(); ++size) {
    EmulatedController controller(copy_program(), nullptr);
    controller.exchange(all.substr(0, size));
    ASSERT_EQ(controller.running(), copy_program()) << size;
    expect_whole(controller);
    // What was begun is no hindrance.
    EXPECT_EQ(upload(controller, invert_program()).answer,
              static_cast<int>(Answer::Ack));
  }
}

TEST(LinkFaults, EveryTruncationOfTheProgram) {
  const std::string program = invert_program();
  for (std::size_t size = 0; size < program.size(); ++size) {
    EmulatedController controller(copy_program(), nullptr);
    std::string cut = program.substr(0, size);
    const std::string checksum = program.substr(12, 4);
    ask(controller,
        request(Command::Begin, number(static_cast<std::uint32_t>(size)) +
                                    checksum + std::string(1, '\0')));
    for (std::size_t at = 0; at < size; at += 40) {
      ask(controller,
          request(Command::Data,
                  number(static_cast<std::uint32_t>(at)) + cut.substr(at, 40)));
    }
    EXPECT_EQ(ask(controller, request(Command::Commit, checksum)).answer,
              static_cast<int>(Answer::Refused));
    EXPECT_EQ(controller.running(), copy_program());
  }
}

TEST(LinkFaults, EveryBitFlipOnTheWire) {
  const std::string all = joined(upload_requests(invert_program()));
  for (std::size_t bit = 0; bit < 8 * all.size(); ++bit) {
    EmulatedController controller(copy_program(), nullptr);
    std::string flipped = all;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    controller.exchange(flipped);
    expect_whole(controller);
  }
}

TEST(LinkFaults, EveryBitFlipOfTheProgram) {
  const std::string program = invert_program();
  EmulatedController controller(copy_program(), nullptr);
  for (std::size_t bit = 0; bit < 8 * program.size(); ++bit) {
    std::string flipped = program;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    const Reply reply = upload(controller, flipped);
    EXPECT_EQ(reply.answer, static_cast<int>(Answer::Refused)) << bit;
    ASSERT_EQ(controller.running(), copy_program());
    // With the right checksum it is another program, or none.
    upload(controller, sealed(flipped));
    ASSERT_TRUE(controller.runs_verified()) << bit;
    upload(controller, copy_program());
    ASSERT_EQ(controller.running(), copy_program());
  }
}

TEST(LinkFaults, GarbageBetweenFrames) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    EmulatedController controller(copy_program(), nullptr);
    std::string all;
    for (const std::string& item : upload_requests(invert_program())) {
      for (std::size_t i = random() % 100; i > 0; --i) {
        all += static_cast<char>(random());
      }
      all += item;
    }
    controller.exchange(all);
    ASSERT_EQ(controller.running(), invert_program());
    expect_whole(controller);
  }
}

TEST(LinkFaults, AClaimOfASmallerStack) {
  Image image;
  image.code = Image::bytes_of({0x03, 0, 0x03, 0, 0x06, 0x04, 1, 0x00});
  image.bit_stack = 1;  // it needs 2
  Eeprom eeprom(kEeprom);
  EmulatedController controller(copy_program(), &eeprom);
  const Reply reply = upload(controller, image.file());
  EXPECT_EQ(reply.answer, static_cast<int>(Answer::Refused));
  EXPECT_EQ(reply.body[0], static_cast<char>(rungproof::Refusal::WrongDepth));
  EXPECT_EQ(number_at(reply.body, 1), 52U);  // the second operand
  expect_whole(controller);
  EXPECT_EQ(EmulatedController(copy_program(), &eeprom).running(),
            copy_program());
  image.bit_stack = 2;
  EXPECT_EQ(upload(controller, image.file()).answer,
            static_cast<int>(Answer::Ack));
}

TEST(LinkFaults, MoreMemoryThanThereIs) {
  Image image;
  image.bit_stack = 60000;
  EmulatedController controller(copy_program(), nullptr);
  const Reply reply = upload(controller, image.file());
  EXPECT_EQ(reply.answer, static_cast<int>(Answer::Refused));
  EXPECT_EQ(reply.body[0], static_cast<char>(rungproof::Refusal::NoMemory));
  expect_whole(controller);
}

TEST(LinkFaults, TheImageSurvivesARefusedProgram) {
  // b = a || b: what is latched stays, whatever is sent.
  Image latch;
  latch.code = Image::bytes_of({0x03, 0, 0x03, 1, 0x07, 0x04, 1, 0x00});
  latch.bit_stack = 2;
  EmulatedController controller(latch.file(), nullptr);
  controller.output(1);
  ASSERT_EQ(controller.output(0), 1);
  Image bad = latch;
  bad.bit_stack = 1;
  upload(controller, bad.file());
  EXPECT_EQ(controller.output(0), 1);
}

TEST(LinkFaults, APowerCutAtEveryByteOfStoring) {
  Eeprom before(kEeprom);
  {
    EmulatedController controller(invert_program(), &before);
    upload(controller, copy_program());
    upload(controller, copy_program());
  }
  Eeprom counted = before;
  {
    EmulatedController controller(invert_program(), &counted);
    upload(controller, invert_program());
  }
  const std::size_t writes = counted.writes() - before.writes();
  ASSERT_GT(writes, 5U);
  for (std::size_t at = 0; at < writes; ++at) {
    for (const int torn : {0x00, 0xff, 0xa5, 0x33}) {
      Eeprom eeprom = before;
      eeprom.cut(at, static_cast<std::uint8_t>(torn));
      {
        EmulatedController controller(invert_program(), &eeprom);
        ASSERT_EQ(controller.running(), copy_program());
        for (const auto& item : upload_requests(invert_program())) {
          ask(controller, item);
        }
        while (!eeprom.dead()) controller.turn();
      }
      eeprom.power_up();
      EmulatedController after(invert_program(), &eeprom);
      expect_whole(after);
      EXPECT_EQ(upload(after, invert_program()).answer,
                static_cast<int>(Answer::Ack));
      EmulatedController last(copy_program(), &eeprom);
      EXPECT_EQ(last.running(), invert_program());
    }
  }
}

}  // namespace
}  // namespace rung
