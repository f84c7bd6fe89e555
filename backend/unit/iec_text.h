#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "backend/unit/comments.h"
#include "backend/unit/unit.h"

namespace rung::backend {

/// What the texts of IEC 61131-3 have in common.

/// `(* text *)`, whatever is in the text.
std::string iec_comment(std::string_view text);
/// `T#2s500ms`.
std::string iec_time(std::int64_t milliseconds);
/// The function of an operator of two operands; a negation is one from 0.
std::string_view iec_function(NodeOp op);
/// From the property lines to the last END_VAR.
std::string iec_head(const Unit& unit, const PropertyLines& properties);

/// `t.IN := x` right before a call of `t` becomes an operand of it.
void merge_pins(Unit& unit);
/// How many statements from `at` on may stand behind one condition: those
/// with its guard, up to one that changes what the guard reads.
std::size_t guarded_run(const Unit& unit, std::size_t at);

/// A statement's value is written, and the text may not be read back as the
/// property of a signal: the names that the validation needs.
Written finish_written(const Unit& unit, std::string text);

}  // namespace rung::backend
