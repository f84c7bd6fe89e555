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

std::string_view to_string(Goal goal) {
  switch (goal) {
    case Goal::Invariant:
      return "invariant";
    case Goal::Reach:
      return "reach";
    case Goal::Recover:
      return "recover";
    case Goal::Respond:
      return "respond";
  }
  return {};
}

}  // namespace rung
