// `rungproof upload` and `rungproof monitor` against a controller that runs in
// this process.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/link/served.h"
#include "tests/postfix/image.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCopy =
    "postfix 1\ndialect none\nevaluation strict\nscan 1..100 ms\n"
    "input bit a\noutput bit b\nrungs\na =b\n";
constexpr const char* kScript = "Q0 = (I0 || Q0) && !I1;\n";

/// The program with files of its own.
class Host : public testing::Test {
 protected:
  Host() {
    std::string name = (fs::temp_directory_path() / "link-XXXXXX").string();
    directory_ = ::mkdtemp(name.data());
    write("copy.pf", kCopy);
    write("latch.rung", kScript);
    write("bad.rung", "Q0 = = I0;\n");
    write("invert.bin", invert_program());
  }
  ~Host() override {
    std::error_code ignored;
    fs::remove_all(directory_, ignored);
  }

  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(directory_ / name, std::ios::binary) << bytes;
  }

  Said run(const std::string& arguments) const {
    return shell("cd '" + directory_.string() + "' && '" RUNG_PROGRAM "' " +
                 arguments);
  }

  void expect_refused(const std::string& arguments, int status,
                      const std::string& words) const {
    const Said said = run(arguments);
    EXPECT_EQ(said.status, status) << arguments << '\n' << said.text;
    EXPECT_NE(said.text.find(words), std::string::npos) << arguments << '\n'
                                                        << said.text;
  }

  fs::path directory_;
};

TEST_F(Host, UploadsOverATerminalAndOverTcp) {
  for (const auto wire : {Served::Wire::Terminal, Served::Wire::Tcp}) {
    Eeprom eeprom(512);
    EmulatedController controller(copy_program(), &eeprom);
    Served served(controller, wire);
    const Said said = run("upload invert.bin " + served.option());
    EXPECT_EQ(said.status, 0) << said.text;
    EXPECT_EQ(said.text,
              "emulated: runs invert.bin of 60 bytes, and keeps it without "
              "power\n");
    served.stop();
    EXPECT_EQ(controller.running(), invert_program());
    EXPECT_FALSE(controller.cleared());
    EXPECT_EQ(EmulatedController(copy_program(), &eeprom).running(),
              invert_program());
  }
}

