#include "check/check.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "check/equal_memories.h"
#include "check/lemma.h"
#include "check/ways.h"

namespace rung::check {
namespace {

std::string_view to_string(Goal::Kind kind) {
  switch (kind) {
    case Goal::Kind::Always:
      return "invariant";
    case Goal::Kind::Reach:
      return "reach";
    case Goal::Kind::Recover:
      return "recover";
    case Goal::Kind::Unknown:
      break;
  }
  return "";
}

/// What is claimed of all reachable states; no value: nothing is.
std::optional<Value> claimed_invariant(const ClaimedProperty& property,
                                       const Goal& goal) {
  if (!property.has_certificate) return {};
  if (goal.kind == Goal::Kind::Reach && property.verdict == "violated") {
    return ~goal.condition;
  }
  if (goal.kind != Goal::Kind::Always) return {};
  if (property.verdict == "proved") return goal.condition;
  return {};
}

}  // namespace

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::Confirmed:
      return "confirmed";
    case Outcome::Rejected:
      return "rejected";
    case Outcome::NotChecked:
      return "not checked";
    case Outcome::ByRun:
      return "shown by a run";
    case Outcome::Open:
      return "not claimed";
  }
  return "";
}

CertificateCheck::CertificateCheck(Claims claims, const ClaimedResult& claimed,
                                   const std::vector<std::string>& wanted)
    : model_(std::move(claims.model)),
      goals_(std::move(claims.goals)),
      equal_(guess_equal_memories(*model_, claims.first_memory)) {
  for (const ClaimedProperty& property : claimed.properties) {
    const bool is_wanted =
        wanted.empty() ||
        std::find(wanted.begin(), wanted.end(), property.name) != wanted.end();
    if (!is_wanted) continue;
    checked_.push_back({property.name, Outcome::NotChecked, {}});
    add(property, checked_.size() - 1);
  }
  for (Group& group : groups_) write_scripts(group);
}

void CertificateCheck::write_scripts(Group& group) {
  group.scripts.push_back(write_script(*model_, group.proof));
  if (!group.helpers.empty() || group.scripts.front().has_other_ranges) {
    Proof helped = group.proof;
    helped.helpers = group.helpers;
    helped.narrow = true;
    group.scripts.push_back(write_script(*model_, helped));
  }
  const bool needs_names = !group.proof.lemmas.empty() || group.proof.k > 0;
  if (!equal_.empty() && needs_names) {
    Proof named = group.proof;
    named.lemmas.insert(named.lemmas.end(), equal_.begin(), equal_.end());
    group.scripts.push_back(write_script(*model_, named));
  }
  for (const Script& script : group.scripts) scripts_.push_back(script.text);
}

void CertificateCheck::add(const ClaimedProperty& property, std::size_t index) {
  Checked& checked = checked_[index];
  const bool holds = property.verdict == "proved";
  if (!holds && (!property.has_certificate || property.verdict == "vacuous")) {
    checked.outcome =
        property.verdict == "violated" ? Outcome::ByRun : Outcome::Open;
    return;
  }
  if (!model_->unknown_element.empty()) {
    checked.reason = model_->unknown_element + " is not known here";
    return;
  }
  const auto goal =
      std::find_if(goals_.begin(), goals_.end(),
                   [&](const Goal& one) { return one.name == property.name; });
  if (goal != goals_.end() && goal->kind == Goal::Kind::Unknown) {
    checked.reason = "`" + goal->form + "` is not known here";
    return;
  }
  if (goal == goals_.end() || goal->text != property.text ||
      goal->form != property.kind || to_string(goal->kind) != property.goal) {
    checked.outcome = Outcome::Rejected;
    checked.reason = goal == goals_.end()
                         ? "the source has no such property"
                         : "the source has another property of this name";
    return;
  }
  if (const auto condition = claimed_invariant(property, *goal)) {
    return add_to_group(property, index, *condition);
  }
  if (goal->kind == Goal::Kind::Reach && holds) {
    checked.outcome = Outcome::ByRun;
    return;
  }
  if (goal->kind == Goal::Kind::Recover && property.has_certificate) {
    if (holds) return add_ways(property, index, goal->condition);
    checked.reason = "the trap of a violated `recoverable`";
    return;
  }
  checked.reason = "there is no certificate";
}

void CertificateCheck::add_to_group(const ClaimedProperty& property,
                                    std::size_t index, Value condition) {
  // Without lemmas each stands alone; else they may need each other.
  const bool alone = property.k == 0 && property.lemmas.empty();
  const auto same =
      std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) {
        return !alone && group.is_shared && group.proof.k == property.k &&
               group.lemmas == property.lemmas &&
               group.conditions == property.conditions;
      });
  Group* group = same == groups_.end() ? nullptr : &*same;
  if (group == nullptr) {
    Group made;
    bool cut_off = false;
    const std::string wrong = read_certificate(property, made, cut_off);
    if (!wrong.empty()) {
      checked_[index].outcome =
          cut_off ? Outcome::NotChecked : Outcome::Rejected;
      checked_[index].reason = wrong;
      return;
    }
    groups_.push_back(std::move(made));
    group = &groups_.back();
  }
  group->proof.conditions.push_back({condition, property.name});
  group->properties.push_back(index);
}

