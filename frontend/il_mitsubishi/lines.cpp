#include "frontend/il_mitsubishi/lines.h"

#include <algorithm>

namespace rung::melsec {
namespace {

constexpr std::string_view kBlanks = " \t\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

bool is_step_number(std::string_view word) {
  return word.find_first_not_of("0123456789") == std::string_view::npos;
}

class Splitter {
 public:
  Splitter(std::string_view text, FileId file) {
    list_.text = text;
    list_.file = file;
  }

  LineList run() {
    const std::string_view text = list_.text;
    std::size_t at = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
    while (at < text.size()) {
      const std::size_t end =
          std::min(text.find_first_of("\r\n", at), text.size());
      line(at, end);
      at = end + 1;
    }
    return std::move(list_);
  }

 private:
  void line(std::size_t begin, std::size_t end) {
    const std::string_view text = list_.text.substr(begin, end - begin);
    const std::size_t mark = std::min(text.find(';'), text.find("//"));
    if (mark != std::string_view::npos) {
      comment(text.substr(mark + (text[mark] == ';' ? 1 : 2)));
    }
    words(begin, begin + std::min(mark, text.size()));
  }

  void comment(std::string_view text) {
    const bool is_line = text.starts_with("@");
    if (is_line) text = trimmed(text.substr(1));
    const auto from =
        static_cast<std::uint32_t>(text.data() - list_.text.data());
    const SourceRange where = {list_.file, from,
                               from + static_cast<std::uint32_t>(text.size())};
    if (is_line) {
      list_.annotations.push_back({text, where});
    } else {
      list_.comments.push_back({text, where});
    }
  }

  void words(std::size_t at, std::size_t limit) {
    const std::string_view text = list_.text.substr(0, limit);
    Line line;
    bool first = true;
    while ((at = text.find_first_not_of(kBlanks, at)) != text.npos) {
      const std::size_t end =
          std::min(text.find_first_of(kBlanks, at), text.size());
      const bool step = first && is_step_number(text.substr(at, end - at));
      first = false;
      if (!step) {
        if (line.count < Line::kMost) {
          line.words[line.count] = {static_cast<std::uint32_t>(at),
                                    static_cast<std::uint32_t>(end)};
        }
        ++line.count;
      }
      at = end;
    }
    if (line.count > 0) list_.lines.push_back(line);
  }

  LineList list_;
};

}  // namespace

LineList split_lines(std::string_view text, FileId file) {
  return Splitter(text, file).run();
}

}  // namespace rung::melsec
