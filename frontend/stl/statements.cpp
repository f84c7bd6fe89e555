#include "frontend/stl/statements.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

namespace rung::stl {
namespace {

constexpr std::string_view kBlanks = " \t\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           (c >= '0' && c <= '9') || c == '_';
  });
}

/// Words that begin a line above BEGIN, or a network, and have no meaning.
bool is_heading(std::string_view word) {
  constexpr std::array<std::string_view, 9> kHeadings = {
      "TITLE",   "AUTHOR",           "FAMILY",   "NAME", "VERSION",
      "NETWORK", "KNOW_HOW_PROTECT", "STANDARD", "BEGIN"};
  return std::find(kHeadings.begin(), kHeadings.end(), word) != kHeadings.end();
}

class Splitter {
 public:
  Splitter(std::string_view text, FileId file, ErrorLimit& errors)
      : text_(text), file_(file), errors_(errors) {}

  Source run() {
    std::size_t at = text_.starts_with("\xef\xbb\xbf") ? 3 : 0;
    while (at < text_.size()) {
      const std::size_t end =
          std::min(text_.find_first_of("\r\n", at), text_.size());
      line(text_.substr(at, end - at));
      at = end + 1;
    }
    if (open_) {
      errors_.error("RP042", source_.blocks.back().where,
                    "this block has no end");
    }
    return std::move(source_);
  }

 private:
  enum class Part : std::uint8_t { Outside, Head, Variables, Body };

  SourceRange range_of(std::string_view part) const {
    const auto begin = static_cast<std::uint32_t>(part.data() - text_.data());
    return {file_, begin, begin + static_cast<std::uint32_t>(part.size())};
  }

  void line(std::string_view text) {
    const std::size_t mark = text.find("//");
    if (mark != std::string_view::npos) {
      comment(text.substr(mark + 2));
      text = text.substr(0, mark);
    }
    text = trimmed(text);
    if (text.empty()) return;
    const std::size_t end = text.find_first_of(" \t=:;");
    const std::string word = squeezed(text.substr(0, end));
    if (!skip_to_.empty()) {
      if (word == skip_to_) skip_to_.clear();
      return;
    }
    if (block_line(word, text)) return;
    if (part_ == Part::Variables) return;
    if (part_ == Part::Head) {
      errors_.error("RP042", range_of(text),
                    quoted_excerpt(text) + " above `BEGIN` is not supported");
      return;
    }
    while (!text.empty()) {
      const std::size_t stop = std::min(text.find(';'), text.size());
      statement(trimmed(text.substr(0, stop)));
      text = text.substr(std::min(stop + 1, text.size()));
    }
  }

  void comment(std::string_view text) {
    const bool is_line = text.starts_with("@");
    if (is_line) text = trimmed(text.substr(1));
    if (is_line) {
      source_.annotations.push_back({text, range_of(text)});
    } else {
      source_.comments.push_back({text, range_of(text)});
    }
  }

  /// Lines that are no instructions. False: it is none of these.
  bool block_line(const std::string& word, std::string_view text) {
    if (word.starts_with("VAR")) return begin_variables(word, text);
    if (word == "END_VAR") {
      part_ = Part::Head;
      return true;
    }
    if (part_ == Part::Variables) return false;
    if (word == "ORGANIZATION_BLOCK" || word == "FUNCTION") {
      begin_block(word, text);
      return true;
    }
    if (word == "END_ORGANIZATION_BLOCK" || word == "END_FUNCTION") {
      end_block(word, text);
      return true;
    }
    if (word == "FUNCTION_BLOCK" || word == "DATA_BLOCK" || word == "TYPE") {
      errors_.error("RP041", range_of(text),
                    quoted_excerpt(word) +
                        " is not supported: OB 1, OB 100 and functions are");
      skip_to_ = "END_" + word;  // what it holds is of no interest
      return true;
    }
    if (!is_heading(word) || (part_ == Part::Body && word == "NAME")) {
      return false;
    }
    if (word == "BEGIN") part_ = Part::Body;
    return true;
  }

