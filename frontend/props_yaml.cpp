#include "frontend/props_yaml.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace rung {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

/// The next line, without its end.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return line;
}

bool says_nothing(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.starts_with("#");
}

class YamlReader {
 public:
  YamlProperties read(std::string_view text) {
    bool begun = false;
    while (!text.empty() && result_.error.empty()) {
      ++line_;
      made_.clear();
      const std::string_view line = take_line(text);
      if (!says_nothing(line)) {
        if (begun) {
          entry_line(trimmed(line));
        } else if (trimmed(line) == "properties:") {
          begun = true;
        } else {
          fail("a file of properties begins with `properties:`");
        }
      }
      lines_.push_back(std::move(made_));
    }
    finish_entry();
    for (const std::string& line : lines_) result_.lines += line + "\n";
    return std::move(result_);
  }

 private:
  struct Entry {
    std::string id;
    std::string kind;
    std::string value;  // the expression, or the variables
    std::size_t line = 0;
    bool open = false;
  };

  void fail(const std::string& message) {
    if (result_.error.empty()) {
      result_.error = "line " + std::to_string(line_) + ": " + message;
    }
  }

  void entry_line(std::string_view line) {
    if (line.starts_with("- ")) {
      finish_entry();
      entry_ = {};
      entry_.open = true;
      line = trimmed(line.substr(2));
    }
    const std::size_t colon = line.find(':');
    if (!entry_.open || colon == std::string_view::npos) {
      return fail("expected `- id: NAME` or `key: value`");
    }
    const std::string_view key = trimmed(line.substr(0, colon));
    const std::string value = scalar(trimmed(line.substr(colon + 1)));
    if (key == "id") {
      entry_.id = value;
    } else if (key == "kind") {
      entry_.kind = value;
    } else if (key == "expression" || key == "variables") {
      if (!entry_.value.empty()) return fail("a second `expression`");
      entry_.value = value;
      entry_.line = line_;
    } else if (key != "description" && key != "justification") {
      fail("the key `" + std::string(key) + "` is not supported");
    }
  }

  /// `"text"`, `'text'`, `text # comment` or `[a, b]`.
  std::string scalar(std::string_view text) {
    const char first = text.empty() ? ' ' : text.front();
    if (first == '"' || first == '\'' || first == '[') {
      const std::size_t end = text.find(first == '[' ? ']' : first, 1);
      const std::string_view inner =
          text.substr(1, end == text.npos ? text.npos : end - 1);
      if (end == text.npos || !says_nothing(text.substr(end + 1)) ||
          inner.find('\\') != text.npos) {
        fail("a value that ends on its line, without escapes, is expected");
      }
      return std::string(trimmed(inner));
    }
    if (first == '|' || first == '>' || first == '&' || first == '*' ||
        first == '{') {
      fail("a value of one line is expected");
    }
    return std::string(trimmed(text.substr(0, text.find(" #"))));
  }

  void finish_entry() {
    if (!entry_.open) return;
    entry_.open = false;
    std::string statement;
    if (entry_.kind == "invariant") {
      statement = "always ";
    } else if (entry_.kind == "absence") {
      statement = "never ";
    } else if (entry_.kind == "reachability") {
      statement = "reach ";
    } else if (entry_.kind == "mutual_exclusion") {
      statement = "interlock ";
    } else {
      return fail("the kind `" + entry_.kind +
                  "` of the property above is not supported");
    }
    if (entry_.id.empty() || entry_.value.empty()) {
      return fail("the property above has no `id` or no `expression`");
    }
    std::string text = entry_.id + ": " + statement + entry_.value;
    const std::size_t index = entry_.line - 1;
    (index < lines_.size() ? lines_[index] : made_) = std::move(text);
  }

  YamlProperties result_;
  std::vector<std::string> lines_;
  std::string made_;  // of this line
  Entry entry_;
  std::size_t line_ = 0;
};

}  // namespace

bool is_properties_yaml(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = take_line(text);
    if (!says_nothing(line)) return trimmed(line) == "properties:";
  }
  return false;
}

YamlProperties read_properties_yaml(std::string_view text) {
  return YamlReader().read(text);
}

}  // namespace rung