TEST_F(Host, UploadsAnyLanguage) {
  EmulatedController controller(copy_program(), nullptr);
  Served served(controller, Served::Wire::Terminal);
  const Said latch =
      run("upload latch.rung --clear-outputs " + served.option());
  EXPECT_EQ(latch.status, 0) << latch.text;
  EXPECT_NE(latch.text.find("it has no storage"), std::string::npos);
  run("lower latch.rung --to postfix --binary -o latch.bin");
  EXPECT_EQ(run("upload -q - <copy.pf " + served.option()).text, "");
  EXPECT_EQ(run("upload -q latch.rung --clear-outputs " + served.option()).text,
            "");
  served.stop();
  std::ifstream file(directory_ / "latch.bin", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(controller.running(), bytes);
  EXPECT_TRUE(controller.cleared());
}

/// Every so many bytes one is lost or changed.
std::function<std::string(std::string)> lossy(unsigned every) {
  return [every, count = 0U](const std::string& bytes) mutable {
    std::string left;
    for (const char byte : bytes) {
      ++count;
      if (count % every != 0) left += byte;
      if (count % (3 * every) == 0) left += static_cast<char>(count);
    }
    return left;
  };
}

TEST_F(Host, UploadsOverABadWire) {
  EmulatedController controller(copy_program(), nullptr);
  Served served(controller, Served::Wire::Tcp);
  served.heard = lossy(97);
  served.spoken = lossy(101);
  const Said said = run("upload -q invert.bin " + served.option());
  EXPECT_EQ(said.status, 0) << said.text;
  served.stop();
  EXPECT_EQ(controller.running(), invert_program());
}

TEST_F(Host, SaysWhatTheBoardRefuses) {
  class Picky : public EmulatedController {
   public:
    Picky() : EmulatedController(copy_program(), nullptr) {}
    rungproof::Refusal run(const std::uint8_t*, std::uint32_t, rungproof::Space,
                           bool) override {
      return rungproof::Refusal::NoPin;
    }
    std::uint32_t refused_at() const override { return 56; }  // of the name
  };
  Picky controller;
  Served served(controller, Served::Wire::Terminal);
  expect_refused("upload invert.bin " + served.option(), 1,
                 "refuses the program: an input or output is on no pin of the "
                 "board: `a` (refusal 64 at byte 56)");
}

TEST_F(Host, SaysWhatDoesNotFit) {
  EmulatedController small(copy_program(), nullptr, {59, 16});
  {
    Served served(small, Served::Wire::Terminal);
    expect_refused("upload invert.bin " + served.option(), 1,
                   "has 60 bytes, and the board `emulated` takes 59 at most");
  }
  EmulatedController narrow(copy_program(), nullptr, {256, 1});
  {
    Served served(narrow, Served::Wire::Terminal);
    write("many.rung", "Q0 = I0 && I1 && I2 && I3;\n");
    expect_refused("upload many.rung " + served.option(), 1,
                   "of memory, and the board `emulated` has 4");
  }
  EXPECT_EQ(small.running(), copy_program());
  EXPECT_EQ(narrow.running(), copy_program());
}

TEST_F(Host, WaitsWhereAnotherProgramIsBeingStored) {
  Eeprom eeprom(512);
  eeprom.slow_down(3);
  EmulatedController controller(copy_program(), &eeprom);
  for (const std::string& item : upload_requests(copy_program())) {
    ask(controller, item);
  }
  Served served(controller, Served::Wire::Terminal);
  const Said said = run("upload -q invert.bin " + served.option());
  EXPECT_EQ(said.status, 0) << said.text;
  served.stop();
  EXPECT_EQ(EmulatedController(copy_program(), &eeprom).running(),
            invert_program());
}

TEST_F(Host, SaysWhatIsNotStored) {
  Eeprom eeprom(512);
  eeprom.wear_out(30);
  EmulatedController controller(copy_program(), &eeprom);
  Served served(controller, Served::Wire::Terminal);
  expect_refused("upload invert.bin " + served.option(), 1,
                 "its storage did not hold it");
}

TEST_F(Host, RefusesWhatIsNoController) {
  EmulatedController controller(copy_program(), nullptr);
  Served mute(controller, Served::Wire::Terminal);
  mute.spoken = [](const std::string&) { return std::string(); };
  Served noisy(controller, Served::Wire::Terminal);
  noisy.stop();  // nobody is there, but the name is still one
  expect_refused("upload copy.pf --wait 0.2 " + mute.option(), 2,
                 "no answer in 0.2 s");
  expect_refused("monitor --wait 0.2 " + mute.option(), 2,
                 "no answer in 0.2 s");
  expect_refused("upload copy.pf --port none", 2, "No such file");
  expect_refused("upload copy.pf --port copy.pf", 2, "it is no serial port");
  expect_refused("upload copy.pf --port /dev/null", 2, "it is no serial port");
  expect_refused("monitor --tcp 127.0.0.1:1", 2, "onnection refused");
  expect_refused("monitor --tcp here", 2, "HOST:PORT");
  expect_refused("monitor --tcp ::1", 2, "HOST:PORT");
  expect_refused("monitor --tcp 127.0.0.1:", 2, "HOST:PORT");
}

TEST_F(Host, RefusesACommandThatItCannotFollow) {
  expect_refused("upload copy.pf", 2, "needs --port PORT or --tcp HOST:PORT");
  expect_refused("upload copy.pf --port a --tcp b:1", 2, "needs --port");
  expect_refused("monitor", 2, "needs --port");
  expect_refused("upload --port a", 2, "FILE is required");
  expect_refused("upload copy.pf latch.rung --port a", 2, "");
  expect_refused("upload copy.pf --port /dev/tty --baud 1", 2, "no speed of 1");
  expect_refused("upload copy.pf --port a --wait 0", 2, "--wait");
  expect_refused("upload copy.pf --port a --format json", 2, "--format");
  expect_refused("upload bad.rung --port a", 2, "bad.rung");
  expect_refused("upload none.rung --port a", 2, "none.rung");
  expect_refused("monitor --port a --format json", 2, "text and jsonl");
  expect_refused("monitor --port a --format jsonl:x", 2, "text and jsonl");
  expect_refused("monitor --port a --scans 0", 2, "--scans");
}

TEST_F(Host, RefusesAnotherProtocol) {
  EmulatedController controller(copy_program(), nullptr);
  Served served(controller, Served::Wire::Terminal);
  served.spoken = [](const std::string& bytes) {
    std::string changed;
    for (std::string content : contents(bytes)) {
      if (content.size() > 3) content[3] = 9;
      changed += frame(content);
    }
    return changed;
  };
  expect_refused("upload copy.pf " + served.option(), 2,
                 "the board speaks version 9 of the protocol");
}

TEST_F(Host, MonitorsScans) {
  EmulatedController controller(copy_program(), nullptr);
  controller.output(1);
  Served served(controller, Served::Wire::Terminal);
  const Said lines = run("monitor --scans 3 " + served.option());
  EXPECT_EQ(lines.status, 0) << lines.text;
  EXPECT_EQ(std::count(lines.text.begin(), lines.text.end(), '\n'), 3);
  EXPECT_NE(lines.text.find(" ms: a=1 b=1\n"), std::string::npos) << lines.text;
  const Said json = run("monitor --scans 1 --format jsonl " + served.option());
  EXPECT_EQ(json.status, 0);
  EXPECT_TRUE(json.text.starts_with("{\"scan\":")) << json.text;
  EXPECT_NE(json.text.find(R"("dt_ms":1,"values":{"a":1,"b":1}})"),
            std::string::npos)
      << json.text;
  served.stop();
  EXPECT_TRUE(controller.exchange("").empty());  // it was told to end
}

TEST_F(Host, MonitorEndsWhenAskedTo) {
  EmulatedController controller(copy_program(), nullptr);
  Served served(controller, Served::Wire::Tcp);
  const Said said =
      shell("cd '" + directory_.string() + "'; '" RUNG_PROGRAM "' monitor " +
            "--format jsonl " + served.option() +
            " >out & p=$!; until [ -s out ]; do sleep 0.02; done; "
            "kill -TERM $p; wait $p");
  EXPECT_EQ(said.status, 0) << said.text;
  served.stop();
  EXPECT_TRUE(controller.exchange("").empty());
}

TEST_F(Host, MonitorSaysWhyAProgramHasStopped) {
  write("up.pf",
        "postfix 1\ndialect none\nevaluation strict\nscan 1..100 ms\n"
        "input bit a\noutput bit b\nmemory word w in 0..100\nrungs\n"
        "w 1 + =w\na =b\n");
  EmulatedController controller(copy_program(), nullptr);
  Served served(controller, Served::Wire::Terminal);
  EXPECT_EQ(run("upload -q up.pf " + served.option()).status, 0);
  expect_refused("monitor " + served.option(), 1,
                 "the program has stopped: a word would leave its declared "
                 "range");
}

}  // namespace
}  // namespace rung
