// A program is replaced on an emulated board, over its serial port: whatever
// comes in and whenever the power goes, a verified program runs, and the pins
// do what it says.
//
// RUNG_BOARD_FRAMES: how many damaged frames, for the Uno (10,000).

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <random>

#include "avr_board.h"
#include "tests/link/served.h"
#include "tests/postfix/image.h"

namespace rung {
namespace {

using rungproof::Answer;
using rungproof::Command;

struct Model {
  const char* name;
  const char* mcu;
  AvrBoard::Pin input;   // pin2
  AvrBoard::Pin output;  // pin4
};
const Model kUno = {"uno", "atmega328p", {'D', 2}, {'D', 4}};
const Model kYun = {"yun", "atmega32u4", {'D', 1}, {'D', 4}};

constexpr std::uint64_t kSlice = 2000;
// Verifying, or a data frame, with everything around it.
constexpr std::uint64_t kPatience = 2'000'000;
constexpr std::uint64_t kCyclesOfByte = 160;

Image pin_image() {
  Image image;
  image.scan_min = 0;
  image.scan_max = 1000;
  image.names = "\4pin2\4pin4";
  return image;
}

/// What live.ino has built in, and the program that comes.
std::string copy_pins() { return pin_image().file(); }
std::string invert_pins() {
  Image image = pin_image();
  image.code = Image::bytes_of({0x03, 0, 0x05, 0x04, 1, 0x00});
  return image.file();
}

class LinkedBoard {
 public:
  explicit LinkedBoard(const Model& model, const std::string& sketch = "live")
      : model_(model),
        board_(model.mcu, std::string(RUNG_FIRMWARE_DIR) + "/" + sketch + "-" +
                              model.name + ".elf") {
    EXPECT_EQ(board_.error(), "");
    run(kBoot);
  }

  AvrBoard& board() { return board_; }

  void run(std::uint64_t cycles) {
    ASSERT_EQ(board_.run(cycles), AvrBoard::State::Running);
  }

  /// Bytes, and what was said up to their end and a little after it.
  std::string exchange(const std::string& bytes, std::uint64_t after) {
    board_.send(bytes);
    run(bytes.size() * kCyclesOfByte + after);
    return board_.take_output();
  }

  /// Asked up to three times, as the host does it: bytes are lost where the
  /// board is still busy with what came before.
  Reply ask(const std::string& request) {
    // What comes late is an answer to something else.
    std::string head = contents(request).front().substr(0, 2);
    head[1] = static_cast<char>(head[1] | rungproof::kAnswerBit);
    std::string said;
    for (std::uint64_t cycles = 0; cycles < kPatience; cycles += kSlice) {
      if (cycles % (kPatience / 3) < kSlice) board_.send(request);
      run(kSlice);
      said += board_.take_output();
      if (!said.ends_with('\0')) continue;
      for (const std::string& content : contents(said)) {
        if (content.size() < 3 || !content.starts_with(head)) continue;
        return {static_cast<unsigned char>(content[2]), content.substr(3)};
      }
    }
    return {};
  }

  /// The last answer of an upload; while that is Busy, it is asked again as
  /// often as `patience` says.
  Reply upload(const std::string& program, int patience = 10000) {
    Reply reply;
    const std::vector<std::string> requests = upload_requests(program);
    for (const std::string& item : requests) reply = ask(item);
    for (; patience > 0 && reply.answer == static_cast<int>(Answer::Busy);
         --patience) {
      run(20 * kSlice);
      reply = ask(requests.back());
    }
    return reply;
  }

  void power_cycle() {
    board_.power_cycle();
    // simavr forgets what a pin is driven to, and takes note of changes only.
    board_.drive(model_.input, false);
    run(kBoot);
  }

  std::string running_checksum() {
    const Reply hello = ask(request(Command::Hello, ""));
    return hello.answer == 0 ? hello.body.substr(14, 4) : "";
  }

  bool runs(const std::string& program) {
    return running_checksum() == program.substr(12, 4);
  }

  int output(bool input) {
    board_.drive(model_.input, input);
    run(8 * kSlice);
    return board_.level(model_.output) ? 1 : 0;
  }

  /// One of the two, by its checksum and by its pins.
  void expect_whole() {
    const bool old = runs(copy_pins());
    ASSERT_TRUE(old || runs(invert_pins()));
    ASSERT_EQ(output(true), old ? 1 : 0);
    ASSERT_EQ(output(false), old ? 0 : 1);
  }

 private:
  static constexpr std::uint64_t kBoot = 400'000;

