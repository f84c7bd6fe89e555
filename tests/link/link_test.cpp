// The protocol: what is asked, what is answered.

#include <gtest/gtest.h>

#include "tests/link/controller.h"
#include "tests/postfix/image.h"

namespace rung {
namespace {

using rungproof::Answer;
using rungproof::Command;

constexpr std::size_t kEeprom = 512;

int code(Answer answer) { return static_cast<int>(answer); }

std::string checksum(const std::string& program) {
  return program.substr(12, 4);
}

TEST(Link, Introduces) {
  Eeprom eeprom(kEeprom);
  EmulatedController controller(copy_program(), &eeprom);
  const Reply reply = ask(controller, request(Command::Hello, ""));
  ASSERT_EQ(reply.answer, code(Answer::Ack));
  EXPECT_EQ(reply.body[0], rungproof::kLinkProtocol);
  EXPECT_EQ(reply.body[1], rungproof::kLinkStores);
  EXPECT_EQ(number_at(reply.body, 2), 244U);  // a bank, less than a place
  EXPECT_EQ(number_at(reply.body, 6), 16U);
  EXPECT_EQ(number_at(reply.body, 10), copy_program().size());
  EXPECT_EQ(reply.body.substr(14, 4), checksum(copy_program()));
  EXPECT_EQ(reply.body.substr(18), "emulated");
}

TEST(Link, AnswersWithSequenceAndCommandOfTheRequest) {
  EmulatedController controller(copy_program(), nullptr);
  const auto found =
      contents(controller.exchange(request(Command::Hello, "", '\x7e')));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].substr(0, 3), std::string("\x7e\x81\0", 3));
}

TEST(Link, ReplacesTheProgram) {
  for (const bool clear : {false, true}) {
    EmulatedController controller(copy_program(), nullptr);
    EXPECT_EQ(controller.output(1), 1);
    EXPECT_EQ(upload(controller, invert_program(), clear).answer,
              code(Answer::Ack));
    EXPECT_EQ(controller.cleared(), clear);
    EXPECT_EQ(controller.output(1), 0);
    EXPECT_EQ(controller.running(), invert_program());
    EXPECT_EQ(upload(controller, copy_program()).answer, code(Answer::Ack));
    EXPECT_EQ(controller.output(1), 1);
  }
}

TEST(Link, StoresTheProgram) {
  Eeprom eeprom(kEeprom);
  {
    EmulatedController controller(copy_program(), &eeprom);
    EXPECT_EQ(upload(controller, invert_program()).answer, code(Answer::Ack));
  }
  EmulatedController after(copy_program(), &eeprom);
  EXPECT_EQ(after.running(), invert_program());
}

TEST(Link, RunsTheOlderProgramWhereTheNewestIsRefused) {
  Eeprom eeprom(kEeprom);
  {
    EmulatedController controller(copy_program(), &eeprom);
    upload(controller, copy_program());
    Image large;
    large.bits = 20;
    large.attributes = std::string(20, '\1');
    large.attributes[0] = '\0';
    large.names.clear();
    for (char name = 'a'; name < 'u'; ++name) large.names += {'\1', name};
    EXPECT_EQ(upload(controller, large.file()).answer, code(Answer::Ack));
  }
  EmulatedController after(invert_program(), &eeprom, {256, 2});
  EXPECT_EQ(after.running(), copy_program());
  // The next upload goes where the refused one is.
  EXPECT_EQ(upload(after, invert_program()).answer, code(Answer::Ack));
  EXPECT_EQ(EmulatedController(copy_program(), &eeprom).running(),
            invert_program());
  std::string older(256, '\0');
  older.resize(rungproof::Store(eeprom).load(
      1, reinterpret_cast<std::uint8_t*>(older.data()), 256));
  EXPECT_EQ(older, copy_program());
}

TEST(Link, CommitIsBusyUntilTheProgramIsStored) {
  Eeprom eeprom(kEeprom);
  EmulatedController controller(copy_program(), &eeprom);
  const auto requests = upload_requests(invert_program());
  Reply reply;
  for (const std::string& item : requests) reply = ask(controller, item);
  EXPECT_EQ(reply.answer, code(Answer::Busy));
  EXPECT_EQ(controller.output(0), 1);  // it runs already
  EXPECT_EQ(ask(controller, requests.front()).answer, code(Answer::Busy));
  const Reply status = ask(controller, request(Command::Status, ""));
  EXPECT_EQ(status.body[0], rungproof::kLinkStores | rungproof::kLinkStoring);
  for (int i = 0; i < 1000; ++i) controller.turn();
  EXPECT_EQ(ask(controller, requests.back()).answer, code(Answer::Ack));
}

