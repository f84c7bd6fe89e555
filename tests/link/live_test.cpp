// A controller with pins whose program is replaced over a port.

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

#include "rungproof_live.h"
#include "tests/link/controller.h"
#include "tests/postfix/image.h"

namespace rung {
namespace {

class Pins : public rungproof::Io {
 public:
  std::uint32_t clock_ms() override { return now; }
  std::int32_t read(std::uint8_t pin, rungproof::Signal) override {
    return level[pin];
  }
  void write(std::uint8_t pin, rungproof::Signal, std::int32_t value) override {
    level[pin] = value;
    ++writes;
  }

  std::uint32_t now = 0;
  std::int32_t level[8] = {};
  int writes = 0;
};

/// Serial: takes as many bytes at a time as its buffer has room for.
class Serial {
 public:
  int available() const { return static_cast<int>(in.size()); }
  int read() {
    const auto byte = static_cast<unsigned char>(in.front());
    in.pop_front();
    return byte;
  }
  int availableForWrite() const { return room; }
  void write(std::uint8_t byte) {
    --room;
    out += static_cast<char>(byte);
  }

  std::deque<char> in;
  std::string out;
  int room = 0;
};

/// pin4 = pin2, or pin4 = !pin2, scans of 5 ms at least.
std::string pin_program(bool invert) {
  Image image;
  image.scan_min = 5;
  image.names = "\4pin2\4pin4";
  if (invert) image.code = Image::bytes_of({0x03, 0, 0x05, 0x04, 1, 0x00});
  return image.file();
}

struct Bench {
  Bench() : program(pin_program(false)) {
    EXPECT_EQ(
        controller.begin(reinterpret_cast<const std::uint8_t*>(program.data()),
                         static_cast<std::uint32_t>(program.size())),
        rungproof::Refusal::None);
  }

  /// So many milliseconds; the number of scans.
  int pass(int milliseconds) {
    int scans = 0;
    for (int i = 0; i < milliseconds; ++i) {
      ++pins.now;
      serial.room = 64;
      if (controller.update(serial)) ++scans;
    }
    return scans;
  }

  void put(const std::string& bytes) {
    serial.in.insert(serial.in.end(), bytes.begin(), bytes.end());
  }

  std::string program;
  std::uint8_t programs[512] = {};
  std::uint32_t memory[16] = {};
  Pins pins;
  Serial serial;
  rungproof::LiveController controller{
      {"bench", programs, 256, 16, nullptr}, memory, pins};
};

TEST(LiveController, TakesAProgramBetweenTwoScans) {
  for (const bool clear : {false, true}) {
    Bench bench;
    bench.pins.level[2] = 1;
    EXPECT_EQ(bench.pass(50), 10);
    EXPECT_EQ(bench.pins.level[4], 1);
    const auto requests = upload_requests(pin_program(true), clear);
    for (const std::string& item : requests) bench.put(item);
    // Whatever comes in, scans are made at their times: the old program's up
    // to the switch.
    while (contents(bench.serial.out).size() < requests.size()) {
      ASSERT_EQ(bench.pins.level[4], 1);
      bench.pass(1);
    }
    const int before = bench.pins.writes;
    EXPECT_EQ(bench.pins.level[4], clear ? 0 : 1);
    EXPECT_EQ(bench.pass(5), 1);
    EXPECT_EQ(bench.pins.level[4], 0);
    EXPECT_EQ(bench.pins.writes, before + 1);
  }
}

TEST(LiveController, ShowsTheTimeOfEachScan) {
  Bench bench;
  bench.put(request(rungproof::Command::Monitor, "\1"));
  bench.pass(30);
  bench.pins.now += 40;
  bench.pass(40);
  std::vector<std::uint32_t> times;
  for (const std::string& content : contents(bench.serial.out)) {
    if (content[1] != static_cast<char>(rungproof::kImage)) continue;
    times.push_back(number_at(content, 6));
  }
  ASSERT_GE(times.size(), 8U);
  EXPECT_EQ(std::count(times.begin(), times.end(), 41U), 1);
  EXPECT_EQ(static_cast<std::size_t>(std::count(times.begin(), times.end(), 5)),
            times.size() - 1);
}

TEST(LiveController, TellsWhichPinItDoesNotHave) {
  Bench bench;
  Image image;
  image.names = "\4pin2\4none";
  for (const auto& item : upload_requests(image.file())) bench.put(item);
  bench.pass(100);
  const auto answers = contents(bench.serial.out);
  ASSERT_FALSE(answers.empty());
  const std::string& last = answers.back();
  ASSERT_EQ(last[2], static_cast<char>(rungproof::Answer::Refused));
  EXPECT_EQ(last[3], static_cast<char>(rungproof::Refusal::NoPin));
  EXPECT_EQ(number_at(last, 4), image.file().size() - 5);
  bench.pins.level[2] = 1;
  bench.pass(5);
  EXPECT_EQ(bench.pins.level[4], 1);
}

TEST(LiveController, WithoutAProgramWaitsForOne) {
  Pins pins;
  Serial serial;
  std::uint8_t programs[512] = {};
  std::uint32_t memory[16] = {};
  rungproof::LiveController controller({"empty", programs, 256, 16, nullptr},
                                       memory, pins);
  EXPECT_EQ(controller.begin(nullptr, 0), rungproof::Refusal::TooShort);
  EXPECT_FALSE(controller.update(serial));
  const std::string all = request(rungproof::Command::Hello, "") +
                          request(rungproof::Command::Read, number(0)) +
                          request(rungproof::Command::Monitor, "\1");
  serial.in.assign(all.begin(), all.end());
  for (int i = 0; i < 100; ++i) {
    serial.room = 11;
    controller.update(serial);
  }
  EXPECT_EQ(contents(serial.out).size(), 3U);
  for (const auto& item : upload_requests(pin_program(true))) {
    serial.in.insert(serial.in.end(), item.begin(), item.end());
  }
  for (int i = 0; i < 100; ++i) {
    ++pins.now;
    serial.room = 11;  // ms by ms, at 115200 baud
    controller.update(serial);
  }
  EXPECT_EQ(pins.level[4], 1);
}

}  // namespace
}  // namespace rung
