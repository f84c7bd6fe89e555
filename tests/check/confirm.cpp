#include "confirm.h"

#include "check/solver.h"

namespace rung {
namespace {

constexpr double kSeconds = 300;

std::string_view name_of(Goal goal) {
  return goal == Goal::Invariant ? "invariant"
         : goal == Goal::Reach   ? "reach"
         : goal == Goal::Recover ? "recover"
                                 : "respond";
}

/// Forms that the checker does not encode, and says so.
bool is_unknown_form(std::string_view kind) {
  return kind == "settles" || kind == "eventually";
}

}  // namespace

check::ClaimedResult claimed_by(const VerifyReport& report) {
  check::ClaimedResult claimed;
  for (const ObligationResult& result : report.results) {
    check::ClaimedProperty& property = claimed.properties.emplace_back();
    property.name = result.obligation.name;
    property.kind = result.obligation.kind;
    property.text = result.obligation.text;
    property.goal = name_of(result.obligation.goal);
    property.verdict = to_string(result.verdict);
    property.has_certificate = result.certificate.has_value();
    if (!result.certificate) continue;
    property.k = result.certificate->k;
    property.lemmas = result.certificate->lemmas;
    property.conditions = result.certificate->conditions;
    property.ways = result.certificate->ways;
  }
  return claimed;
}

void Confirmation::add(const Program& program, const PropertySet& properties,
                       const check::ClaimedResult& claimed) {
  checks_.push_back(std::make_unique<check::CertificateCheck>(
      check::claims_of(program, properties), claimed,
      std::vector<std::string>{}));
}

std::vector<std::vector<check::Checked>> Confirmation::ask() const {
  std::vector<std::string> scripts;
  for (const auto& one : checks_) {
    scripts.insert(scripts.end(), one->scripts().begin(), one->scripts().end());
  }
  check::Answers answers;
  if (!scripts.empty()) {
    answers = check::ask_solver("z3", scripts, kSeconds);
  }
  std::vector<std::vector<check::Checked>> results;
  std::size_t at = 0;
  for (const auto& one : checks_) {
    const std::size_t end =
        std::min(at + one->questions(), answers.list.size());
    results.push_back(
        one->conclude({answers.list.begin() + static_cast<std::ptrdiff_t>(at),
                       answers.list.begin() + static_cast<std::ptrdiff_t>(end)},
                      answers.error));
    at = end;
  }
  return results;
}

std::string unconfirmed(const Program& program, const PropertySet& properties,
                        const VerifyReport& report) {
  Confirmation confirmation;
  confirmation.add(program, properties, claimed_by(report));
  std::string text;
  const auto results = confirmation.ask();
  for (std::size_t i = 0; i < results.front().size(); ++i) {
    const check::Checked& one = results.front()[i];
    const bool rejected = one.outcome == check::Outcome::Rejected;
    const bool open = one.outcome == check::Outcome::NotChecked &&
                      report.results[i].verdict == Verdict::Proved &&
                      !is_unknown_form(report.results[i].obligation.kind);
    if (!rejected && !open) continue;
    text += std::string(check::to_string(one.outcome)) + ": " + one.name +
            ": " + one.reason + "\n";
  }
  return text;
}

}  // namespace rung
