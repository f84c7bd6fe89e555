#pragma once

#include <string>
#include <string_view>

#include "check/model.h"

namespace rung::check {

/// A lemma's text as a bit over the states of the model.
struct Lemma {
  Value value;
  std::string error;  // it names nothing, or is no formula
  /// The report cut it off: there is nothing to be said of it.
  bool cut_off = false;
};

/// Reads `! && || == != < <= > >= + - * / ?: wrap16(x)`, numbers, true and
/// false, names of the model, and bits of numbers as `T(0).elapsed[3]`.
/// Iterative; linear in the text.
Lemma read_lemma(std::string_view text, Model& model);

/// The same of a condition of one scan, which may name inputs and dt.
Lemma read_condition(std::string_view text, Model& model);

}  // namespace rung::check
