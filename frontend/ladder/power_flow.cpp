#include "frontend/ladder/power_flow.h"

#include <algorithm>
#include <utility>

namespace rung::ladder {

namespace {

constexpr std::string_view kWire = "power";

void fill_effects(std::vector<Step>& steps) {
  std::vector<std::size_t> open;
  for (std::size_t at = 0; at < steps.size(); ++at) {
    if (steps[at].kind == Step::Kind::Open) open.push_back(at);
    if (steps[at].kind == Step::Kind::Instruction && !open.empty()) {
      Effect& effect = steps[open.back()].effect;
      effect = std::max(effect, steps[at].effect);
    }
    if (steps[at].kind != Step::Kind::Close) continue;
    const Effect effect = steps[open.back()].effect;
    steps[at].effect = effect;
    open.pop_back();
    if (open.empty()) continue;
    Effect& outer = steps[open.back()].effect;
    outer = std::max(outer, effect);
  }
}

void fill_needs(std::vector<Step>& steps) {
  std::vector<bool> closing;  // is the power behind the bracket needed
  bool needed = false;
  for (std::size_t at = steps.size(); at > 0; --at) {
    Step& step = steps[at - 1];
    switch (step.kind) {
      case Step::Kind::Instruction:
        step.needed = std::exchange(needed, true);
        break;
      case Step::Kind::Close:
        step.needed = needed;
        closing.push_back(needed);
        break;
      case Step::Kind::Next:
        step.needed = closing.back();
        needed = step.needed;
        break;
      case Step::Kind::Open:
        closing.pop_back();
        step.needed = true;
        needed = true;
        break;
    }
  }
}

}  // namespace

void prepare(std::vector<Step>& steps) {
  fill_effects(steps);
  fill_needs(steps);
}

Expression name_of(std::string_view name, SourceRange where) {
  Expression nodes;
  push_leaf(nodes, AstOp::Name, name, where);
  return nodes;
}

Expression truth(bool value, SourceRange where) {
  Expression nodes;
  push_leaf(nodes, AstOp::Bool, value ? "true" : "false", where);
  return nodes;
}

Expression power_of(std::string_view held, SourceRange where) {
  return held.empty() ? truth(true, where) : name_of(held, where);
}

void PowerFlow::begin(std::string_view power, SourceRange where) {
  open_.clear();
  start(power, where);
}

void PowerFlow::start(std::string_view power, SourceRange where) {
  nodes_.clear();
  held_ = power;
  present_ = !power.empty();
  if (present_) push_leaf(nodes_, AstOp::Name, power, where);
}

void PowerFlow::contact(const Expression& condition, SourceRange where) {
  push_all(nodes_, condition);
  if (present_) push_binary(nodes_, AstOp::And, where);
  present_ = true;
  held_ = {};
}

std::string_view PowerFlow::hold(SourceRange where) {
  if (!present_) return {};
  if (held_.empty()) {
    held_ = out_->keep(kWire, kBitCell, nodes_, where);
    calls_ = false;
    nodes_.clear();
    push_leaf(nodes_, AstOp::Name, held_, where);
  }
  return held_;
}

Expression PowerFlow::use(const Step& step) {
  if (!step.needed) return release(step.where);
  return power_of(hold(step.where), step.where);
}

Expression PowerFlow::take(SourceRange where) {
  constexpr std::size_t kShort = 12;
  if (nodes_.size() > kShort) hold(where);
  return release(where);
}

Expression PowerFlow::release(SourceRange where) {
  if (!present_) return truth(true, where);
  present_ = false;
  calls_ = false;
  held_ = {};
  return std::exchange(nodes_, {});
}

void PowerFlow::set(const Expression& power, bool calls) {
  nodes_ = power;
  present_ = true;
  calls_ = calls;
  held_ = {};
}

void PowerFlow::finish(SourceRange where) {
  if (calls_) hold(where);
}

void PowerFlow::open(const Step& step) {
  Branches branches;
  branches.effects = step.effect != Effect::None;
  if (branches.effects) {
    branches.begin = hold(step.where);
  } else {
    branches.outer = present_;
    present_ = false;
    held_ = {};
  }
  open_.push_back(std::move(branches));
}

// With effects: what the branch ends with, kept before the next one writes.
void PowerFlow::end_branch(const Step& step) {
  Branches& branches = open_.back();
  if (branches.effects) {
    if (!step.needed) return finish(step.where);
    const std::string_view end = hold(step.where);
    if (end.empty()) branches.always = true;
    if (branches.ends.empty() || branches.ends.back() != end) {
      branches.ends.push_back(end);
    }
    return;
  }
  if (!present_) push_leaf(nodes_, AstOp::Bool, "true", step.where);
  if (branches.any) push_binary(nodes_, AstOp::Or, step.where);
  branches.any = true;
  present_ = false;
}

void PowerFlow::next(const Step& step) {
  end_branch(step);
  const Branches& branches = open_.back();
  if (branches.effects) start(branches.begin, step.where);
}

void PowerFlow::close(const Step& step) {
  end_branch(step);
  const Branches branches = std::move(open_.back());
  open_.pop_back();
  if (branches.effects) {
    if (step.needed) close_effects(branches, step.where);
    return;
  }
  if (branches.outer) push_binary(nodes_, AstOp::And, step.where);
  present_ = true;
  held_ = {};
}

void PowerFlow::close_effects(const Branches& branches, SourceRange where) {
  start({}, where);
  if (branches.always) return;
  for (const std::string_view end : branches.ends) {
    push_leaf(nodes_, AstOp::Name, end, where);
    if (present_) push_binary(nodes_, AstOp::Or, where);
    present_ = true;
  }
  if (branches.ends.size() == 1) held_ = branches.ends.front();
}

}  // namespace rung::ladder