TEST(Link, SaysWhereNothingIsStored) {
  Eeprom eeprom(kEeprom);
  eeprom.wear_out(30);
  EmulatedController controller(copy_program(), &eeprom);
  EXPECT_EQ(upload(controller, invert_program()).answer,
            code(Answer::NotStored));
  EXPECT_EQ(controller.running(), invert_program());
  EXPECT_EQ(EmulatedController(copy_program(), &eeprom).running(),
            copy_program());
}

TEST(Link, EveryRequestMayComeTwice) {
  Eeprom eeprom(kEeprom);
  EmulatedController controller(copy_program(), &eeprom);
  const auto requests = upload_requests(invert_program());
  for (std::size_t i = 0; i + 1 < requests.size(); ++i) {
    const Reply once = ask(controller, requests[i]);
    const Reply twice = ask(controller, requests[i]);
    EXPECT_EQ(once.answer, code(Answer::Ack));
    EXPECT_EQ(twice.answer, once.answer);
    EXPECT_EQ(twice.body, once.body);
  }
  ask(controller, requests.back());
  for (int i = 0; i < 1000; ++i) controller.turn();
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(ask(controller, requests.back()).answer, code(Answer::Ack));
  }
}

TEST(Link, DataSaysHowMuchHasCome) {
  EmulatedController controller(copy_program(), nullptr);
  const std::string program = invert_program();
  const auto data = [&](std::uint32_t at, std::size_t size) {
    return ask(controller,
               request(Command::Data, number(at) + program.substr(at, size)));
  };
  ask(controller, upload_requests(program).front());
  EXPECT_EQ(number_at(data(0, 10).body, 0), 10U);
  const Reply gap = data(11, 5);
  EXPECT_EQ(gap.answer, code(Answer::OutOfOrder));
  EXPECT_EQ(number_at(gap.body, 0), 10U);
  EXPECT_EQ(number_at(data(5, 20).body, 0), 10U);
}

TEST(Link, AnUploadMayBeBegunAnew) {
  EmulatedController controller(copy_program(), nullptr);
  const auto requests = upload_requests(invert_program());
  ask(controller, requests[0]);
  ask(controller, requests[1]);
  EXPECT_EQ(upload(controller, invert_program()).answer, code(Answer::Ack));
  // In the middle of one program another.
  ask(controller, requests[0]);
  ask(controller, requests[1]);
  EXPECT_EQ(upload(controller, copy_program()).answer, code(Answer::Ack));
  EXPECT_EQ(controller.running(), copy_program());
}

TEST(Link, AnUploadEndsWithAbortAndWithSilence) {
  EmulatedController controller(copy_program(), nullptr);
  const auto requests = upload_requests(invert_program());
  for (const bool abort : {true, false}) {
    ask(controller, requests[0]);
    if (abort) {
      EXPECT_EQ(ask(controller, request(Command::Abort, "")).answer,
                code(Answer::Ack));
    } else {
      controller.turn(rungproof::kLinkSilenceMs - 1);
      EXPECT_EQ(ask(controller, requests[1]).answer, code(Answer::Ack));
      controller.turn(rungproof::kLinkSilenceMs + 1);
    }
    for (std::size_t i = 1; i < requests.size(); ++i) {
      EXPECT_EQ(ask(controller, requests[i]).answer, code(Answer::NoUpload));
    }
    EXPECT_EQ(controller.running(), copy_program());
  }
}

TEST(Link, SilenceIsMeasuredAcrossTheRollOverOfTheClock) {
  EmulatedController controller(copy_program(), nullptr);
  controller.turn(0xffffffffU - 5);
  ask(controller, upload_requests(invert_program())[0]);
  controller.turn(100);
  EXPECT_EQ(upload(controller, invert_program()).answer, code(Answer::Ack));
}

struct Refused {
  const char* what;
  std::string request;
  Answer answer;
};

