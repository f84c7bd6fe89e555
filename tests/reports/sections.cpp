#include "tests/reports/sections.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace rung::test {

const std::string* GoldenFile::find(std::string_view name) const {
  for (const auto& [key, text] : sections) {
    if (key == name) return &text;
  }
  return nullptr;
}

void GoldenFile::set(std::string_view name, std::string text) {
  for (auto& [key, old] : sections) {
    if (key == name) old = std::move(text);
  }
}

GoldenFile read_golden(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  GoldenFile golden;
  std::string* current = &golden.head;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("--- ")) {
      golden.sections.emplace_back(line.substr(4), "");
      current = &golden.sections.back().second;
    } else {
      *current += line + "\n";
    }
  }
  return golden;
}

void write_golden(const std::string& path, const GoldenFile& golden) {
  std::ofstream file(path, std::ios::binary);
  file << golden.head;
  for (const auto& [name, text] : golden.sections) {
    file << "--- " << name << "\n" << text;
    if (!text.empty() && text.back() != '\n') file << "\n";
  }
}

bool is_update() { return std::getenv("RUNG_UPDATE") != nullptr; }

std::vector<std::string> golden_paths(const std::string& directory,
                                      const std::string& ending) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const std::string path = entry.path().string();
    if (path.ends_with(ending)) paths.push_back(path);
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string test_name(const std::string& path) {
  std::string name = std::filesystem::path(path).stem().string();
  for (char& c : name) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                      (c >= '0' && c <= '9');
    if (!good) c = '_';
  }
  return name;
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace rung::test
