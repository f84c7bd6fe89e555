#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/program.h"

namespace rung {

/// The nodes of `rung` as texts in the operators of scripts, by their distance
/// from `rung.begin`: "I0 && !(IW0 > 20)", "T(0) 5.0 s, I1". Texts longer than
/// kMaxText are cut, with an ellipsis: they are for boxes in a drawing.
inline constexpr std::size_t kMaxText = 48;
std::vector<std::string> expression_texts(const Program& program,
                                          const Rung& rung);

/// "T(0)", and with a preset "T(0) 5.0 s" or "C(0) 3".
std::string call_text(const Program& program, const ElementCall& call);

}  // namespace rung
