#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A comment that is a rung: a name, `=`, an expression and `;`.

## Why it matters
Nobody knows whether it was switched off for a test or for good.

## Example
Bad:

    // Q0 = I0 && !I1;
    Q0 = I0;

Good:

    // start button only
    Q0 = I0;

## Limits
Only comments that end in `;` or hold an operator (`&&`, `||`, `!`), so that
prose with an equals sign in it is left alone.
)md";

bool is_name_char(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_';
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

bool looks_like_rung(std::string_view text) {
  text = without_blanks(text);
  std::size_t at = 0;
  while (at < text.size() && is_name_char(text[at])) ++at;
  if (at == 0) return false;
  const std::string_view rest = without_blanks(text.substr(at));
  if (rest.size() < 2 || rest[0] != '=' || rest[1] == '=') return false;
  return text.back() == ';' || rest.find("&&") != std::string_view::npos ||
         rest.find("||") != std::string_view::npos;
}

void check(RuleRun& run) {
  if (run.program.language != "script") return;
  for (const AstComment& comment : run.program.comments) {
    if (!looks_like_rung(comment.text)) continue;
    run.report(comment.where, "this comment is a rung that is switched off");
  }
}

}  // namespace

constinit const Rule commented_out_rung = {"RP310",        "commented-out-rung",
                                           Severity::Note, Decision::Syntax,
                                           kDoc,           check};

}  // namespace rung