  Model model_;
  AvrBoard board_;
};

TEST(LiveBoard, ReplacesTheProgramOnItsPins) {
  for (const Model& model : {kUno, kYun}) {
    LinkedBoard linked(model);
    ASSERT_TRUE(linked.runs(copy_pins())) << model.name;
    EXPECT_EQ(linked.output(true), 1);
    EXPECT_EQ(linked.upload(invert_pins()).answer,
              static_cast<int>(Answer::Ack));
    linked.expect_whole();
    EXPECT_EQ(linked.output(true), 0);
    linked.power_cycle();
    EXPECT_EQ(linked.output(true), 0);
    EXPECT_TRUE(linked.runs(invert_pins()));
  }
}

int frames() {
  const char* const wanted = std::getenv("RUNG_BOARD_FRAMES");
  return wanted == nullptr ? 10000 : std::atoi(wanted);
}

/// A bit, a byte or some bytes of the frame are other ones, or gone.
std::string damaged(std::string bytes, std::mt19937& random) {
  const std::size_t at = 1 + random() % (bytes.size() - 2);
  switch (random() % 4) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      break;
    case 1:
      bytes.erase(at, 1 + random() % 3);
      break;
    case 2:
      bytes.insert(at, 1, static_cast<char>(random()));
      break;
    default:
      for (std::size_t i = at; i < bytes.size() && i < at + 4; ++i) {
        bytes[i] = static_cast<char>(random());
      }
  }
  return bytes;
}

/// Uploads whose every frame may be damaged, and one is: so none may succeed.
TEST(LiveBoard, DamagedFrames) {
  constexpr std::uint64_t kAfter = 6000;
  std::mt19937 random(8);
  LinkedBoard linked(kUno);
  const std::vector<std::string> requests = upload_requests(invert_pins());
  int sent = 0;
  for (int round = 0; sent < frames(); ++round) {
    const std::size_t lost = random() % requests.size();
    linked.exchange(request(Command::Abort, ""), kAfter);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      std::string bytes = requests[i];
      while ((i == lost || random() % 4 != 0) &&
             contents(bytes + '\0') == contents(requests[i])) {
        bytes = damaged(requests[i], random);
      }
      if (contents(bytes + '\0') != contents(requests[i])) ++sent;
      linked.exchange(bytes, kAfter);
    }
    if (round % 100 != 0) continue;
    ASSERT_TRUE(linked.runs(copy_pins())) << round;
    linked.expect_whole();
  }
  ASSERT_TRUE(linked.runs(copy_pins()));
  EXPECT_EQ(linked.upload(invert_pins()).answer, static_cast<int>(Answer::Ack));
  linked.expect_whole();
}

TEST(LiveBoard, EveryTruncationOfAnUpload) {
  constexpr std::uint64_t kAfter = 20000;
  LinkedBoard linked(kUno);
  std::string all;
  for (const std::string& item : upload_requests(invert_pins())) all += item;
  for (std::size_t size = 0; size < all.size(); ++size) {
    linked.exchange(all.substr(0, size), kAfter);
    ASSERT_TRUE(linked.runs(copy_pins())) << size;
    linked.expect_whole();
  }
}

TEST(LiveBoard, AClaimOfASmallerStack) {
  Image image = pin_image();
  image.code = Image::bytes_of({0x03, 0, 0x03, 0, 0x06, 0x04, 1, 0x00});
  for (const Model& model : {kUno, kYun}) {
    LinkedBoard linked(model);
    for (const unsigned claim : {0U, 1U, 3U, 100U, 65535U}) {
      image.bit_stack = claim;
      const Reply reply = linked.upload(image.file());
      ASSERT_EQ(reply.answer, static_cast<int>(Answer::Refused)) << claim;
      EXPECT_EQ(
          reply.body[0],
          static_cast<char>(claim > 1000 ? rungproof::Refusal::NoMemory
                                         : rungproof::Refusal::WrongDepth));
      linked.expect_whole();
      ASSERT_TRUE(linked.runs(copy_pins()));
    }
    image.bit_stack = 2;
    EXPECT_EQ(linked.upload(image.file()).answer,
              static_cast<int>(Answer::Ack));
  }
}

/// The EEPROM after each byte that storing writes: from these a reset, which
/// forgets all else, goes on.
struct Written {
  std::vector<std::vector<std::uint8_t>> states;
  std::vector<std::size_t> places;  // of the byte that made each
};

Written storing(LinkedBoard& linked) {
  Written written;
  const auto eeprom = linked.board().eeprom();
  std::vector<std::uint8_t> last(eeprom.begin(), eeprom.end());
  linked.upload(invert_pins(), 0);
  // Starting to write a byte takes long enough to see each of them.
  for (std::uint64_t idle = 0; idle < 200'000;) {
    const auto changed =
        std::mismatch(last.begin(), last.end(), eeprom.begin());
    if (changed.first == last.end()) {
      linked.run(kSlice);
      idle += kSlice;
      continue;
    }
    idle = 0;
    written.places.push_back(
        static_cast<std::size_t>(changed.first - last.begin()));
    last.assign(eeprom.begin(), eeprom.end());
    written.states.push_back(last);
  }
  return written;
}