TEST(Link, RefusesWhatIsNoRequest) {
  const std::string program = invert_program();
  const std::string begin = number(56) + checksum(program);
  const Refused cases[] = {
      {"command 0", request(Command{0}, ""), Answer::UnknownCommand},
      {"command 9", request(Command{9}, ""), Answer::UnknownCommand},
      {"command 127", request(Command{127}, ""), Answer::UnknownCommand},
      {"no flags", request(Command::Begin, begin), Answer::Malformed},
      {"flag 2", request(Command::Begin, begin + '\2'), Answer::Malformed},
      {"long begin", request(Command::Begin, begin + "\1x"), Answer::Malformed},
      {"too large",
       request(Command::Begin, number(257) + checksum(program) + '\1'),
       Answer::TooLarge},
      {"huge", request(Command::Begin, number(~0U) + checksum(program) + '\1'),
       Answer::TooLarge},
      {"data without upload", request(Command::Data, number(0) + "x"),
       Answer::NoUpload},
      {"no data", request(Command::Data, number(0)), Answer::Malformed},
      {"commit without upload", request(Command::Commit, checksum(program)),
       Answer::NoUpload},
      {"short commit", request(Command::Commit, "abc"), Answer::Malformed},
      {"abort with", request(Command::Abort, "x"), Answer::Malformed},
      {"monitor what", request(Command::Monitor, ""), Answer::Malformed},
      {"monitor 2", request(Command::Monitor, "\2"), Answer::Malformed},
      {"read what", request(Command::Read, "abc"), Answer::Malformed},
  };
  EmulatedController controller(copy_program(), nullptr);
  for (const Refused& item : cases) {
    EXPECT_EQ(ask(controller, item.request).answer, code(item.answer))
        << item.what;
    EXPECT_EQ(controller.running(), copy_program());
  }
}

TEST(Link, RefusesDataBeyondTheEnd) {
  EmulatedController controller(copy_program(), nullptr);
  const std::string program = invert_program();
  ask(controller, request(Command::Begin,
                          number(40) + checksum(program) + std::string(1, 0)));
  const auto data = [&](std::uint32_t at, std::size_t size) {
    return ask(controller,
               request(Command::Data, number(at) + program.substr(at, size)))
        .answer;
  };
  EXPECT_EQ(data(0, 41), code(Answer::TooLarge));
  EXPECT_EQ(data(0, 40), code(Answer::Ack));
  EXPECT_EQ(data(40, 1), code(Answer::TooLarge));
  const Reply commit = ask(controller, upload_requests(program).back());
  EXPECT_EQ(commit.answer, code(Answer::Refused));
  EXPECT_EQ(commit.body[0], 1);  // too short
}

TEST(Link, CommitsOnlyWhatWasBegunAndHasCome) {
  const std::string program = invert_program();
  const auto requests = upload_requests(program);
  EmulatedController controller(copy_program(), nullptr);
  ask(controller, requests[0]);
  ask(controller, requests[1]);
  EXPECT_EQ(ask(controller, requests.back()).answer, code(Answer::Incomplete));
  ask(controller, requests[2]);  // it may go on
  EXPECT_EQ(ask(controller, request(Command::Commit, checksum(copy_program())))
                .answer,
            code(Answer::NoUpload));
  EXPECT_EQ(controller.running(), copy_program());
  EXPECT_EQ(ask(controller, requests.back()).answer, code(Answer::Ack));
  EXPECT_EQ(controller.running(), program);
}

TEST(Link, RefusesAnotherProgramThanTheOneThatWasBegun) {
  const std::string other = checksum(copy_program());
  EmulatedController controller(copy_program(), nullptr);
  ask(controller,
      request(Command::Begin, number(60) + other + std::string(1, '\0')));
  const auto requests = upload_requests(invert_program());
  for (std::size_t i = 1; i + 1 < requests.size(); ++i) {
    EXPECT_EQ(ask(controller, requests[i]).answer, code(Answer::Ack));
  }
  const Reply reply = ask(controller, request(Command::Commit, other));
  EXPECT_EQ(reply.answer, code(Answer::Refused));
  EXPECT_EQ(reply.body, "\5" + number(12));
  EXPECT_EQ(controller.running(), copy_program());
}

TEST(Link, TakesNoByteWhileARequestWaits) {
  EmulatedController controller(copy_program(), nullptr);
  const std::string all =
      request(Command::Hello, "", '\1') + request(Command::Status, "", '\2');
  for (const char byte : all) {
    controller.link().receive(static_cast<std::uint8_t>(byte));
  }
  const auto found = contents(controller.exchange(""));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].substr(0, 2), "\1\x81");
}

TEST(Link, AnAnswerIsNotAnswered) {
  EmulatedController controller(copy_program(), nullptr);
  const std::string echo = controller.exchange(request(Command::Hello, ""));
  EXPECT_FALSE(echo.empty());
  EXPECT_TRUE(controller.exchange(echo).empty());
}

