#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/property.h"
#include "analysis/trace.h"

namespace rung {

/// A change of one rung with which a violated obligation is proved, and with it
/// all that was proved before.
struct Repair {
  RungId rung;
  std::string edit;   // "`&& !Q1` in series with"
  SourceRange where;  // the rung, or the contact that is changed
  std::shared_ptr<const Program> program;  // changed so
};

/// Why a run ends as it does.
struct Explanation {
  /// A value that had a part in it: a contact, or what a timer gave.
  struct Contact {
    std::string name;
    std::int64_t value = 0;
  };
  struct InputChange {
    std::uint64_t scan = 1;
    CellId cell;
    std::int64_t value = 0;
  };
  /// A coil that got, or kept, its value in a scan.
  struct Step {
    std::uint64_t scan = 1;
    CellId cell;
    std::int64_t value = 0;
    bool kept = false;  // it has not changed in the whole run
    RungId rung;
    std::vector<Contact> contacts;
  };

  std::string obligation;
  /// Without any one of these the run does not end so. Nothing where the run is
  /// too long for that to be tried.
  std::vector<InputChange> needed;
  std::vector<Step> chain;  // in the order of the run
  RungId blamed;            // the rung that decided last; may be none
  std::optional<Repair> repair;
};

/// Explains the run that violates obligation (property, part) by executing it,
/// and by executing it with changes of inputs undone.
/// Limits: a few dozen runs; of a run of many changes only the chain is looked
///         for.
Explanation explain_run(const Program& program, const PropertySet& properties,
                        std::uint32_t property, std::uint32_t part,
                        const Trace& trace);

/// Bit cells that the formulas of a property name, in their order.
std::vector<CellId> named_bits(const Program& program,
                               const Property& property);

/// The inputs of a trace, which are a run of the same program.
Stimulus stimulus_of(const Program& program, const Trace& trace);

}  // namespace rung
