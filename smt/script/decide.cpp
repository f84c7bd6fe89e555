#include "smt/script/decide.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "smt/script/encode.h"
#include "smt/script/refute.h"

namespace rung::script {
namespace {

/// Claims of one question: asked together they share what is propagated, and
/// thousands at once would be one hard question.
constexpr std::ptrdiff_t kTogether = 64;

/// Steps of proofs for a script, each of which may visit all of its literals.
constexpr std::int64_t kLiterals = 10'000'000;
constexpr std::int64_t kMostSteps = 1'000;

/// Claims that are to hold where all of `assumed` do.
struct Question {
  std::vector<int> assumed;
  std::vector<int> claims;
};

/// The literals of `names`; empty when one is not in the script.
std::vector<int> literals(const Encoded& encoded,
                          const std::vector<std::string>& names) {
  std::vector<int> result;
  for (const std::string& name : names) {
    const auto known = encoded.bools.find(name);
    if (known == encoded.bools.end()) return {};
    result.push_back(known->second);
  }
  return result;
}

/// None when a query is not one that the encoding is right for.
std::optional<std::vector<Question>> questions(const CertificateScript& script,
                                               const Encoded& encoded) {
  std::vector<Question> result;
  for (const ScriptQuery& query : script.queries) {
    const std::vector<std::string> names = script.assumptions(query);
    const bool bounded =
        std::any_of(names.begin(), names.end(), [](const std::string& name) {
          return name == "initial" || name == "hypothesis";
        });
    const std::vector<int> assumed = literals(encoded, names);
    const std::vector<int> claim = literals(encoded, {query.broken});
    if (!bounded || assumed.empty() || claim.empty()) return std::nullopt;
    if (claim.front() == Gates::kTrue) continue;
    const bool more = !result.empty() && result.back().assumed == assumed;
    if (!more) result.push_back({assumed, {}});
    result.back().claims.push_back(claim.front());
  }
  return result;
}

/// `effort` becomes what is left of it.
Decision decide(const Encoded& encoded, const Question& question,
                std::int64_t& effort) {
  Refuter refuter(encoded.gates.clauses(), encoded.gates.variables(),
                  question.assumed);
  for (auto from = question.claims.begin(); from != question.claims.end();) {
    const std::int64_t left = effort - refuter.steps();
    if (left <= 0) return Decision::Unknown;
    const auto many = question.claims.end() - from;
    const auto to = from + std::min<std::ptrdiff_t>(many, kTogether);
    switch (refuter.refute({from, to}, left)) {
      case Refuter::Answer::Refuted:
        break;
      case Refuter::Answer::Model:
        return Decision::Doubtful;
      case Refuter::Answer::Unknown:
      case Refuter::Answer::Unproved:
        return Decision::Unknown;
    }
    from = to;
  }
  effort -= refuter.steps();
  return Decision::Accepted;
}

}  // namespace

Decision decide(const CertificateScript& script) {
  const Script read = read_script(script.text);
  if (!read.error.empty()) return Decision::Unknown;
  const Encoded encoded = encode(read);
  if (!encoded.error.empty()) return Decision::Unknown;
  const auto asked = questions(script, encoded);
  if (!asked) return Decision::Unknown;
  const auto size = static_cast<std::int64_t>(encoded.gates.clauses().size());
  std::int64_t effort = std::min(kLiterals / size, kMostSteps);
  for (const Question& question : *asked) {
    const Decision decision = decide(encoded, question, effort);
    if (decision != Decision::Accepted) return decision;
  }
  return Decision::Accepted;
}

}  // namespace rung::script
