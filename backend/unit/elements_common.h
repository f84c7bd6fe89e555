#pragma once

#include <cstddef>
#include <cstdint>
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
  void declare(UnitBuilder& builder) override;

 protected:
  struct Use {
    std::set<std::string_view> operations;
    std::set<std::int64_t> presets;
    std::size_t calls = 0;
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

  /// With the state `last`: SR (or RS), and R_TRIG, F_TRIG, RISE, FALL.
  static Terms latch_as_bit(UnitBuilder& builder, Use& use, bool set_dominates,
                            const std::vector<Terms>& arguments);
  static Terms edge_as_bit(UnitBuilder& builder, const ElementCall& call,
                           Use& use, const Terms& argument);

 private:
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
