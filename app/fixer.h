#pragma once

#include <string>
#include <vector>

#include "app/load.h"
#include "app/options.h"
#include "smt/verify.h"

namespace rung {

/// What became of a fix that a rule offered.
struct FixRecord {
  std::string where;    // "motor.rung:3:10", in the text that it was made for
  std::string finding;  // "RP305 redundant-contact"
  std::string title;
  bool applied = false;
  std::string reason;  // how it was proved, or why it was not applied
};

struct FixedText {
  std::string text;  // as it was, when nothing is applied
  std::vector<FixRecord> records;
  std::string failure;  // not empty: nothing was applied, and why
};

/// Applies the fixes of the rules' findings after which the program is proved
/// to do the same: round for round, as one fix makes room for the next. In the
/// end the whole is proved once more, first text against last.
FixedText fix_text(const std::string& path, const std::string& text,
                   const Options& options,
                   const std::vector<AstAnnotation>& extra,
                   const VerifyOptions& verify_options);

}  // namespace rung
