#include "app/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rung {
namespace {

using Group = std::span<FileReport>;

/// Presets that agree on an answer, in the order of the sweep.
struct Answer {
  std::string_view words;
  std::vector<std::string_view> presets;
};

void add(std::vector<Answer>& answers, std::string_view words,
         std::string_view preset) {
  const auto found =
      std::find_if(answers.begin(), answers.end(),
                   [&](const Answer& answer) { return answer.words == words; });
  if (found == answers.end()) {
    answers.push_back({words, {preset}});
  } else {
    found->presets.push_back(preset);
  }
}

const ObligationResult* find_result(const FileReport& file,
                                    std::string_view name) {
  const auto found = std::find_if(file.results.begin(), file.results.end(),
                                  [&](const ObligationResult& result) {
                                    return result.obligation.name == name;
                                  });
  return found == file.results.end() ? nullptr : &*found;
}

std::vector<std::string_view> names_in(Group group) {
  std::vector<std::string_view> names;
  for (const FileReport& file : group) {
    for (const ObligationResult& result : file.results) {
      const std::string_view name = result.obligation.name;
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
      }
    }
  }
  return names;
}

std::string sentence(std::string_view name,
                     const std::vector<Answer>& answers) {
  std::string out = fmt::format("`{}` depends on the semantics:", name);
  for (const Answer& answer : answers) {
    out += fmt::format("{} {} under `{}`", &answer == &answers[0] ? "" : ",",
                       answer.words, fmt::join(answer.presets, "`, `"));
  }
  return out;
}

/// What is said of one input whose reports are `group`.
std::vector<std::string> notes_on(Group group) {
  std::vector<std::string> notes;
  std::vector<std::string_view> presets;
  for (const FileReport& file : group) presets.push_back(file.semantics);
  for (const std::string_view name : names_in(group)) {
    std::vector<Answer> answers;
    for (const FileReport& file : group) {
      const ObligationResult* const result = find_result(file, name);
      add(answers, result == nullptr ? "not asked" : to_string(result->verdict),
          file.semantics);
    }
    if (answers.size() > 1) notes.push_back(sentence(name, answers));
  }
  if (notes.empty()) {
    notes.push_back(group.size() == 1
                        ? "no other preset of semantics fits"
                        : fmt::format("no verdict depends on the semantics: "
                                      "`{}`",
                                      fmt::join(presets, "`, `")));
  }
  return notes;
}

/// A preset under which the text cannot be read does not fit it, unless none
/// can read it: then the first says why.
void drop_misfits(std::vector<FileReport>& group) {
  const bool readable = std::any_of(
      group.begin(), group.end(),
      [](const FileReport& file) { return file.program != nullptr; });
  if (readable) {
    std::erase_if(group, [](const FileReport& file) { return !file.program; });
  } else {
    group.resize(1);
  }
}

}  // namespace

void note_dependent_verdicts(Report& report) {
  std::vector<FileReport> all;
  for (std::size_t begin = 0; begin < report.files.size();) {
    std::vector<FileReport> group;
    const FileId file = report.files[begin].file;
    std::size_t at = begin;
    while (at < report.files.size() && report.files[at].file == file) {
      group.push_back(std::move(report.files[at++]));
    }
    begin = at;
    drop_misfits(group);
    if (group.front().program) {
      const std::vector<std::string> notes = notes_on(group);
      std::vector<std::string>& first = group.front().notes;
      first.insert(first.end(), notes.begin(), notes.end());
    }
    std::move(group.begin(), group.end(), std::back_inserter(all));
  }
  report.files = std::move(all);
}

}  // namespace rung
