#include "reports/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "reports/unicode.h"

namespace rung {
namespace {

/// One underline: byte columns [begin, end) of a line.
struct Underline {
  FileId file;
  LineColumn place;  // of the whole range
  std::uint32_t line = 1;
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string_view text;
  bool primary = true;
};

/// A line laid out for a terminal: what to show, and where the underline is.
struct Layout {
  std::string text;
  std::size_t skip = 0;   // columns before the underline
  std::size_t width = 1;  // columns of the underline
};

std::size_t indent_of(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string_view::npos ? 0 : first;
}

/// The byte in `line` (a line of `source`) where `offset` falls.
std::size_t byte_column(const SourceFile& source, std::string_view line,
                        std::uint32_t offset) {
  const auto start =
      static_cast<std::size_t>(line.data() - source.text().data());
  return offset <= start ? 0 : std::min(line.size(), offset - start);
}

/// One underline a line for the lines of `mark` that are worth showing.
void add_underlines(const SourceFile& source, const Mark& mark,
                    const Place& place, std::vector<Underline>& out) {
  // A range that ends behind a line's end marks nothing of the next line.
  const bool ends_at_margin =
      place.end.column == 1 && place.end.line > place.begin.line;
  const std::uint32_t first = place.begin.line;
  const std::uint32_t last = place.end.line - (ends_at_margin ? 1 : 0);
  for (std::uint32_t number = first; number <= last; ++number) {
    if (number == first + 2 && last > first + 2) number = last;
    const std::string_view line = source.line(number);
    Underline underline = {mark.where.file,
                           place.begin,
                           number,
                           number == first
                               ? byte_column(source, line, mark.where.begin)
                               : indent_of(line),
                           number == last && !ends_at_margin
                               ? byte_column(source, line, mark.where.end)
                               : line.size(),
                           {},
                           mark.primary};
    if (number == last) underline.text = mark.text;
    out.push_back(underline);
  }
}

/// The bytes of `line` that are shown: all, or some around the underline.
std::pair<std::size_t, std::size_t> window(std::string_view line,
                                           const Underline& underline) {
  if (line.size() <= kFrameWidth) return {0, line.size()};
  const auto continues = [&](std::size_t at) {
    return at < line.size() &&
           (static_cast<unsigned char>(line[at]) & 0xc0U) == 0x80U;
  };
  std::size_t begin =
      underline.begin > kFrameWidth / 3 ? underline.begin - kFrameWidth / 3 : 0;
  while (begin > 0 && continues(begin)) --begin;
  std::size_t end = std::min(line.size(), begin + kFrameWidth);
  while (continues(end)) ++end;
  return {begin, end};
}

Layout lay_out(std::string_view line, const Underline& underline) {
  const auto [begin, end] = window(line, underline);
  Layout layout;
  layout.width = 0;
  if (begin > 0) layout.text = "...";
  std::size_t column = layout.text.size();
  layout.skip = column;
  for (std::size_t at = begin; at < end;) {
    if (plain_bytes(line.substr(at, 1), 0) != 0) {
      layout.text += line[at++];
      ++column;
    } else {
      const Character character = decode(line, at);
      const Printable shown =
          printable(character, line.substr(at, character.bytes), column);
      layout.text += shown.text;
      column += shown.width;
      at += character.bytes;
    }
    if (at <= underline.begin) {
      layout.skip = column;
    } else if (at <= underline.end) {
      layout.width = column - layout.skip;
    }
  }
  if (end < line.size()) layout.text += "...";
  layout.width = std::max<std::size_t>(layout.width, 1);
  return layout;
}

class Drawing {
 public:
  Drawing(const SourceSet& sources, Ink ink, const Painter& paint,
          std::size_t gutter)
      : sources_(sources), ink_(ink), paint_(paint), gutter_(gutter) {}

  void header(FileId file, LineColumn at, bool first) {
    out_ += std::string(gutter_, ' ') +
            paint_(Ink::Frame, first ? "-->" : ":::") + " " +
            printable(sources_[file].path()) +
            fmt::format(":{}:{}\n", at.line, at.column);
    line_ = 0;
    file_ = file;
    if (is_empty()) return;
    bar();
    out_ += '\n';
  }

  /// There is nothing to see in a file that could not be read.
  bool is_empty() const { return sources_[file_].text().empty(); }

  void draw(const Underline& underline) {
    const Layout layout =
        lay_out(sources_[file_].line(underline.line), underline);
    if (underline.line != line_ || layout.text != shown_) {
      source_line(underline.line, layout.text);
    }
    bar();
    out_ += std::string(1 + layout.skip, ' ');
    std::string marks(layout.width, underline.primary ? '^' : '-');
    if (!underline.text.empty()) marks += " " + printable(underline.text);
    out_ += paint_(underline.primary ? ink_ : Ink::Frame, marks) + "\n";
  }

  std::string take() { return std::move(out_); }

 private:
  void bar() {
    out_ += std::string(gutter_ + 1, ' ') + paint_(Ink::Frame, "|");
  }

  void source_line(std::uint32_t number, const std::string& text) {
    if (line_ != 0 && number > line_ + 1) {
      out_ += paint_(Ink::Frame, "...") + "\n";
    }
    out_ += paint_(Ink::Frame, fmt::format("{:>{}} |", number, gutter_));
    if (!text.empty()) out_ += " " + text;
    out_ += '\n';
    line_ = number;
    shown_ = text;
  }

  const SourceSet& sources_;
  Ink ink_;
  const Painter& paint_;
  std::size_t gutter_;
  FileId file_;
  std::uint32_t line_ = 0;
  std::string shown_;
  std::string out_;
};

}  // namespace

std::string draw_frame(const SourceSet& sources, const std::vector<Mark>& marks,
                       Ink ink, const Painter& paint, Locator& locator) {
  std::vector<Underline> underlines;
  for (const Mark& mark : marks) {
    const Place place = locator.of(mark.where);
    add_underlines(sources[mark.where.file], mark, place, underlines);
  }
  if (underlines.empty()) return {};
  const FileId home = underlines.front().file;
  const LineColumn home_place = underlines.front().place;
  std::uint32_t widest = 0;
  for (const Underline& one : underlines) widest = std::max(widest, one.line);
  std::stable_sort(
      underlines.begin(), underlines.end(),
      [home](const Underline& a, const Underline& b) {
        return std::tuple(a.file != home, a.file, a.line, a.begin, a.end) <
               std::tuple(b.file != home, b.file, b.line, b.begin, b.end);
      });
  Drawing drawing(sources, ink, paint, fmt::formatted_size("{}", widest));
  FileId file;
  for (const Underline& one : underlines) {
    const bool is_home = one.file == home;
    if (one.file != file) {
      drawing.header(one.file, is_home ? home_place : one.place, is_home);
    }
    file = one.file;
    if (!drawing.is_empty()) drawing.draw(one);
  }
  return drawing.take();
}

}  // namespace rung
