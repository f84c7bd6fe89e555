#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A rung with more than 24 contacts.

## Why it matters
Nobody can see at a glance when it is true, and a ladder of it fits on no
screen.

## Example
Bad:

    Q0 = (I0 && I1 || I2 && I3 || I4 && I5 || I6 && I7) && (I1 && I2 || I3 && I4 || I5 && I6 || I7 && I0) && (I2 && I4 || I1 && I3 || I5 && I7 || I0 && I6) && !I8;

Good:

    M0 = I0 && I1 || I2 && I3 || I4 && I5 || I6 && I7;
    M1 = I1 && I2 || I3 && I4 || I5 && I6 || I7 && I0;
    Q0 = M0 && M1 && !I8;

## Limits
The number is fixed. Contacts in the arguments of a timer count as well.
)md";

constexpr std::size_t kManyContacts = 24;

void check(RuleRun& run) {
  for (const Rung& rung : run.program.rungs) {
    std::size_t contacts = 0;
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      if (run.program.nodes[i].op == NodeOp::Read) ++contacts;
    }
    if (contacts <= kManyContacts) continue;
    run.report(rung.where,
               "this rung has " + counted(contacts, "contact") +
                   ", more than " + std::to_string(kManyContacts),
               {.help = "name parts of it with memory cells"});
  }
}

}  // namespace

constinit const Rule complex_rung = {
    "RP701", "complex-rung", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