TEST(Link, GivesTheProgramBack) {
  EmulatedController controller(copy_program(), nullptr);
  std::string program;
  for (;;) {
    const Reply reply =
        ask(controller,
            request(Command::Read,
                    number(static_cast<std::uint32_t>(program.size()))));
    ASSERT_EQ(reply.answer, code(Answer::Ack));
    ASSERT_EQ(number_at(reply.body, 0), program.size());
    if (reply.body.size() == 4) break;
    program += reply.body.substr(4);
  }
  EXPECT_EQ(program, copy_program());
  const Reply beyond = ask(controller, request(Command::Read, number(~0U)));
  EXPECT_EQ(beyond.body, number(~0U));
}

/// 20 bits and two words, none written.
std::string wide_program(unsigned bits) {
  Image image;
  image.bits = bits;
  image.words = 2;
  image.attributes = std::string(bits, '\4') + std::string(2, '\2');
  image.attributes[1] = '\1';
  image.attributes[2] = '\0';
  image.code = Image::bytes_of({0x03, 2, 0x04, 1, 0x00});
  image.ranges.clear();
  for (const std::uint32_t value : {77U, ~0U}) {
    for (int i = 0; i < 3; ++i) image.ranges += Image::number(value);
  }
  image.names.clear();
  for (unsigned i = 0; i < bits + 2; ++i) {
    image.names += '\3' + std::to_string(100 + i);
  }
  return image.file();
}

TEST(Link, SendsTheImageOfEachScan) {
  EmulatedController controller(wide_program(20), nullptr, {256, 64});
  EXPECT_TRUE(controller.exchange("").empty());
  ask(controller, request(Command::Monitor, "\1"));
  for (std::uint32_t scan = 0; scan < 5; ++scan) {
    const auto found = contents(controller.exchange(""));
    ASSERT_EQ(found.size(), 1U);
    const std::string& image = found[0];
    EXPECT_EQ(image[1], static_cast<char>(rungproof::kImage));
    EXPECT_EQ(number_at(image, 6), 1U);              // dt
    EXPECT_EQ(number_at(image, 12), 22U << 16);      // from cell 0, 22 cells
    EXPECT_EQ(image.substr(16, 3), "\xf9\xff\x0f");  // 1001 1111 ...
    EXPECT_EQ(number_at(image, 19), 77U);
    EXPECT_EQ(number_at(image, 23), ~0U);
    EXPECT_EQ(image.size(), 27U);
  }
  ask(controller, request(Command::Monitor, std::string(1, '\0')));
  EXPECT_TRUE(controller.exchange("").empty());
  ask(controller, request(Command::Monitor, "\1"));
  controller.turn(rungproof::kLinkSilenceMs + 1);
  controller.exchange("");
  EXPECT_TRUE(controller.exchange("").empty());
}

TEST(Link, SendsALongImageInParts) {
  EmulatedController controller(wide_program(400), nullptr, {2500, 200});
  ASSERT_EQ(controller.started(), rungproof::Refusal::None);
  ask(controller, request(Command::Monitor, "\1"));
  std::uint32_t cells = 0;
  for (int scan = 0; scan < 6; ++scan) {
    const auto found = contents(controller.exchange(""));
    ASSERT_EQ(found.size(), 1U);
    const std::uint32_t range = number_at(found[0], 12);
    EXPECT_EQ(range & 0xffffU, cells);
    EXPECT_GT(range >> 16, 0U);
    cells += range >> 16;
    EXPECT_LE(cells, 402U);
    if (cells == 402) cells = 0;
  }
}

TEST(Link, SaysWhyTheMachineHasStopped) {
  Image image;
  image.words = 1;
  image.attributes += '\2';
  image.ranges = Image::number(5) + Image::number(0) + Image::number(5);
  image.names += "\1w";
  image.word_stack = 2;
  // w = w + 1
  image.code = Image::bytes_of({0x13, 0, 0x10, 1, 0x15, 0x14, 0, 0x00});
  image.bit_stack = 0;
  EmulatedController controller(image.file(), nullptr);
  ASSERT_EQ(controller.started(), rungproof::Refusal::None);
  controller.turn();
  const Reply reply = ask(controller, request(Command::Status, ""));
  EXPECT_EQ(reply.body[0], rungproof::kLinkStopped);
  EXPECT_EQ(reply.body[1], 2);              // range
  EXPECT_EQ(number_at(reply.body, 6), 0U);  // scans that were completed
  EXPECT_EQ(reply.body.substr(18, 4), checksum(image.file()));
  // Another program gets it going again.
  EXPECT_EQ(upload(controller, copy_program()).answer, code(Answer::Ack));
  EXPECT_EQ(controller.output(1), 1);
}

}  // namespace
}  // namespace rung
