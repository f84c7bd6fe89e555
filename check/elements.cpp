#include "check/elements.h"

namespace rung::check {

const Kind* find_kind(std::string_view id) {
  for (const std::span<const Kind> kinds :
       {script_kinds(), iec_kinds(), matiec_kinds(), controller_kinds(),
        plclib_kinds(), siemens_kinds()}) {
    for (const Kind& kind : kinds) {
      if (kind.id == id) return &kind;
    }
  }
  return nullptr;
}

const Operation* find_operation(const Kind& kind, std::string_view name) {
  for (const Operation& operation : kind.operations) {
    if (operation.name == name) return &operation;
  }
  return nullptr;
}

}  // namespace rung::check
