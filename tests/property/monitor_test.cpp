#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "sample.h"

namespace rung {
namespace {

// Terms and monitors against the definitions in docs/properties.md, read off
// whole runs: what must hold at a scan's end is looked up in the past of that
// very run, by loops over it.

struct Moment {  // moment 0 is before the first scan
  std::int64_t time = 0;
  bool i0 = false;
  bool i1 = false;
  bool i2 = false;
  bool q0 = false;
  std::int64_t word = 0;
};
using Run = std::vector<Moment>;
using Truth = std::function<bool(const Run&, std::size_t)>;

struct Atom {
  const char* text;
  Truth truth;
};

const Moment& back(const Run& run, std::size_t now, std::size_t scans) {
  return run[now >= scans ? now - scans : 0];
}

bool once(const Run& run, std::size_t now, const Truth& truth) {
  for (std::size_t i = 1; i <= now; ++i) {
    if (truth(run, i)) return true;
  }
  return false;
}

bool i0_rose(const Run& run, std::size_t now) {
  return now > 0 && run[now].i0 && !run[now - 1].i0;
}

const std::vector<Atom> kAtoms = {
    {"I0", [](const Run& r, std::size_t k) { return r[k].i0; }},
    {"!I1", [](const Run& r, std::size_t k) { return !r[k].i1; }},
    {"Q0", [](const Run& r, std::size_t k) { return r[k].q0; }},
    {"Q2 && I1",
     [](const Run& r, std::size_t k) { return r[k].i2 && r[k].i1; }},
    {"prev(I1)", [](const Run& r, std::size_t k) { return back(r, k, 1).i1; }},
    {"prev(prev(Q0))",
     [](const Run& r, std::size_t k) { return back(r, k, 2).q0; }},
    {"prev(prev(prev(I0)))",
     [](const Run& r, std::size_t k) { return back(r, k, 3).i0; }},
    {"rose(I0)", i0_rose},
    {"fell(Q0)",
     [](const Run& r, std::size_t k) { return !r[k].q0 && back(r, k, 1).q0; }},
    {"prev(rose(I0))",
     [](const Run& r, std::size_t k) { return k > 0 && i0_rose(r, k - 1); }},
    {"rose(prev(Q0))",
     [](const Run& r, std::size_t k) {
       return back(r, k, 1).q0 && !back(r, k, 2).q0;
     }},
    {"begin(Q0) && I1",
     [](const Run& r, std::size_t k) { return back(r, k, 1).q0 && r[k].i1; }},
    {"begin(I0 ^ Q0)",
     [](const Run& r, std::size_t k) { return r[k].i0 != back(r, k, 1).q0; }},
    {"prev(begin(I0))",
     [](const Run& r, std::size_t k) { return back(r, k, 1).i0; }},
    {"prev(begin(Q0))",
     [](const Run& r, std::size_t k) { return back(r, k, 2).q0; }},
    {"once(I2 && !I0)",
     [](const Run& r, std::size_t k) {
       return once(r, k, [](const Run& run, std::size_t i) {
         return run[i].i2 && !run[i].i0;
       });
     }},
    {"prev(prev(once(Q0)))",
     [](const Run& r, std::size_t k) {
       return k >= 2 && once(r, k - 2, [](const Run& run, std::size_t i) {
                return run[i].q0;
              });
     }},
    {"once(prev(Q0))",
     [](const Run& r, std::size_t k) {
       return once(r, k, [](const Run& run, std::size_t i) {
         return back(run, i, 1).q0;
       });
     }},
    {"IW0 + prev(IW0) * 2 > 4",
     [](const Run& r, std::size_t k) {
       return r[k].word + back(r, k, 1).word * 2 > 4;
     }},
    {"prev(IW0 > 2 ? I0 : !I1)",
     [](const Run& r, std::size_t k) {
       const Moment& then = back(r, k, 1);
       return then.word > 2 ? then.i0 : !then.i1;
     }},
    {"T(0).q",
     [](const Run& r, std::size_t k) {
       std::size_t first = k;
       while (first > 1 && r[first].i0 && r[first - 1].i0) --first;
       return r[k].i0 && r[k].time - r[first].time >= 20;
     }},
    {"T(0).fired",
     [](const Run& r, std::size_t k) {
       std::size_t first = k;
       while (first > 1 && r[first].i0 && r[first - 1].i0) --first;
       return k > 0 && r[k].i0 && r[k].time - r[first].time >= 20;
     }},
    {"prev(T(0).q)",
     [](const Run& r, std::size_t k) {
       if (k == 0) return false;
       std::size_t first = k - 1;
       while (first > 1 && r[first].i0 && r[first - 1].i0) --first;
       return r[k - 1].i0 && r[k - 1].time - r[first].time >= 20;
     }},
};

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  std::int64_t up_to(std::int64_t last) {
    return static_cast<std::int64_t>(engine_() %
                                     static_cast<std::uint64_t>(last + 1));
  }
  const Atom& atom() {
    return kAtoms[static_cast<std::size_t>(
        up_to(static_cast<std::int64_t>(kAtoms.size()) - 1))];
  }

