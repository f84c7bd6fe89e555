#include "frontend/rockwell/annotations.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>

#include "frontend/token_list.h"

namespace rung::rockwell {
namespace {

using plcopen::trimmed;

class Reader {
 public:
  Reader(const Text& comment, CommentPlace place, Project& project, Ast& ast,
         ErrorLimit& errors)
      : comment_(comment),
        place_(place),
        project_(project),
        ast_(ast),
        errors_(errors) {}

  void run() {
    ast_.comments.push_back({comment_.text, comment_.where});
    property_lines();
    block("<CBEFORE!", place_.main && place_.first, "first",
          [this](std::string_view it) { input(it); });
    block("<CAFTER!", place_.main && place_.last, "last",
          [this](std::string_view it) { assertion(it); });
  }

 private:
  SourceRange range(std::string_view part) const {
    const auto begin =
        comment_.where.begin +
        static_cast<std::uint32_t>(part.data() - comment_.text.data());
    return {comment_.where.file, begin,
            begin + static_cast<std::uint32_t>(part.size())};
  }

  void property_lines() {
    const std::string_view text = comment_.text;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end =
          std::min(text.find_first_of("\r\n", at), text.size());
      std::string_view line = trimmed(text.substr(at, end - at));
      at = end + 1;
      if (line.starts_with("//")) line.remove_prefix(2);
      if (!line.starts_with("@")) continue;
      line = trimmed(line.substr(1));
      const std::string_view word = line.substr(0, line.find(' '));
      if (word == "language" || word.empty()) continue;
      ast_.annotations.push_back({line, range(line)});
    }
  }

  // The statements between `mark` and `!>`, each up to its `;`.
  template <class Visit>
  void block(std::string_view mark, bool allowed, std::string_view where,
             Visit visit) {
    const std::string_view text = comment_.text;
    for (std::size_t at = text.find(mark); at != text.npos;
         at = text.find(mark, at)) {
      const std::size_t begin = at + mark.size();
      const std::size_t end = text.find("!>", begin);
      const std::string_view name = text.substr(at, mark.size());
      at = begin;
      if (end == text.npos || !allowed) {
        fail(name, end == text.npos ? "this annotation has no `!>`"
                                    : "this annotation is read at the " +
                                          std::string(where) +
                                          " rung of the main routine only");
        continue;
      }
      statements(text.substr(begin, end - begin), visit);
      at = end;
    }
  }

  template <class Visit>
  void statements(std::string_view text, Visit visit) {
    while (!trimmed(text).empty()) {
      const std::size_t end = text.find(';');
      if (end == text.npos) return fail(trimmed(text), "`;` is expected");
      visit(trimmed(text.substr(0, end)));
      text.remove_prefix(end + 1);
    }
  }

  void fail(std::string_view part, std::string message) {
    errors_.error("RP087", range(part), std::move(message));
  }

  // a = nondet_bool()
  void input(std::string_view statement) {
    const std::size_t equal = statement.find('=');
    const std::string_view name = trimmed(statement.substr(0, equal));
    const std::string_view value =
        equal == statement.npos ? "" : trimmed(statement.substr(equal + 1));
    if (value != "nondet_bool()" || !plcopen::is_identifier(name)) {
      return fail(statement, "`name = nondet_bool()` is expected");
    }
    project_.names_inputs = true;
    project_.inputs.emplace(name, range(name));
  }

  /// What is in the brackets at the front, which goes from `text`.
  static std::string_view bracketed(std::string_view& text) {
    text = trimmed(text);
    if (!text.starts_with("(")) return {};
    std::size_t depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '(') ++depth;
      if (text[i] == ')' && --depth == 0) {
        const std::string_view inside = text.substr(0, i + 1);
        text.remove_prefix(i + 1);
        return inside;
      }
    }
    return {};
  }

  // assert(b), if(a) assert(b)
  void assertion(std::string_view statement) {
    std::string_view rest = statement;
    std::string_view condition;
    if (rest.starts_with("if")) {
      rest.remove_prefix(2);
      condition = bracketed(rest);
      rest = trimmed(rest);
      if (condition.empty()) rest = {};
    }
    std::string_view claim;
    if (rest.starts_with("assert")) {
      rest.remove_prefix(6);
      claim = bracketed(rest);
    }
    if (claim.empty() || !trimmed(rest).empty()) {
      return fail(statement,
                  "`assert(...)` or `if(...) assert(...)` is "
                  "expected");
    }
    std::string text = "always ";
    if (!condition.empty()) text += std::string(condition) + " -> ";
    text += claim;
    ast_.made_names.push_back(
        std::make_shared<const std::string>(std::move(text)));
    ast_.annotations.push_back({*ast_.made_names.back(), range(statement)});
  }

  const Text& comment_;
  CommentPlace place_;
  Project& project_;
  Ast& ast_;
  ErrorLimit& errors_;
};

}  // namespace

void read_annotations(const Text& comment, CommentPlace place, Project& project,
                      Ast& ast, ErrorLimit& errors) {
  Reader(comment, place, project, ast, errors).run();
}

}  // namespace rung::rockwell
