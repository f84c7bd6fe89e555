#include "analysis/result.h"

namespace rung {

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::Proved:
      return "proved";
    case Verdict::Violated:
      return "violated";
    case Verdict::Bounded:
      return "bounded";
    case Verdict::Vacuous:
      return "vacuous";
    case Verdict::Unknown:
      return "unknown";
  }
  return {};
}

}  // namespace rung
