#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/expr.h"

/// Terms of SMT-LIB 2 as text, made of the texts of their operands.
namespace rung::smtlib {

std::string number(std::int64_t value);

/// "(op a b c)"; empty operands are left out.
std::string call(std::string_view op, std::string_view a,
                 std::string_view b = {}, std::string_view c = {});

/// The n-ary `op`, one operand a line.
std::string chain(std::string_view op, std::string_view neutral,
                  const std::vector<std::string>& operands);

/// Truncates towards zero; SMT-LIB's `div` leaves a remainder of 0 or above.
std::string divided(const std::string& a, std::int64_t divisor);

std::string wrapped16(const std::string& a);

/// A term over the texts of its operands, empty where it has none.
/// Precondition: it is no variable; those have names.
std::string term(const ExprArena& exprs, const Expr& e, const std::string& a,
                 const std::string& b, const std::string& c);

/// Comments hold names from the input: nothing there may end the line.
std::string printable(std::string text);

}  // namespace rung::smtlib