TEST(LiveBoard, AResetAtEveryByteOfStoring) {
  LinkedBoard linked(kUno);
  // Both banks are in use: the old program is in one, and an older one where
  // the new one goes.
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(linked.upload(copy_pins()).answer, static_cast<int>(Answer::Ack));
  }
  const Written written = storing(linked);
  ASSERT_GE(written.states.size(), 20U);
  int old = 0;
  for (std::size_t i = 0; i < written.states.size(); ++i) {
    // The byte as it was written, and torn.
    for (const int torn : {-1, 0x00, 0xff, 0xa5}) {
      const auto eeprom = linked.board().eeprom();
      std::copy(written.states[i].begin(), written.states[i].end(),
                eeprom.begin());
      if (torn >= 0) {
        eeprom[written.places[i]] = static_cast<std::uint8_t>(torn);
      }
      linked.power_cycle();
      linked.expect_whole();
      if (linked.runs(copy_pins())) ++old;
    }
  }
  // All but the last, whose mark is torn or whole.
  EXPECT_GE(old, static_cast<int>(4 * (written.states.size() - 1)));
  EXPECT_LT(old, static_cast<int>(4 * written.states.size()));
  // And the next upload comes through.
  EXPECT_EQ(linked.upload(invert_pins()).answer, static_cast<int>(Answer::Ack));
}

TEST(LiveBoard, TheReadersOfTheHostReachIt) {
  LinkedBoard linked(kUno);
  const std::string file = testing::TempDir() + "live_board.pf";
  std::ofstream(file) << "postfix 1\ndialect yun\nevaluation strict\n"
                         "scan 1..1000 ms\ninput bit pin2\noutput bit pin4\n"
                         "rungs\npin2 ! =pin4\n";
  const auto exchange = [&linked](const std::string& bytes) {
    return linked.exchange(bytes, 16000);
  };
  linked.board().drive(kUno.input, true);
  Served served(exchange, Served::Wire::Terminal);
  const Said upload = shell(RUNG_PROGRAM " upload " + file + " " +
                            served.option() + " --baud 1000000");
  EXPECT_EQ(upload.status, 0) << upload.text;
  EXPECT_NE(upload.text.find("avr: runs "), std::string::npos) << upload.text;
  const Said monitor = shell(RUNG_PROGRAM " monitor --scans 2 " +
                             served.option() + " --format jsonl");
  EXPECT_EQ(monitor.status, 0) << monitor.text;
  EXPECT_NE(monitor.text.find(R"("values":{"pin2":1,"pin4":0}})"),
            std::string::npos)
      << monitor.text;
  served.stop();
  linked.board().drive(kUno.input, false);
  linked.run(50'000);  // this program has scans of a millisecond
  EXPECT_TRUE(linked.board().level(kUno.output));
  std::remove(file.c_str());
}

/// The example as a user finds it: at its own speed, on its own pins.
TEST(LiveBoard, TheExampleIsWhatItSays) {
  const std::string folder = RUNG_SOURCE_DIR "/runtime/examples/LiveUpdate/";
  const Said header =
      shell(RUNG_PROGRAM " lower --to postfix --header " + folder +
            "start_stop.rung | cmp - " + folder + "start_stop.h");
  EXPECT_EQ(header.status, 0) << header.text;

  const AvrBoard::Pin start{'D', 2};
  const AvrBoard::Pin stop{'D', 3};
  const AvrBoard::Pin second{'D', 4};
  const AvrBoard::Pin motor{'B', 5};
  LinkedBoard linked(kUno, "LiveUpdate");
  const auto press = [&linked](AvrBoard::Pin pin) {
    for (const bool level : {true, false}) {
      linked.board().drive(pin, level);
      linked.run(100'000);
    }
  };
  press(start);
  EXPECT_TRUE(linked.board().level(motor));
  press(stop);
  EXPECT_FALSE(linked.board().level(motor));
  {
    Served served(
        [&linked](const std::string& bytes) {
          constexpr std::uint64_t kSlow = 1400;  // 115200 baud
          return linked.exchange(bytes, 16000 + kSlow * bytes.size());
        },
        Served::Wire::Terminal);
    const Said upload = shell(RUNG_PROGRAM " upload " + folder +
                              "two_hands.rung " + served.option());
    EXPECT_EQ(upload.status, 0) << upload.text;
  }
  press(start);
  EXPECT_FALSE(linked.board().level(motor));
  linked.board().drive(second, true);
  press(start);
  EXPECT_TRUE(linked.board().level(motor));
}

}  // namespace
}  // namespace rung
