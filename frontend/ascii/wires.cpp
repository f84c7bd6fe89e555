#include "frontend/ascii/wires.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "frontend/ascii/boxes.h"
#include "frontend/token_list.h"

namespace rung::ascii {
namespace {

struct SymbolRow {
  std::string_view text;
  Symbol symbol;
};
constexpr std::array kSymbols = {
    SymbolRow{"[ ]", Symbol::Contact}, SymbolRow{"[/]", Symbol::NegatedContact},
    SymbolRow{"[>]", Symbol::Greater}, SymbolRow{"[<]", Symbol::Less},
    SymbolRow{"( )", Symbol::Coil},    SymbolRow{"(/)", Symbol::NegatedCoil},
    SymbolRow{"(S)", Symbol::Set},     SymbolRow{"(R)", Symbol::Reset},
};

class Tracer {
 public:
  Tracer(Drawing& drawing, ErrorLimit& errors)
      : drawing_(drawing),
        errors_(errors),
        boxes_(take_boxes(drawing, errors)),
        seen_(drawing.rows()) {
    for (std::uint32_t row = 0; row < drawing.rows(); ++row) {
      seen_[row].assign(drawing.columns(row), false);
    }
  }

  Wires run() {
    find_links();
    find_rail();
    for (std::uint32_t row = 0; row < drawing_.rows(); ++row) {
      for (std::uint32_t column = 0; column < drawing_.columns(row); ++column) {
        if (drawing_.at(row, column) == '+') start_run(row, column);
      }
    }
    check_links();
    check_rest();
    for (const auto& [place, box] : boxes_) {
      errors_.error("RP051", box.where, "no wire goes into this box");
    }
    return std::move(out_);
  }

 private:
  void error(std::string_view code, std::uint32_t row, std::uint32_t begin,
             std::uint32_t end, std::string message) {
    errors_.error(code, drawing_.range(row, begin, end), std::move(message));
  }

  std::uint32_t link_at(std::uint32_t row, std::uint32_t column) const {
    if (row >= link_.size() || column >= link_[row].size()) return kNoLink;
    return link_[row][column];
  }

  bool is_seen(std::uint32_t row, std::uint32_t column) const {
    return column < seen_[row].size() && seen_[row][column];
  }

  // --- vertical links --------------------------------------------------------

  void find_links() {
    link_.resize(drawing_.rows());
    for (std::uint32_t row = 0; row < drawing_.rows(); ++row) {
      link_[row].assign(drawing_.columns(row), kNoLink);
      for (std::uint32_t column = 0; column < drawing_.columns(row); ++column) {
        const char c = drawing_.at(row, column);
        if (c != '+' && c != '|') continue;
        seen_[row][column] = true;
        std::uint32_t& link = link_[row][column];
        if (row > 0) link = link_at(row - 1, column);
        if (link == kNoLink) {
          link = static_cast<std::uint32_t>(out_.links.size());
          out_.links.push_back({.place = {row, column}});
        }
        out_.links[link].plus = out_.links[link].plus || c == '+';
      }
    }
  }

  void find_rail() {
    std::uint32_t rail = kNoLink;
    for (const Link& link : out_.links)
      rail = std::min(rail, link.place.column);
    for (Link& link : out_.links) link.rail = link.place.column == rail;
  }

  // A link that stands free has power from the left, and ends in joints.
  void check_links() {
    for (std::uint32_t row = 0; row < drawing_.rows(); ++row) {
      for (std::uint32_t column = 0; column < link_[row].size(); ++column) {
        const std::uint32_t id = link_[row][column];
        if (id == kNoLink || out_.links[id].rail) continue;
        const Link& link = out_.links[id];
        if (!link.plus && right_rail_.size() > id && right_rail_[id]) continue;
        const bool top = link.place == Place{row, column};
        if (top && link.incoming == 0) {
          error("RP051", row, column, column + 1,
                "no wire comes from the left to this one");
          continue;
        }
        const bool bottom = link_at(row + 1, column) == kNoLink;
        if ((top || bottom) && drawing_.at(row, column) == '|') {
          error("RP051", row, column, column + 1,
                "this wire ends in nothing: a joint is `+`");
        }
      }
    }
  }

  void check_rest() {
    for (std::uint32_t row = 0; row < drawing_.rows(); ++row) {
      for (const Text& text : drawing_.texts(row)) {
        if (text.used) {
          std::fill(seen_[row].begin() + text.begin,
                    seen_[row].begin() + text.end, true);
        }
      }
      for (std::uint32_t i = 0; i < drawing_.columns(row); ++i) {
        if (drawing_.at(row, i) == ' ' || is_seen(row, i)) continue;
        std::uint32_t end = i + 1;
        while (drawing_.at(row, end) != ' ' && !is_seen(row, end)) ++end;
        error("RP051", row, i, end, "this belongs to no element and no wire");
        i = end;
      }
    }
  }

  // --- runs ------------------------------------------------------------------

  void start_run(std::uint32_t row, std::uint32_t column) {
    const char next = drawing_.at(row, column + 1);
    if (next == '+' || next == '|') {
      error("RP051", row, column, column + 2,
            "a wire is expected between these two");
    }
    if (next != '-') return;
    Run run;
    run.place = {row, column + 1};
    run.from = link_[row][column];
    run.begin = static_cast<std::uint32_t>(out_.elements.size());
    run.to = follow(row, column + 1);
    run.end = static_cast<std::uint32_t>(out_.elements.size());
    if (run.to != kNoLink) ++out_.links[run.to].incoming;
    out_.links[run.from].outgoing.push_back(
        static_cast<std::uint32_t>(out_.runs.size()));
    out_.runs.push_back(run);
  }

