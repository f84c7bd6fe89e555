#include "reports/explanation.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/unicode.h"

namespace rung {
namespace {

std::string line_of(const SourceRange& where, Locator& locator) {
  if (!where.has_value()) return "a rung";
  return fmt::format("line {}", locator.of(where).begin.line);
}

std::string inputs_text(const FileReport& file, const Explanation& why) {
  std::string out;
  std::uint64_t scan = 0;
  for (const Explanation::InputChange& change : why.needed) {
    if (change.scan != scan) {
      out += fmt::format("{}in scan {} ", out.empty() ? "" : ", then ",
                         change.scan);
      scan = change.scan;
    } else {
      out += ", ";
    }
    out +=
        fmt::format("{} = {}", printable(file.program->cells[change.cell].name),
                    change.value);
  }
  return out;
}

std::string contacts_text(const Explanation::Step& step) {
  std::string out;
  for (const Explanation::Contact& contact : step.contacts) {
    out += fmt::format("{}{} = {}", out.empty() ? "" : ", ",
                       printable(contact.name), contact.value);
  }
  return out;
}

}  // namespace

std::string explanation_text(const FileReport& file, const Explanation& why,
                             const Painter& paint, Locator& locator) {
  std::string out;
  const std::string inputs = inputs_text(file, why);
  out += "  " + paint(Ink::Strong, "why");
  if (!inputs.empty()) {
    out += fmt::format(
        ": {}; {} it does not come to this", inputs,
        why.needed.size() == 1 ? "without that" : "without any one of these");
  }
  out += '\n';
  for (const Explanation::Step& step : why.chain) {
    const std::string contacts = contacts_text(step);
    out += fmt::format("    scan {}: {} {} {} by {}{}{}\n", step.scan,
                       printable(file.program->cells[step.cell].name),
                       step.kept ? "stays" : "=", step.value,
                       line_of(file.program->rungs[step.rung].where, locator),
                       contacts.empty() ? "" : ", for ", contacts);
  }
  if (why.repair) {
    out +=
        "  " + paint(Ink::Good, "repair") +
        fmt::format(
            ": {}: {}; proved, and with it all that was proved before\n",
            line_of(why.repair->where, locator), printable(why.repair->edit));
  }
  return out + "\n";
}

const Explanation* explanation_of(const FileReport& file,
                                  const Obligation& obligation) {
  const auto found =
      std::find_if(file.explanations.begin(), file.explanations.end(),
                   [&](const Explanation& why) {
                     return why.obligation == obligation.name;
                   });
  return found == file.explanations.end() ? nullptr : &*found;
}

}  // namespace rung
