#include "check/encode_property.h"

#include "analysis/property_line.h"
#include "check/encode_formula.h"

namespace rung::check {
namespace {

/// Properties as docs/properties.md says them, "Exactly".
class PropertyEncoder {
 public:
  PropertyEncoder(const Program& program, const ProgramValues& values,
                  Model& model)
      : model_(model),
        terms_(model.terms()),
        formulas_(program, values, model) {}

  void assume(const std::string& text) {
    model_.assumptions.push_back(formulas_.value(text));
  }

  void encode(const Property& property) {
    property_ = &property;
    switch (property.form) {
      case Property::Form::Always:
        return add(Goal::Kind::Always, formula(0));
      case Property::Form::Never:
        return add(Goal::Kind::Always, ~formula(0));
      case Property::Form::Reach:
        return add(Goal::Kind::Reach, formula(0));
      case Property::Form::Recoverable:
        return add(Goal::Kind::Recover, formula(0));
      case Property::Form::Interlock:
        return interlock();
      case Property::Form::Latch:
        return latch();
      case Property::Form::After:
        if (property.absent) {
          return property.scans >= 0 ? none_for_scans() : none_for_time();
        }
        return property.scans >= 0 ? within_scans() : within_time();
      case Property::Form::For:
        return held();
      case Property::Form::OnlyAfter:
        return only_after();
      case Property::Form::Settles:
      case Property::Form::Eventually:
        return add(Goal::Kind::Unknown, terms_.bit(false));
    }
  }

  std::vector<Goal> take() { return std::move(goals_); }

 private:
  Value formula(std::size_t number) {
    return formulas_.value(property_->formulas[number]);
  }

  void add(Goal::Kind kind, Value condition, std::string_view part = {}) {
    Goal goal;
    goal.kind = kind;
    goal.name = property_->name;
    if (!part.empty()) goal.name += "." + std::string(part);
    goal.form = property_->built_in ? "built-in" : to_string(property_->form);
    goal.text = property_->text;
    goal.condition = condition;
    goals_.push_back(std::move(goal));
  }

  /// A state of the monitor: NAME.what.
  std::uint32_t monitor(std::string_view what, bool word,
                        std::int64_t initial) {
    return model_.add_state(full_name(what), word, initial);
  }
  std::string full_name(std::string_view what) const {
    return property_->name + "." + std::string(what);
  }
  /// What certificates mean by it.
  void name(std::string_view what, Value seen) {
    model_.name(full_name(what), seen);
  }

  /// A time since something, which a certificate sees up to `cap`.
  std::uint32_t clock(const std::string& what, std::int64_t initial,
                      std::int64_t cap) {
    const std::uint32_t state = monitor(what, true, initial);
    model_.claim(state, 0, {});
    name(what, smaller(model_.states[state].now, terms_.number(cap)));
    return state;
  }

  Value now(std::uint32_t state) const { return model_.states[state].now; }
  Value set_next(std::uint32_t state, Value next) {
    model_.states[state].next = next;
    return next;
  }

  /// Pairwise: no signal where one before it in the list is true. With a gap:
  /// none where another was true less than that ago, or is.
  void interlock() {
    std::vector<Value> signals;
    for (std::size_t i = 0; i < property_->formulas.size(); ++i) {
      signals.push_back(formula(i));
    }
    Value both = terms_.bit(false);
    Value any = terms_.bit(false);
    for (const Value signal : signals) {
      both = both | (any & signal);
      any = any | signal;
    }
    if (property_->milliseconds > 0) both = both | too_early(signals);
    add(Goal::Kind::Always, ~both);
  }

  Value too_early(const std::vector<Value>& signals) {
    const std::int64_t gap = property_->milliseconds;
    // Time since the signal was true; never is long enough ago.
    std::vector<Value> recent;
    for (std::size_t i = 0; i < signals.size(); ++i) {
      const std::uint32_t off = clock("off" + std::to_string(i + 1), gap, gap);
      const Value since =
          set_next(off, choose(signals[i], 0, now(off) + model_.dt));
      recent.push_back(since < gap);
    }
    Value wrong = terms_.bit(false);
    Value earlier = terms_.bit(false);
    for (std::size_t i = 0; i < signals.size(); ++i) {
      wrong = wrong | (signals[i] & earlier);
      earlier = earlier | recent[i];
    }
    Value later = terms_.bit(false);
    for (std::size_t i = signals.size(); i-- > 0;) {
      wrong = wrong | (signals[i] & later);
      later = later | recent[i];
    }
    return wrong;
  }