/// Each in a proof of its own.
void CertificateCheck::add_ways(const ClaimedProperty& property,
                                std::size_t index, Value condition) {
  Ways ways = read_ways(property.ways, condition, *model_);
  Group group;
  bool cut_off = false;
  std::string wrong = read_certificate(property, group, cut_off);
  if (wrong.empty() && !ways.error.empty()) wrong = "way " + ways.error;
  if (!wrong.empty()) {
    checked_[index].outcome = cut_off ? Outcome::NotChecked : Outcome::Rejected;
    checked_[index].reason = wrong;
    return;
  }
  group.is_shared = false;
  group.proof.conditions.push_back({ways.arrives, property.name});
  group.proof.consequences = std::move(ways.leads_on);
  group.properties.push_back(index);
  groups_.push_back(std::move(group));
}

/// Conditions only help, so those that are not understood are left out: the
/// engine's own choices have no name here.
std::string CertificateCheck::read_certificate(const ClaimedProperty& property,
                                               Group& group, bool& cut_off) {
  group.proof.k = property.k;
  group.lemmas = property.lemmas;
  group.conditions = property.conditions;
  for (const std::string& text : property.lemmas) {
    const Lemma lemma = read_lemma(text, *model_);
    if (!lemma.error.empty()) {
      cut_off = lemma.cut_off;
      return "lemma `" + text.substr(0, 200) + "`: " + lemma.error;
    }
    group.proof.lemmas.push_back({lemma.value, text});
  }
  for (const std::string& text : property.conditions) {
    const Lemma condition = read_condition(text, *model_);
    if (!condition.error.empty()) {
      group.is_partial = true;
      continue;
    }
    group.helpers.push_back({condition.value, text});
  }
  return {};
}

std::size_t CertificateCheck::questions() const {
  std::size_t count = 0;
  for (const Group& group : groups_) {
    for (const Script& script : group.scripts) {
      count += script.questions.size() + 1;
    }
  }
  return count;
}

std::vector<Checked> CertificateCheck::conclude(
    const std::vector<std::string>& answers, const std::string& error) const {
  std::vector<Checked> checked = checked_;
  std::size_t at = 0;
  for (const Group& group : groups_) {
    for (const std::size_t index : group.properties) {
      checked[index].reason = error.empty() ? "no answer" : error;
    }
    for (const Script& script : group.scripts) {
      const std::size_t count = script.questions.size() + 1;
      if (answers.size() < at + count) return checked;
      const auto begin = answers.begin() + static_cast<std::ptrdiff_t>(at);
      judge(group, script, {begin, begin + static_cast<std::ptrdiff_t>(count)},
            checked);
      at += count;
    }
  }
  return checked;
}

/// What fails takes down what rests on it: a condition of one scan only
/// itself, all else everything that was to be shown together.
void CertificateCheck::judge(const Group& group, const Script& script,
                             const std::vector<std::string>& answers,
                             std::vector<Checked>& checked) {
  const std::size_t count = group.properties.size();
  std::vector<Checked> here(count, {{}, Outcome::Confirmed, {}});
  const auto lower = [&](std::size_t i, bool wrong, const std::string& why) {
    const Outcome outcome = wrong ? Outcome::Rejected : Outcome::NotChecked;
    if (here[i].outcome == Outcome::Rejected || here[i].outcome == outcome) {
      return;
    }
    here[i] = {{}, outcome, why};
  };
  if (answers.front() != "sat") {
    for (std::size_t i = 0; i < count; ++i) {
      lower(i, false, "no scan is possible under the assumptions");
    }
  }
  for (std::size_t i = 1; i < answers.size(); ++i) {
    if (answers[i] == "unsat") continue;
    const Script::Question& question = script.questions[i - 1];
    // Without a condition that it may need, a proof is none, and not wrong.
    const bool fails = answers[i] == "sat";
    const bool wrong = fails && !group.is_partial;
    std::string why =
        question.what + (fails ? " fails" : ": the solver does not decide it");
    if (fails && !wrong) {
      why += ", without the conditions that name choices of the engine";
    }
    const bool alone = question.of_condition && group.proof.k == 0;
    for (std::size_t j = 0; j < count; ++j) {
      if (!alone || j == question.claim) lower(j, wrong, why);
    }
  }
  // One way to prove it is enough.
  for (std::size_t i = 0; i < count; ++i) {
    Checked& one = checked[group.properties[i]];
    if (one.outcome == Outcome::Confirmed) continue;
    one.outcome = here[i].outcome;
    one.reason = here[i].reason;
  }
}

}  // namespace rung::check
