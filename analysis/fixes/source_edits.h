#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "base/diagnostic.h"
#include "base/source.h"

namespace rung {

/// Where the nodes and rungs of a program stand in its text, and how to take
/// them out. No value: it cannot be done without touching a comment, or the
/// place is not written as the language writes such a thing.
class SourceEdits {
 public:
  SourceEdits(const SourceSet& sources, const Program& program);

  const Program& program() const { return program_; }
  std::string_view text(SourceRange where) const {
    return sources_.text(where);
  }

  /// The outermost node that is written there; kNone when there is none.
  std::uint32_t node_at(SourceRange where) const;
  /// The rung whose target or whole is written there; no value: none.
  RungId rung_at(SourceRange where) const;

  RungId rung_around(std::uint32_t node) const;
  const std::vector<std::uint32_t>& writers(CellId cell) const {
    return writers_[cell.index()];
  }

  /// An operand of And or Or, and the operator between it and the other one.
  std::optional<Edit> remove_operand(std::uint32_t node) const;
  /// With its `;`; with its line, where nothing else stands on it.
  std::optional<Edit> remove_rung(RungId rung) const;
  /// Behind its `;`, or where that would stand.
  std::uint32_t statement_end(RungId rung) const;
  /// The right side of a rung.
  std::optional<SourceRange> value_of(RungId rung) const;

  static constexpr std::uint32_t kNone = 0xffff'ffff;

 private:
  SourceRange with_parentheses(SourceRange where) const;
  bool is_operator(SourceRange where) const;

  const SourceSet& sources_;
  const Program& program_;
  std::string_view all_;               // of the program's file
  std::vector<std::uint32_t> parent_;  // by node; kNone: a rung's root
  std::vector<std::vector<std::uint32_t>> writers_;  // by cell: rungs
  std::vector<std::uint32_t> rungs_;  // sorted by their targets' places
};

}  // namespace rung
