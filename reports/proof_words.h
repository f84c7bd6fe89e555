#pragma once

#include <string>
#include <string_view>

namespace rung {

/// A lemma of a certificate as a sentence, without a full stop:
///
///     !Q0 || !Q1                        `Q0` and `Q1` are never both true
///     !Q0 || (T(0).elapsed < 500)       while `Q0`: `T(0).elapsed < 500`
///     Q0 || I1                          `Q0` or `I1` is true
///
/// A lemma that is no disjunction of literals is quoted as it is.
std::string in_words(std::string_view lemma);

}  // namespace rung
