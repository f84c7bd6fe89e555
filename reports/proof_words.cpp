#include "reports/proof_words.h"

#include <vector>

namespace rung {
namespace {

/// The literals of a disjunction, cut where no parenthesis is open.
std::vector<std::string_view> literals(std::string_view lemma) {
  constexpr std::string_view kOr = " || ";
  std::vector<std::string_view> result;
  std::size_t begin = 0;
  int open = 0;
  for (std::size_t i = 0; i < lemma.size(); ++i) {
    if (lemma[i] == '(') ++open;
    if (lemma[i] == ')') --open;
    if (open != 0 || lemma.substr(i, kOr.size()) != kOr) continue;
    result.push_back(lemma.substr(begin, i - begin));
    begin = i + kOr.size();
  }
  result.push_back(lemma.substr(begin));
  return result;
}

/// Is the first parenthesis of the text closed by its last byte?
bool is_wrapped(std::string_view text) {
  if (text.size() < 2 || text.front() != '(' || text.back() != ')') {
    return false;
  }
  int open = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] == '(') ++open;
    if (text[i] == ')') --open;
    if (open == 0) return false;
  }
  return true;
}

std::string quoted(std::string_view text) {
  if (is_wrapped(text)) text = text.substr(1, text.size() - 2);
  return "`" + std::string(text) + "`";
}

std::string listed(const std::vector<std::string_view>& texts,
                   std::string_view last) {
  std::string out;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i > 0) out += i + 1 == texts.size() ? last : ", ";
    out += quoted(texts[i]);
  }
  return out;
}

}  // namespace

std::string in_words(std::string_view lemma) {
  std::vector<std::string_view> conditions;
  std::vector<std::string_view> conclusions;
  for (std::string_view literal : literals(lemma)) {
    const bool negated = literal.starts_with("!");
    if (negated) literal.remove_prefix(1);
    (negated ? conditions : conclusions).push_back(literal);
  }
  if (conclusions.empty()) {
    if (conditions.size() == 1) return quoted(conditions[0]) + " is never true";
    return listed(conditions, " and ") + (conditions.size() == 2
                                              ? " are never both true"
                                              : " are never all true");
  }
  if (conditions.empty()) {
    return conclusions.size() == 1 ? quoted(conclusions[0]) + " is always true"
                                   : listed(conclusions, " or ") + " is true";
  }
  return "while " + listed(conditions, " and ") + ": " +
         listed(conclusions, " or ");
}

}  // namespace rung
