#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "analysis/property.h"
#include "analysis/trace.h"
#include "base/source.h"
#include "executors.h"

namespace rung {

/// A program of any language with its properties.
struct Loaded {
  std::string name;
  SourceSet sources;  // the program's views point into it
  Program program;
  PropertySet properties;
};

/// Programs whose addresses stay.
class Programs {
 public:
  /// False, and nothing is added, when the text is refused.
  bool add(const std::string& name, const std::string& text);
  /// The files of the project's corpus, and of that of others beside the
  /// repository where it is there; those that are refused are left out.
  void add_corpus();
  void add_project_corpus();
  void add_corpus_of_others();
  void add_random(std::uint64_t seed);

  const std::deque<Loaded>& items() const { return items_; }

 private:
  void add_folder(const std::string& folder);
  std::deque<Loaded> items_;
};

/// The program in a random run of about `scans` scans; false when it cannot be
/// lowered to the postfix format.
bool make_case(const Loaded& loaded, std::uint64_t seed, std::uint64_t scans,
               Case& result);

/// Writes a lowered program into the place that pins.ino has for it; false when
/// there is none, or it is too small.
bool put_program(std::span<std::uint8_t> flash, const std::string& program);

/// A property that is violated, or a state that can be reached, and the run
/// that shows it.
struct Violation {
  const Loaded* loaded = nullptr;
  Obligation obligation;
  Trace trace;
};

/// All violations of the programs that can be lowered.
std::vector<Violation> find_violations(const Programs& programs);
/// Those of one program, lowered or not.
std::vector<Violation> find_violations(const Loaded& loaded);
/// The same and the witnesses of what can be reached.
std::vector<Violation> find_runs(const Programs& programs);

}  // namespace rung
