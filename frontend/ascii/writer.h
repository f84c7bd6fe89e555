#pragma once

#include <functional>
#include <queue>
#include <string_view>
#include <utility>
#include <vector>

#include "frontend/ascii/cells.h"
#include "frontend/ladder/jumps.h"

namespace rung::ascii {

/// Writes the elements of a drawing as assignments: row by row from top to
/// bottom, in a row from left to right; an element whose power comes from
/// further down waits for it.
///
/// The power on a wire is an expression until a coil may change what is in it:
/// then all of them are kept in bits. Each is kept once at most, and where
/// wires part, so the result is linear in the drawing.
class Writer {
 public:
  Writer(const Drawing& drawing, const Wires& wires, Cells& cells,
         StatementWriter& out, ErrorLimit& errors);

  void run();

 private:
  /// Power: always there, or an expression.
  struct Power {
    bool always = true;
    bool listed = false;  // in pending_
    Expression nodes;
    std::string_view held;  // the bit that `nodes` is, if it is kept in one
  };

  void announce(std::uint32_t run);
  void start(std::uint32_t link, SourceRange where);
  void execute(std::uint32_t run);
  void finish(std::uint32_t run);
  void join(std::uint32_t link, Power power, SourceRange where);

  void contact(const Element& element, Power& power);
  void coil(const Element& element, Power& power, bool needed);
  void timer(const Element& element, Power& power);
  void jump(const Element& element, Power& power);
  void reach_labels(std::uint32_t row);

  void note(std::uint32_t wire);
  void keep(Power& power, SourceRange where);
  void keep_all(const Power* but, SourceRange where);
  Expression expression_of(const Power& power, SourceRange where) const;
  SourceRange range_of(Place place) const;

  const Drawing& drawing_;
  const Wires& wires_;
  Cells& cells_;
  StatementWriter& out_;
  ErrorLimit& errors_;
  ladder::Jumps jumps_;
  using Event = std::pair<Place, std::uint32_t>;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  std::vector<std::uint32_t> done_;     // by run: its next element
  std::vector<std::uint32_t> awaited_;  // by link: runs that are to come
  std::vector<Power> powers_;           // by run, then by link
  std::vector<bool> joined_;            // by link: has power from a run
  std::vector<std::uint32_t> pending_;  // powers that are expressions
  std::size_t next_label_ = 0;
};

}  // namespace rung::ascii