 private:
  std::mt19937 engine_;
};

/// A property line with what it says about a run.
struct Claim {
  std::string line;
  Truth holds;
  Truth trigger;  // none: not compared
};

Claim always(Dice& dice) {
  const Atom a = dice.atom();
  const Atom b = dice.atom();
  return {std::string("always ") + a.text + " -> " + b.text,
          [=](const Run& r, std::size_t k) {
            return !a.truth(r, k) || b.truth(r, k);
          },
          a.truth};
}

Claim never(Dice& dice) {
  const Atom a = dice.atom();
  return {std::string("never ") + a.text,
          [=](const Run& r, std::size_t k) { return !a.truth(r, k); },
          {}};
}

Claim interlock(Dice& dice) {
  const std::vector<Atom> all = {dice.atom(), dice.atom(), dice.atom()};
  const std::int64_t gap = dice.up_to(12);
  std::string line = "interlock ";
  for (const Atom& atom : all) line += std::string(atom.text) + ", ";
  line.resize(line.size() - 2);
  if (gap > 0) line += " gap " + std::to_string(gap) + " ms";
  const Truth holds = [=](const Run& r, std::size_t k) {
    for (std::size_t one = 0; one < all.size(); ++one) {
      for (std::size_t other = 0; other < all.size(); ++other) {
        if (one == other || !all[one].truth(r, k)) continue;
        for (std::size_t i = 1; i <= k; ++i) {
          const bool close = i == k || r[k].time - r[i].time < gap;
          if (close && all[other].truth(r, i)) return false;
        }
      }
    }
    return true;
  };
  return {line, holds, {}};
}

Claim after_scans(Dice& dice) {
  const Atom p = dice.atom();
  const Atom q = dice.atom();
  const std::int64_t scans = dice.up_to(4);
  const Truth holds = [=](const Run& r, std::size_t k) {
    const auto limit = static_cast<std::size_t>(scans);
    for (std::size_t j = 1; j + limit <= k; ++j) {
      if (!p.truth(r, j)) continue;
      bool answered = false;
      for (std::size_t i = j; i <= j + limit; ++i) {
        answered = answered || q.truth(r, i);
      }
      if (!answered) return false;
    }
    return true;
  };
  return {std::string("after ") + p.text + ", " + q.text + " within " +
              std::to_string(scans) + " scans",
          holds, p.truth};
}

Claim after_time(Dice& dice) {
  const Atom p = dice.atom();
  const Atom q = dice.atom();
  const std::int64_t limit = dice.up_to(25);
  const Truth holds = [=](const Run& r, std::size_t k) {
    for (std::size_t j = 1; j <= k; ++j) {
      if (!p.truth(r, j) || r[k].time - r[j].time <= limit) continue;
      bool answered = false;
      for (std::size_t i = j; i <= k; ++i) {
        const bool in_time = r[i].time - r[j].time <= limit;
        answered = answered || (in_time && q.truth(r, i));
      }
      if (!answered) return false;
    }
    return true;
  };
  return {std::string("after ") + p.text + ", " + q.text + " within " +
              std::to_string(limit) + " ms",
          holds, p.truth};
}

Claim held(Dice& dice) {
  const Atom p = dice.atom();
  const Atom q = dice.atom();
  const std::int64_t time = dice.up_to(25);
  const Truth long_enough = [=](const Run& r, std::size_t k) {
    for (std::size_t j = k; j >= 1 && p.truth(r, j); --j) {
      if (r[k].time - r[j].time >= time) return true;
    }
    return false;
  };
  return {std::string(p.text) + " for " + std::to_string(time) +
              " ms implies " + q.text,
          [=](const Run& r, std::size_t k) {
            return !long_enough(r, k) || q.truth(r, k);
          },
          long_enough};
}

Claim only_after(Dice& dice) {
  const Atom q = dice.atom();
  const Atom p = dice.atom();
  return {std::string(q.text) + " only after " + p.text,
          [=](const Run& r, std::size_t k) {
            return !q.truth(r, k) || once(r, k, p.truth);
          },
          q.truth};
}

/// A random run, scan by scan, in step with the terms.
class Walk {
 public:
  Walk(const TransitionSystem& ts, Dice& dice, bool q0)
      : dice_(dice), interpreter_(ts), run_{{.q0 = q0}} {}

