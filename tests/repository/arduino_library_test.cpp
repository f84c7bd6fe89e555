// runtime/ follows the rules for Arduino libraries; and the script that says so
// notices each mistake that is put into a copy of it.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>

namespace rung {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct Outcome {
  int status = -1;
  std::string output;
};

Outcome check(const std::string& folders) {
  const std::string command =
      RUNG_ROOT "/scripts/check-arduino-library " + folders + " 2>&1";
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  Outcome outcome;
  if (pipe == nullptr) return outcome;
  std::array<char, 4096> buffer{};
  while (const std::size_t size =
             std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    outcome.output.append(buffer.data(), size);
  }
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) outcome.status = WEXITSTATUS(status);
  return outcome;
}

TEST(ArduinoLibrary, FollowsTheRules) {
  const Outcome outcome = check("");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_EQ(outcome.output, "");
}

TEST(ArduinoLibrary, HasTheProjectsVersionAndLicence) {
  const std::string project = read_text(RUNG_ROOT "/CMakeLists.txt");
  const std::string properties =
      read_text(RUNG_ROOT "/runtime/library.properties");
  const std::size_t at = properties.find("version=") + 8;
  const std::string version =
      properties.substr(at, properties.find('\n', at) - at);
  EXPECT_NE(project.find("VERSION " + version + " "), std::string::npos);
  EXPECT_EQ(read_text(RUNG_ROOT "/LICENSE"),
            read_text(RUNG_ROOT "/runtime/LICENSE"));
}

/// A mistake: a file in which `from` becomes `to`, an empty `from` meaning that
/// `to` is added; and what the script says of it.
struct Mistake {
  const char* file;
  const char* from;
  const char* to;
  const char* said;
};

const Mistake kMistakes[] = {
    {"library.properties", "name=Rungproof", "name=ArduinoRungproof",
     "name: Arduino is reserved"},
    {"library.properties", "name=Rungproof", "name=Rung proof",
     "without blanks"},
    {"library.properties", "name=Rungproof", "name=Proof",
     "no header called like the library"},
    {"library.properties", "name=Rungproof",
     "name=RungproofRungproofRungproofRungproof", "1 to 32 letters"},
    {"library.properties", "version=0.1.0", "version=0.1", "version: not as"},
    {"library.properties", "version=0.1.0", "version=0.01.0",
     "version: not as"},
    {"library.properties", "author=", "writer=", "no author"},
    {"library.properties", "author=", "writer=", "what is `writer="},
    {"library.properties", "category=Device Control", "category=Devices",
     "category: not of the list"},
    {"library.properties", "architectures=*", "architectures=", "no archi"},
    {"library.properties", "architectures=*", "architectures=AVR",
     "architectures: not as"},
    {"library.properties", "url=https://", "url=", "url: not as"},
    {"library.properties", "includes=Rungproof.h", "includes=rungproof.h",
     "there is no src/rungproof.h"},
    {"library.properties", "", "depends=,\n", "depends: not as"},
    {"library.properties", "", "version=0.1.0\n", "version twice"},
    {"keywords.txt", "update\t", "update ", "a word, one tab"},
    {"keywords.txt", "update\t", "update\t\t", "a word, one tab"},
    {"keywords.txt", "Machine\tKEYWORD1", "Machine\tKEYWORD9",
     "a word, one tab"},
    {"keywords.txt", "Machine\t", "Maschine\t", "no header has Maschine"},
    {"keywords.txt", "", "update\tKEYWORD2\n", "keywords.txt: twice"},
    {"src/rungproof_arduino.h", "<Arduino.h>", "<arduino.h>",
     "written with a capital"},
    {"src/rungproof_controller.cpp", "", "int* leak() { return new int; }\n",
     "no heap, delay()"},
    {"examples/StartStop/StartStop.ino", "controller.update();",
     "controller.update(); delay(10);", "no heap, delay()"},
    {"examples/startstop/StartStop.ino", "", "\n",
     "no examples/startstop/startstop.ino"},
    {"examples/Start Stop/Start Stop.ino", "", "\n", "the name of an example"},
    {"extra.cpp", "", "\n", "a source outside src/"},
    {"Examples/readme", "", "\n", "misnamed: Examples"},
    {"src/.gitmodules", "", "\n", "submodules"},
};

/// Whether a line that begins with `begin` holds `text`.
bool says(const std::string& output, const std::string& begin,
          const std::string& text) {
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(begin) && line.find(text) != std::string::npos) {
      return true;
    }
  }
  return false;
}

class Copies {
 public:
  Copies() {
    std::string name =
        (fs::temp_directory_path() / "rungproof-XXXXXX").string();
    root_ = ::mkdtemp(name.data());
  }
  ~Copies() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  Copies(const Copies&) = delete;
  Copies& operator=(const Copies&) = delete;

  /// A copy of the library; its name.
  std::string add() {
    const std::string name = "copy" + std::to_string(count_++) + "-";
    fs::copy(RUNG_ROOT "/runtime", root_ / name, fs::copy_options::recursive);
    folders_ += " '" + (root_ / name).string() + "'";
    return name;
  }
  fs::path path(const std::string& name) const { return root_ / name; }
  const std::string& folders() const { return folders_; }

 private:
  fs::path root_;
  int count_ = 0;
  std::string folders_;
};

std::string with_mistake(std::string text, const Mistake& mistake) {
  const std::string from = mistake.from;
  if (from.empty()) return text + mistake.to;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << mistake.file << ": " << from;
  if (at != std::string::npos) text.replace(at, from.size(), mistake.to);
  return text;
}

TEST(ArduinoLibrary, EachMistakeIsNoticed) {
  Copies copies;
  std::map<std::string, std::string> expected;
  for (const Mistake& mistake : kMistakes) {
    const std::string copy = copies.add();
    expected[copy] = mistake.said;
    const fs::path file = copies.path(copy) / mistake.file;
    const std::string text = with_mistake(read_text(file), mistake);
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  for (const char* needed :
       {"README.md", "LICENSE", "keywords.txt", "library.properties",
        "src/Rungproof.h", "examples/StartStop/StartStop.ino"}) {
    const std::string copy = copies.add();
    expected[copy] = "no ";
    fs::remove(copies.path(copy) / needed);
  }
  const Outcome outcome = check(copies.folders());
  EXPECT_EQ(outcome.status, 1);
  for (const auto& [copy, said] : expected) {
    EXPECT_TRUE(says(outcome.output, copy, said)) << copy << " " << said;
  }
}

}  // namespace
}  // namespace rung
