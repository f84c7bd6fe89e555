#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rung::test {

/// A golden file: directives, then named sections, each begun by a line
/// `--- NAME`. Input and expectation stand in one file.
struct GoldenFile {
  std::string head;
  std::vector<std::pair<std::string, std::string>> sections;

  const std::string* find(std::string_view name) const;
  void set(std::string_view name, std::string text);
};

GoldenFile read_golden(const std::string& path);
void write_golden(const std::string& path, const GoldenFile& golden);

/// The environment asks for the files to be written anew.
bool is_update();

/// Paths below `directory` that end in `ending`, sorted.
std::vector<std::string> golden_paths(const std::string& directory,
                                      const std::string& ending);

/// A file's name as a test's name.
std::string test_name(const std::string& path);

std::vector<std::string> lines_of(std::string_view text);

}  // namespace rung::test