  void step() {
    Moment now = run_.back();
    // Inputs are held for a while, or no clock would get anywhere.
    if (dice_.up_to(2) == 0) now.i0 = dice_.up_to(1) != 0;
    if (dice_.up_to(2) == 0) now.i1 = dice_.up_to(3) == 0;
    if (dice_.up_to(2) == 0) now.i2 = dice_.up_to(1) != 0;
    now.word = dice_.up_to(3);
    const std::int64_t dt = 1 + dice_.up_to(8);
    now.time += dt;
    now.q0 = (now.i0 || now.q0) && !now.i1;
    interpreter_.scan(dt, {now.i0, now.i1, now.i2, now.word});
    run_.push_back(now);
  }
  const Run& run() const { return run_; }
  std::size_t now() const { return run_.size() - 1; }
  bool is(ExprId term) const { return interpreter_.value(term) != 0; }

 private:
  Dice& dice_;
  Interpreter interpreter_;
  Run run_;
};

/// The run as the simulator is told about it.
Stimulus stimulus_of(const ReadLines& read, const Run& run) {
  Stimulus stimulus;
  for (const char* const name : {"I0", "I1", "I2", "IW0"}) {
    stimulus.inputs.push_back(read.sample.find(name));
  }
  for (std::size_t i = 1; i < run.size(); ++i) {
    const Moment& now = run[i];
    stimulus.steps.push_back({.dt_ms = now.time - run[i - 1].time,
                              .repeat = 1,
                              .inputs = {now.i0, now.i1, now.i2, now.word}});
  }
  return stimulus;
}

void compare(const Claim& claim, Dice& dice, bool q0_first) {
  ReadLines read(claim.line, q0_first ? "Q0" : "");
  ASSERT_FALSE(read.found.has_errors()) << claim.line << read.error();
  read.sample.program.calls[CallId(0)].parameter = 20;
  read.sample.program.instances[InstanceId(0)].largest_parameter = 20;
  TransitionSystem ts = build_transition_system(read.sample.program);
  const Obligation first =
      make_obligations(read.sample.program, read.set, ts).front();
  ASSERT_EQ(first.trigger.has_value(), static_cast<bool>(claim.trigger))
      << claim.line;
  Walk walk(ts, dice, q0_first);
  const auto replayed = [&] {
    return replay(read.sample.program, read.set, 0, 0,
                  stimulus_of(read, walk.run()))
        .decided_at;
  };
  const bool reach = first.goal == Goal::Reach;
  bool reached = false;
  for (int scan = 0; scan < 40; ++scan) {
    walk.step();
    const bool holds = claim.holds(walk.run(), walk.now());
    ASSERT_EQ(walk.is(first.condition), holds)
        << claim.line << " at scan " << walk.now();
    if (claim.trigger) {
      ASSERT_EQ(walk.is(first.trigger), claim.trigger(walk.run(), walk.now()))
          << claim.line << ": trigger at scan " << walk.now();
    }
    if (reach && holds && !reached) {
      reached = true;
      ASSERT_EQ(replayed(), walk.now()) << claim.line;
    }
    if (reach || holds) continue;
    ASSERT_EQ(replayed(), walk.now()) << claim.line;
    return;  // what comes after the first violation is not defined
  }
  if (!reached) {
    ASSERT_EQ(replayed(), 0U) << claim.line;
  }
}

using MakeClaim = Claim (*)(Dice&);
class Monitors : public testing::TestWithParam<MakeClaim> {};

TEST_P(Monitors, AreTheirDefinition) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    Dice dice(seed);
    const Claim claim = GetParam()(dice);
    compare(claim, dice, seed % 4 == 0);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Monitors,
                         testing::Values(always, never, interlock, after_scans,
                                         after_time, held, only_after));

TEST(Formulas, HaveTheirValueInEveryScan) {
  for (const Atom& atom : kAtoms) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      Dice dice(seed);
      const Claim claim = {std::string("reach ") + atom.text, atom.truth, {}};
      compare({claim.line, claim.holds, {}}, dice, seed % 2 == 0);
    }
  }
}

}  // namespace
}  // namespace rung