  // To the joint where the wire ends, or to its open end.
  std::uint32_t follow(std::uint32_t row, std::uint32_t column) {
    while (true) {
      switch (drawing_.at(row, column)) {
        case '-':
          seen_[row][column++] = true;
          break;
        case '|':
          if (drawing_.at(row, column + 1) != '-') {
            end_at_rail(row, column);
            return kNoLink;
          }
          ++column;  // two wires that cross
          break;
        case '+':
          return link_[row][column];
        case '[':
        case '(':
          column = element(row, column);
          break;
        case '>':
          jump(row, column);
          return kNoLink;
        default: {
          const auto box = boxes_.find({row, column});
          if (box == boxes_.end()) return kNoLink;
          column = timer(box->first, box->second);
          boxes_.erase(box);
        }
      }
    }
  }

  std::uint32_t timer(Place place, const Box& box) {
    Element element;
    element.symbol = Symbol::Timer;
    element.place = place;
    element.where = box.where;
    element.operand = box.instance;
    element.operand_where = box.instance_where;
    element.second = box.kind;
    element.preset_ms = box.preset_ms;
    if (!instances_.insert(box.instance).second) {
      errors_.error("RP088", box.instance_where,
                    quoted_excerpt(box.instance) +
                        " is another box already: in a scan each is executed "
                        "once");
    }
    out_.elements.push_back(element);
    return box.end;
  }

  void end_at_rail(std::uint32_t row, std::uint32_t column) {
    const std::uint32_t id = link_[row][column];
    right_rail_.resize(out_.links.size());
    right_rail_[id] = true;
    if (out_.links[id].plus || column + 1 < drawing_.columns(row)) {
      error("RP051", row, column, column + 1,
            "a wire ends here: a joint is `+`");
    }
  }

  std::uint32_t element(std::uint32_t row, std::uint32_t column) {
    const char close = drawing_.at(row, column) == '[' ? ']' : ')';
    std::uint32_t end = column + 1;
    while (end < drawing_.columns(row) && drawing_.at(row, end) != close &&
           end < column + 8) {
      ++end;
    }
    end = std::min(end + 1, drawing_.columns(row));
    std::fill(seen_[row].begin() + column, seen_[row].begin() + end, true);
    const std::string_view text = drawing_.text(row, column, end);
    const auto* const found =
        std::find_if(kSymbols.begin(), kSymbols.end(),
                     [&](const SymbolRow& it) { return it.text == text; });
    if (found == kSymbols.end()) {
      error("RP087", row, column, end,
            "the element " + quoted_excerpt(text) +
                " is not supported: they are `[ ]`, `[/]`, `[>]`, `[<]`, "
                "`( )`, `(/)`, `(S)`, `(R)`");
      Element unknown;
      if (row > 0) {
        operand(row - 1, column, end, unknown.operand, unknown.operand_where);
      }
      return end;
    }
    Element element;
    element.symbol = found->symbol;
    element.place = {row, column};
    element.where = drawing_.range(row, column, end);
    if (row == 0 || !operand(row - 1, column, end, element.operand,
                             element.operand_where)) {
      error("RP051", row, column, end, "no name stands above this element");
    }
    const bool compares =
        element.symbol == Symbol::Greater || element.symbol == Symbol::Less;
    if (compares &&
        !operand(row + 1, column, end, element.second, element.second_where)) {
      error("RP051", row, column, end,
            "no operand stands below this comparison");
    }
    out_.elements.push_back(element);
    return end;
  }

  // The one text of the row that is above or below the columns.
  bool operand(std::uint32_t row, std::uint32_t begin, std::uint32_t end,
               std::string_view& text, SourceRange& where) {
    if (row >= drawing_.rows()) return false;
    std::vector<Text>& texts = drawing_.texts(row);
    const auto at = texts.begin() + static_cast<std::ptrdiff_t>(
                                        drawing_.first_text(row, begin));
    if (at == texts.end() || at->begin >= end || at->text.empty()) return false;
    const auto next = at + 1;
    if (next != texts.end() && next->begin < end) {
      error("RP051", row, at->begin, next->end,
            "two names stand at one element");
      next->used = true;
    }
    at->used = true;
    text = at->text;
    where = drawing_.range(row, at->begin, at->end);
    return true;
  }

  // `>>label`
  void jump(std::uint32_t row, std::uint32_t column) {
    std::uint32_t end = column + 2;
    while (is_text(drawing_.at(row, end))) ++end;
    if (drawing_.at(row, column + 1) != '>' || end == column + 2) {
      return error("RP051", row, column, column + 1,
                   "`>>` and a label are expected");
    }
    std::fill(seen_[row].begin() + column, seen_[row].begin() + end, true);
    Element element;
    element.symbol = Symbol::Jump;
    element.place = {row, column};
    element.where = drawing_.range(row, column, end);
    element.operand = drawing_.text(row, column + 2, end);
    element.operand_where = drawing_.range(row, column + 2, end);
    out_.elements.push_back(element);
  }

  Drawing& drawing_;
  ErrorLimit& errors_;
  Wires out_;
  std::map<Place, Box> boxes_;
  std::vector<std::vector<bool>> seen_;           // by row and column
  std::vector<std::vector<std::uint32_t>> link_;  // by row and column
  std::set<std::string_view> instances_;
  std::vector<bool> right_rail_;  // by link
};

}  // namespace

Wires trace_wires(Drawing& drawing, ErrorLimit& errors) {
  return Tracer(drawing, errors).run();
}

}  // namespace rung::ascii
