#include "analysis/rollover.h"

#include <algorithm>
#include <cassert>

namespace rung {
namespace {

constexpr std::int64_t kLongestScanMs = std::int64_t{1} << 31;

const ElementKind* kind_of(std::string_view id) {
  const auto kinds = element_kinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(),
                   [&](const ElementKind& kind) { return kind.id == id; });
  return found == kinds.end() ? nullptr : &*found;
}

const ElementOperation* operation_of(const ElementKind& kind,
                                     std::string_view name) {
  const auto found = std::find_if(
      kind.operations.begin(), kind.operations.end(),
      [&](const ElementOperation& one) { return one.name == name; });
  assert(found != kind.operations.end());
  return &*found;
}

}  // namespace

bool use_rollover(Program& program) {
  bool any = false;
  for (const InstanceId id : ids_of(program.instances)) {
    Instance& instance = program.instances[id];
    if (instance.kind->rollover.empty()) continue;
    instance.kind = kind_of(instance.kind->rollover);
    assert(instance.kind != nullptr);
    any = true;
    // The scan that passes the roll-over begins behind it.
    instance.clock_cap = kRolloverMs + kLongestScanMs;
  }
  for (const CallId id : ids_of(program.calls)) {
    ElementCall& call = program.calls[id];
    const ElementKind& kind = *program.instances[call.instance].kind;
    call.operation = operation_of(kind, call.operation->name);
  }
  return any;
}

}  // namespace rung
