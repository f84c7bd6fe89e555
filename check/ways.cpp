#include "check/ways.h"

#include <charconv>
#include <set>
#include <string_view>

#include "check/lemma.h"

namespace rung::check {
namespace {

/// A clock that grows ends here at the latest.
constexpr std::int64_t kLargestClock = std::int64_t{1} << 45;

/// The value at the scan's end of a term over the states before it.
Value at_end(Model& model, Value value) {
  Terms& terms = model.terms();
  std::vector<Value> made(value.id + 1);
  std::vector<bool> needed(value.id + 1, false);
  needed[value.id] = true;
  for (std::uint32_t i = value.id + 1; i-- > 0;) {
    if (!needed[i]) continue;
    for_operands(terms[i],
                 [&](std::uint32_t operand) { needed[operand] = true; });
  }
  for (std::uint32_t i = 0; i <= value.id; ++i) {
    if (!needed[i]) continue;
    const Term term = terms[i];
    if (term.op == Op::State) {
      made[i] = model.states[static_cast<std::size_t>(term.value)].next;
    } else if (term.op < Op::Not) {
      made[i] = {&terms, i};
    } else if (term.op == Op::Not) {
      made[i] = ~made[term.a];
    } else {
      made[i] = terms.make(term.op, term.word, made[term.a], made[term.b],
                           made[term.c], term.value);
    }
  }
  return made[value.id];
}

class Reader {
 public:
  explicit Reader(Model& model) : model_(model), terms_(model.terms()) {}

  Ways read(const std::vector<std::string>& texts, Value goal) {
    Ways ways;
    Value inside = terms_.bit(false);
    ways.arrives = goal;
    Value allowed = terms_.bit(true);
    for (const Value one : model_.assumptions) allowed = allowed & one;
    for (const std::string& text : texts) {
      const Region region = read_region(text);
      if (!error_.empty()) {
        ways.error = "`" + text.substr(0, 200) + "`: " + error_;
        return ways;
      }
      const Value there = at_end(model_, region.inside);
      const Value end = ways.arrives | (there & region.grows);
      const Value chosen = region.inside & ~inside & region.held;
      ways.leads_on.push_back({~chosen | (allowed & end), text});
      inside = inside | region.inside;
      ways.arrives = ways.arrives | there;
    }
    return ways;
  }

 private:
  struct Region {
    Value inside;
    Value held;   // the inputs are the chosen ones
    Value grows;  // its clock does; false where it has none
  };

  void fail(const std::string& what) {
    if (error_.empty()) error_ = what;
  }

  Region read_region(std::string_view text) {
    Region region = {terms_.bit(false), terms_.bit(true), terms_.bit(false)};
    const std::size_t colon = text.rfind(": ");
    const Lemma bounds = read_lemma(text.substr(0, colon), model_);
    if (!bounds.error.empty()) {
      fail(bounds.error);
      return region;
    }
    region.inside = bounds.value;
    if (colon == std::string_view::npos) return region;
    chosen_.clear();
    std::string_view rest = text.substr(colon + 2);
    while (error_.empty()) {
      const std::size_t comma = rest.find(", ");
      read_choice(rest.substr(0, comma), region);
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 2);
    }
    return region;
  }

  /// "I1 = 1", or "until T(0).elapsed is large enough".
  void read_choice(std::string_view text, Region& region) {
    constexpr std::string_view kUntil = "until ";
    constexpr std::string_view kEnough = " is large enough";
    if (text.starts_with(kUntil) && text.ends_with(kEnough)) {
      text.remove_prefix(kUntil.size());
      text.remove_suffix(kEnough.size());
      return read_clock(std::string(text), region);
    }
    const std::size_t equals = text.rfind(" = ");
    if (equals == std::string_view::npos) return fail("a choice is none");
    const std::string name(text.substr(0, equals));
    const std::string_view digits = text.substr(equals + 3);
    std::int64_t number = 0;
    const auto [end, wrong] =
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (wrong != std::errc{} || end != digits.data() + digits.size()) {
      return fail("a choice is no number");
    }
    choose_input(name, number, region);
  }

  void choose_input(const std::string& name, std::int64_t number,
                    Region& region) {
    const auto value = model_.scan_names.find(name);
    if (!value || terms_[value->id].op != Op::Input) {
      return fail("`" + name + "` cannot be chosen");
    }
    const InputVariable& input =
        model_.inputs[static_cast<std::size_t>(terms_[value->id].value)];
    if (number < input.low || number > input.high) {
      return fail("`" + name + "` is never " + std::to_string(number));
    }
    if (!chosen_.insert(name).second) {
      return fail("`" + name + "` is chosen twice");
    }
    const bool word = terms_[value->id].word;
    const Value same =
        word ? *value == number : (number != 0 ? *value : ~*value);
    region.held = region.held & same;
  }

  /// What it counts has a largest value, so that it cannot grow for ever.
  void read_clock(const std::string& name, Region& region) {
    const auto clock = model_.names.find(name);
    if (!clock || !terms_[clock->id].word ||
        terms_[clock->id].high > kLargestClock) {
      return fail("`" + name + "` can grow for ever");
    }
    region.grows = *clock < at_end(model_, *clock);
  }

  Model& model_;
  Terms& terms_;
  std::set<std::string> chosen_;
  std::string error_;
};

}  // namespace

Ways read_ways(const std::vector<std::string>& texts, Value goal,
               Model& model) {
  return Reader(model).read(texts, goal);
}

}  // namespace rung::check
