#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "backend/unit/builder.h"

namespace rung::backend {

/// What all sets of elements need: how the source uses each of its elements,
/// and what stands for it.
class MappedElements : public Elements {
 public:
  explicit MappedElements(std::int64_t largest_word = 32'767)
      : largest_word_(largest_word) {}

  void declare(UnitBuilder& builder) override;

 protected:
  struct Use {
    std::set<std::string_view> operations;
    std::set<std::int64_t> presets;
    std::size_t calls = 0;
    std::size_t steps = 0;   // calls that are no resets
    std::int64_t index = 0;  // where elements have numbers
    BlockId block;           // no value: states alone
    std::map<std::string_view, CellId> pins;
    std::map<std::string_view, CellId> states;
  };

  virtual void declare_instance(UnitBuilder& builder, const Instance& instance,
                                Use& use) = 0;

  Use& use_of(const ElementCall& call) { return uses_[call.instance.index()]; }
  Use& use_of(InstanceId id) { return uses_[id.index()]; }
  static CellId pin_cell(UnitBuilder& builder, Use& use, std::string_view name,
                         Type type = Type::Bit);
  static Terms pin(UnitBuilder& builder, Use& use, std::string_view name,
                   Type type = Type::Bit) {
    return read_term(pin_cell(builder, use, name, type), type);
  }
  static void add_state(UnitBuilder& builder, const Instance& instance,
                        Use& use, std::string_view name,
                        Type type = Type::Bit) {
    use.states[name] = builder.add_state(instance, name, type);
  }
  static Terms state(const Use& use, std::string_view name,
                     Type type = Type::Bit) {
    return read_term(use.states.at(name), type);
  }

  /// Executes an on-delay; gives its output.
  using RunOnDelay =
      std::function<Terms(Terms input, std::int64_t milliseconds)>;
  /// With the state `started`: T and TR of the yun dialect.
  static Terms timer_yun(UnitBuilder& builder, const ElementCall& call,
                         Use& use, const Terms& argument,
                         const RunOnDelay& run);
  /// With the state `out`: an off-delay is an on-delay of its input's absence.
  static Terms off_delay(UnitBuilder& builder, const ElementCall& call,
                         Use& use, const Terms& argument,
                         const RunOnDelay& run);
  /// With the states `value` and `last`: C and CR of the yun dialect, C of sim.
  Terms counter_yun(UnitBuilder& builder, const ElementCall& call, Use& use,
                    const Terms& argument) const;
  Terms counter_sim(UnitBuilder& builder, const ElementCall& call, Use& use,
                    const std::vector<Terms>& arguments) const;
  static void relate_counter(UnitBuilder& builder, const Instance& instance,
                             const Use& use);
  /// A count or `factor` times it, as a word.
  std::int64_t preset_word(UnitBuilder& builder, const ElementCall& call,
                           std::int64_t factor) const;
  static Terms value_and(NodeOp op, const Use& use, std::int64_t number,
                         Type type = Type::Bit) {
    return joined(op, type, state(use, "value", Type::Word),
                  constant_term(Type::Word, number));
  }

  /// With the state `last`: SR (or RS), and R_TRIG, F_TRIG, RISE, FALL.
  static Terms latch_as_bit(UnitBuilder& builder, Use& use, bool set_dominates,
                            const std::vector<Terms>& arguments);
  static Terms edge_as_bit(UnitBuilder& builder, const ElementCall& call,
                           Use& use, const Terms& argument);

 private:
  std::int64_t largest_word_;
  std::vector<Use> uses_;  // by InstanceId
};

/// How the states of an on-delay or an off-delay timer of the sim dialect and
/// those of the same timer of IEC 61131-3 relate; one of them is the source's.
/// `kept_out` is a variable that holds the output; empty: there is none.
void relate_timer(UnitBuilder& builder, const std::string& instance,
                  bool off_delay, bool sim_is_source, std::int64_t preset,
                  const std::string& kept_out = {});

Terms both(Terms left, const Terms& right);
Terms either(Terms left, const Terms& right);
bool is_false(const Terms& terms);

}  // namespace rung::backend