  bool begin_variables(const std::string& word, std::string_view text) {
    if (part_ == Part::Variables) return true;
    if (word != "VAR_TEMP") {
      errors_.error("RP041", range_of(text),
                    quoted_excerpt(word) +
                        " is not supported: functions without parameters are");
    }
    part_ = Part::Variables;
    return true;
  }

  void begin_block(const std::string& word, std::string_view text) {
    Block block;
    const bool function = word == "FUNCTION";
    block.kind = function ? BlockKind::Function : BlockKind::Organization;
    block.where = range_of(text);
    std::string name = squeezed(text.substr(word.size()));
    const bool value =
        name.find(':') != std::string::npos && !name.ends_with(":VOID");
    name = name.substr(0, name.find_first_of(":;{"));
    const std::string_view prefix = function ? "FC" : "OB";
    const char* const end = name.data() + name.size();
    std::uint32_t number = 0;
    const bool numbered =
        name.starts_with(prefix) &&
        std::from_chars(name.data() + 2, end, number).ptr == end &&
        name.size() > 2 && name.size() < 8;
    if (!numbered || value || number > 65'535) {
      errors_.error("RP041", block.where,
                    value ? "a function with a value is not supported"
                          : "expected a block such as `" + std::string(prefix) +
                                " 1` and found " + quoted_excerpt(text));
    }
    block.number = number;
    if (open_) {
      errors_.error("RP042", block.where, "the block above has no end");
    }
    source_.blocks.push_back(std::move(block));
    part_ = Part::Head;
    open_ = true;
  }

  void end_block(const std::string& word, std::string_view text) {
    const bool function = word == "END_FUNCTION";
    const bool fits = open_ && (source_.blocks.back().kind ==
                                BlockKind::Function) == function;
    if (!fits) {
      errors_.error("RP042", range_of(text),
                    quoted_excerpt(word) + " ends no block");
    }
    open_ = false;
    part_ = Part::Outside;
  }

  void statement(std::string_view text) {
    if (text.empty()) return;
    Statement result;
    result.where = range_of(text);
    const std::size_t colon = text.find(':');
    if (colon != std::string_view::npos && is_name(text.substr(0, colon)) &&
        !text.substr(colon).starts_with(":=")) {
      result.label = squeezed(text.substr(0, colon));
      text = trimmed(text.substr(colon + 1));
    }
    std::size_t end = std::min(text.find_first_of(kBlanks), text.size());
    // `=L0.0` is written without a blank.
    if (text.size() > 1 && text[0] == '=' && is_name(text.substr(1, 1))) {
      end = 1;
    }
    result.name = squeezed(text.substr(0, end));
    operands(text.substr(end), result);
    body().push_back(std::move(result));
  }

  void operands(std::string_view text, Statement& result) {
    text = trimmed(text);
    while (!text.empty()) {
      const std::size_t stop = std::min(text.find(','), text.size());
      const std::string_view part = trimmed(text.substr(0, stop));
      result.operands.push_back(
          {squeezed(part), part.empty() ? result.where : range_of(part)});
      text = text.substr(std::min(stop + 1, text.size()));
    }
  }

  /// A list without blocks is OB 1. Behind a block there is nothing.
  std::vector<Statement>& body() {
    if (!open_) {
      if (!source_.blocks.empty() && !bare_) {
        errors_.error("RP042", source_.blocks.back().where,
                      "instructions stand below the end of this block");
      }
      if (source_.blocks.empty()) {
        source_.blocks.emplace_back();
        source_.blocks.back().where = {file_, 0, 0};
      }
      bare_ = true;
    }
    return source_.blocks.back().body;
  }

  std::string_view text_;
  FileId file_;
  ErrorLimit& errors_;
  Source source_;
  Part part_ = Part::Outside;
  std::string skip_to_;  // the end of a block that is not supported
  bool open_ = false;
  bool bare_ = false;
};

}  // namespace

std::string squeezed(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (kBlanks.find(c) != std::string_view::npos) continue;
    result += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return result;
}

Source split(std::string_view text, FileId file, ErrorLimit& errors) {
  return Splitter(text, file, errors).run();
}

}  // namespace rung::stl
