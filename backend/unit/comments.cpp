#include "backend/unit/comments.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace rung::backend {
namespace {

constexpr std::string_view kBlanks = " \t\r*";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

/// The lines of a comment that say something.
std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    if (!line.empty()) {
      std::string plain(line);
      std::replace_if(
          plain.begin(), plain.end(),
          [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
      lines.push_back(std::move(plain));
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

std::vector<std::size_t> dotted_ends(std::string_view text, std::size_t end) {
  constexpr std::size_t kMost = 3;  // so this is linear
  std::vector<std::size_t> ends;
  while (ends.size() < kMost && end + 1 < text.size() && text[end] == '.' &&
         is_word(text[end + 1])) {
    ++end;
    while (end < text.size() && is_word(text[end])) ++end;
    ends.push_back(end);
  }
  return ends;
}

std::vector<std::string_view> names_in(std::string_view text) {
  std::vector<std::string_view> names;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_word(text[end])) ++end;
    if (end == at) {
      ++at;
      continue;
    }
    names.push_back(text.substr(at, end - at));
    for (const std::size_t longer : dotted_ends(text, end)) {
      names.push_back(text.substr(at, longer - at));
    }
    at = end;
  }
  return names;
}

RungComments place_comments(const Program& program, const SourceSet& sources) {
  RungComments placed;
  placed.before.resize(program.rungs.size());
  // By place in the file; rungs of one place in scan order.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rungs;
  for (const RungId id : ids_of(program.rungs)) {
    const SourceRange where = program.rungs[id].where;
    if (where.has_value() && where.file == program.file) {
      rungs.emplace_back(where.begin, id.index());
    }
  }
  std::stable_sort(
      rungs.begin(), rungs.end(),
      [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const AstComment& comment : program.comments) {
    if (!comment.where.has_value()) continue;
    const auto after = std::lower_bound(rungs.begin(), rungs.end(),
                                        std::pair(comment.where.begin, 0U));
    const auto line_of = [&](std::uint32_t offset) {
      return sources[comment.where.file].position(offset).line;
    };
    auto rung = after;
    if (after != rungs.begin()) {
      const std::uint32_t last =
          program.rungs[RungId(std::prev(after)->second)].where.end;
      if (line_of(last) == line_of(comment.where.begin)) {
        rung = std::prev(after);
      }
    }
    std::vector<std::string>& lines =
        rung == rungs.end() ? placed.at_end : placed.before[rung->second];
    for (std::string& line : lines_of(comment.text)) {
      lines.push_back(std::move(line));
    }
  }
  return placed;
}

PropertyLines carry_properties(
    const Program& program,
    const std::vector<std::pair<std::string, std::string>>& signals) {
  std::unordered_map<std::string_view, std::string_view> names;
  for (const auto& [source, target] : signals) names.emplace(source, target);
  PropertyLines result;
  for (const AstAnnotation& annotation : program.annotations) {
    const std::string_view text = annotation.text;
    const std::string_view first = text.substr(0, text.find_first_of(" \t"));
    if (first == "language" || first == "dialect" || first == "output") {
      continue;
    }
    bool carried = first != "expect" && first != "allow";
    for (const Instance& instance : program.instances) {
      // Elements are others there.
      if (text.find(instance.name) != std::string_view::npos) carried = false;
    }
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
      std::size_t end = at;
      while (end < text.size() && is_word(text[end])) ++end;
      if (end == at) {
        line += text[at++];
        continue;
      }
      auto found = names.find(text.substr(at, end - at));
      for (const std::size_t longer : dotted_ends(text, end)) {
        const auto other = names.find(text.substr(at, longer - at));
        if (other == names.end()) continue;
        found = other;
        end = longer;
      }
      const std::string_view word = text.substr(at, end - at);
      line += found == names.end() ? word : found->second;
      at = end;
    }
    (carried ? result.lines : result.comments).push_back(std::move(line));
  }
  return result;
}

}  // namespace rung::backend
