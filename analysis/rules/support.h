#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/rules/rule_run.h"

namespace rung {

/// `name`
std::string quoted(std::string_view name);
std::string quoted(const Program& program, CellId cell);

/// An output that every function of IEC 61131-3 has: the reader assigns it,
/// too.
bool is_implicit(const Program& program, CellId cell);

/// "1 rung", "2 rungs"
std::string counted(std::size_t count, std::string_view thing);

/// The source line (from 1) of a place; 0 when it has none.
std::uint32_t line_of(const RuleRun& run, SourceRange where);

/// The source text of a place.
std::string_view text_of(const RuleRun& run, SourceRange where);

/// For `help`: what the engine showed.
std::string proof_text(const Oracle::Evidence& evidence);

/// For `help`: the scan in which the witness ends and its inputs, e.g. "seen
/// in scan 3, with `I0` = 1, `I1` = 0". A null end: only the scan.
std::string witness_text(const RuleRun& run, const Oracle::Evidence& evidence);

/// Operands of the chain of And (or Or) nodes at `root`, in scan order: the
/// contacts in series (or the branches) of a rung; `root` itself when it is no
/// such node.
std::vector<std::uint32_t> operands(const Program& program, std::uint32_t root,
                                    NodeOp op);

/// The last rung above `rung` that writes the cell; ProgramIndex::kNone when
/// there is none.
std::uint32_t writer_above(const RuleRun& run, CellId cell, std::uint32_t rung);

/// A contact: a read of a cell, perhaps inverted.
struct Contact {
  CellId cell;
  bool inverted = false;
};
/// The contact that the node is; no cell when it is something else.
Contact contact_at(const Program& program, std::uint32_t node);

/// Is the rung's expression a literal and nothing else?
bool is_literal(const RuleRun& run, RungId rung);

/// Is the rung a contact of a cell that rungs write, or a timer or counter, and
/// nothing else? What is constant about it is told there.
bool only_follows(const RuleRun& run, RungId rung);

inline bool is_and_or(NodeOp op) {
  return op == NodeOp::And || op == NodeOp::Or;
}

inline bool is_comparison(NodeOp op) {
  return op == NodeOp::Equal || op == NodeOp::NotEqual || op == NodeOp::Less ||
         op == NodeOp::LessEqual || op == NodeOp::Greater ||
         op == NodeOp::GreaterEqual;
}

/// Do two nodes compute the same by their structure? Calls are never the same:
/// each has an effect.
bool same_structure(const RuleRun& run, std::uint32_t left,
                    std::uint32_t right);

/// Two calls that run (not reset) one instance; no second when only one does.
struct Twins {
  CallId first;
  CallId second;
  bool differ = false;  // in preset or inputs
};
/// The first pair that differs, else the first pair.
Twins conflicting_calls(const RuleRun& run, InstanceId instance);

/// In words: "timer", "counter", "edge".
std::string_view family_name(const Instance& instance);

/// The letters of the operation that resets the kind ("TR"); empty when there
/// is none.
std::string_view reset_name(const ElementKind& kind);

/// Its instructions have no result, and are many for one device: what it gives
/// is looked at by an operation of its own, `.Q`.
bool has_status(const ElementKind& kind);

/// The node at `index` stands for no text of its own: the reader wrote its rung
/// to keep what an instruction does in a cell.
bool is_generated(const RuleRun& run, std::uint32_t index);

}  // namespace rung