  void latch() {
    const Value q = formula(0);
    const Value was = formulas_.value(property_->formulas[0], 1);
    Value set = formula(1);
    Value reset = formula(2);
    const Value rises = q & ~was;
    add(Goal::Kind::Reach, rises, kLatchParts[0]);
    const Value sets = property_->dominant_set ? set : set & ~reset;
    const Value resets = property_->dominant_set ? reset & ~set : reset;
    add(Goal::Kind::Always, ~sets | q, kLatchParts[1]);
    add(Goal::Kind::Always, ~(was & ~reset) | q, kLatchParts[2]);
    add(Goal::Kind::Recover, ~q, kLatchParts[3]);
    add(Goal::Kind::Always, ~(resets & q), kLatchParts[4]);
    add(Goal::Kind::Always, ~rises | set, kLatchParts[5]);
  }

  /// `age`: scan ends since the oldest P without an answer, counted from 1.
  void within_scans() {
    const std::int64_t limit = property_->scans + 1;
    const Value p = formula(0);
    const Value q = formula(1);
    const std::uint32_t age = monitor("age", true, 0);
    model_.claim(age, 0, {});
    name("age", smaller(now(age), terms_.number(limit)));
    const Value starts = choose(p, 1, terms_.number(0));
    const Value older = choose(now(age) == 0, starts, now(age) + 1);
    add(Goal::Kind::Always, set_next(age, choose(q, 0, older)) < limit);
  }

  /// The oldest P without an answer decides; an answer past its time is none.
  void within_time() {
    const Value p = formula(0);
    const Value q = formula(1);
    const std::uint32_t pending = monitor("pending", false, 0);
    name("pending", now(pending));
    const std::uint32_t waited =
        clock("waited", 0, property_->milliseconds + 1);
    const Value time = set_next(
        waited,
        choose(now(pending), now(waited) + model_.dt, terms_.number(0)));
    set_next(pending, (now(pending) | p) & ~q);
    add(Goal::Kind::Always, ~(now(pending) & (time > property_->milliseconds)));
  }

  /// Since the last P: never is long enough ago.
  void none_for_time() {
    const std::int64_t time = property_->milliseconds;
    const Value p = formula(0);
    const Value q = formula(1);
    const std::uint32_t since = clock("since", time, time);
    const Value ago = set_next(since, choose(p, 0, now(since) + model_.dt));
    add(Goal::Kind::Always, ~(q & (ago < time)));
  }

  void none_for_scans() {
    const std::int64_t scans = property_->scans;
    const Value p = formula(0);
    const Value q = formula(1);
    const std::uint32_t since = clock("since", scans, scans);
    const Value ago = set_next(since, choose(p, 0, now(since) + 1));
    add(Goal::Kind::Always, ~(q & (ago < scans)));
  }

  /// The time from the first of the last scan ends with P to this one.
  void held() {
    const Value p = formula(0);
    const Value q = formula(1);
    if (property_->milliseconds <= 0) {
      return add(Goal::Kind::Always, ~p | q);
    }
    const Value was = formulas_.remembered(p, 0, full_name("was"));
    const std::uint32_t held = clock("held", 0, property_->milliseconds);
    const Value time = set_next(
        held, choose(p & was, now(held) + model_.dt, terms_.number(0)));
    const Value long_enough = p & (time >= property_->milliseconds);
    add(Goal::Kind::Always, ~long_enough | q);
  }

  void only_after() {
    const Value q = formula(0);
    const Value p = formula(1);
    const std::uint32_t seen = monitor("seen", false, 0);
    name("seen", now(seen));
    add(Goal::Kind::Always, ~q | set_next(seen, now(seen) | p));
  }

  Model& model_;
  Terms& terms_;
  FormulaEncoder formulas_;
  const Property* property_ = nullptr;
  std::vector<Goal> goals_;
};

}  // namespace

std::vector<Goal> encode_properties(const Program& program,
                                    const PropertySet& properties,
                                    const ProgramValues& values, Model& model) {
  PropertyEncoder encoder(program, values, model);
  for (const std::string& assumption : properties.assumptions) {
    encoder.assume(assumption);
  }
  for (const Property& property : properties.properties) {
    encoder.encode(property);
  }
  return encoder.take();
}

}  // namespace rung::check
