#include "backend/unit/matiec.h"

#include <utility>
#include <vector>

namespace rung::backend {
namespace {

using Name = StateRelation::Name;

class Relating {
 public:
  Relating(UnitBuilder& builder, const std::string& instance,
           bool matiec_is_source)
      : builder_(builder),
        instance_(instance),
        matiec_is_source_(matiec_is_source) {}

  Name other(std::string short_name, const char* state) const {
    return {std::move(short_name), instance_ + "." + state, matiec_is_source_};
  }
  Name matiec(std::string short_name, const char* state) const {
    return {std::move(short_name), instance_ + "." + state, !matiec_is_source_};
  }
  void add(std::string formula, std::vector<Name> names) {
    builder_.unit().relations.push_back({std::move(formula), std::move(names)});
  }

 private:
  UnitBuilder& builder_;
  const std::string& instance_;
  bool matiec_is_source_;
};

}  // namespace

void relate_matiec_timer(UnitBuilder& builder, const std::string& instance,
                         std::string_view other, bool matiec_is_source,
                         std::int64_t preset) {
  Relating states(builder, instance, matiec_is_source);
  const Name prev = states.matiec("p", "prev");
  const Name timing = states.matiec("t", "timing");
  const Name over = states.matiec("v", "over");
  const Name clock = states.matiec("f", "elapsed");
  const Name elapsed = states.other("e", "elapsed");
  const std::string passed = "!v || e >= " + std::to_string(preset);
  states.add("!t || !v", {timing, over});
  states.add("!t || e == f", {timing, elapsed, clock});
  states.add("t || f == 0", {timing, clock});
  if (other == "timer-sim" || other == "ton") {
    const Name on = states.other("s", other == "ton" ? "on" : "started");
    states.add("s <-> p", {on, prev});
    states.add("p <-> t || v", {prev, timing, over});
    states.add("s || e == 0", {on, elapsed});
    states.add(passed, {over, elapsed});
  } else if (other == "tp") {
    const Name started = states.other("s", "started");
    states.add("s <-> t || v", {started, timing, over});
    states.add("s || !p", {started, prev});
    states.add("!v || p", {over, prev});
    states.add("s || e == 0", {started, elapsed});
    states.add(passed, {over, elapsed});
  } else {
    states.add("!t || !p", {timing, prev});
    states.add("!v || !p", {over, prev});
    if (other == "tof") {
      const Name fallen = states.other("x", "fallen");
      states.add("n <-> p", {states.other("n", "on"), prev});
      states.add("x <-> t || v", {fallen, timing, over});
      states.add("x || e == 0", {fallen, elapsed});
      states.add(passed, {over, elapsed});
      return;
    }
    const Name out = states.other("o", "out");
    const Name armed = states.other("a", "armed");
    states.add("a <-> p", {armed, prev});
    states.add("o <-> p || t", {out, prev, timing});
    states.add("o && !a || e == 0", {out, armed, elapsed});
  }
}

void relate_matiec_off_delays(UnitBuilder& builder, const std::string& instance,
                              const std::string& kept_out) {
  Relating states(builder, instance, false);
  const Name prev = states.matiec("p", "prev");
  const Name timing = states.matiec("t", "timing");
  const Name over = states.matiec("v", "over");
  const Name clock = states.matiec("f", "elapsed");
  const Name elapsed = states.other("e", "elapsed");
  const Name out = states.other("o", "out");
  const Name armed = states.other("a", "armed");
  states.add("o <-> k", {out, {"k", kept_out, true}});
  states.add("a <-> p", {armed, prev});
  states.add("!t || !v", {timing, over});
  states.add("!t || !p", {timing, prev});
  states.add("!v || !p", {over, prev});
  states.add("t || f == 0", {timing, clock});
  states.add("o && !a || e == 0", {out, armed, elapsed});
  states.add("!o || a || t && e == f", {out, armed, timing, elapsed, clock});
}

void relate_matiec_counter(UnitBuilder& builder, const std::string& instance,
                           bool down, bool matiec_is_source, std::int64_t pv) {
  Relating states(builder, instance, matiec_is_source);
  const Name counted = states.other("i", "value");
  const Name stopped = states.matiec("m", "value");
  const std::string limit = std::to_string(pv);
  states.add(down ? "m <= 0 ? i <= 0 : i == m"
                  : "m < " + limit + " ? i == m : i >= " + limit,
             {counted, stopped});
  const std::string low = down ? "-32768" : "0";
  states.add("m >= " + low + " && m <= 32767", {stopped});
  states.add("i >= " + low + " && i <= 32767", {counted});
  states.add("k <-> l",
             {states.other("k", "last"), states.matiec("l", "last")});
}

}  // namespace rung::backend
