#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/explanation.h"
#include "analysis/program.h"
#include "analysis/property.h"
#include "analysis/result.h"
#include "analysis/rule.h"
#include "base/diagnostic.h"
#include "base/source.h"

namespace rung {

/// A violation that was to be executed on an emulated board (`--replay-on`).
struct BoardReplay {
  std::string obligation;
  std::string board;       // "uno"
  std::uint64_t scan = 0;  // the run's last one; all cells were as in the run
  std::string reason;      // not empty: why it was not executed
};

/// What one input file gave. Every writer reads the same record.
struct FileReport {
  FileId file;  // in Report::sources; has a value also when it was unreadable
  std::string path;
  std::string_view language;  // empty: not recognised
  std::string_view dialect;   // empty: the language has none
  std::string semantics;      // the preset it was read with; "+rollover"
  std::shared_ptr<const Program> program;  // null: input errors
  /// What the traces are runs of, where that is not `program`: of `equiv` both
  /// programs as one. Only the page draws it.
  std::shared_ptr<const Program> run_of;
  PropertySet properties;
  std::vector<std::string> notes;    // what is not part of the answer, and why
  std::vector<Diagnostic> findings;  // those that count
  std::vector<Diagnostic> waived;    // those with a waiver, sorted likewise
  std::optional<Severity> fail_on;   // its configuration's; else the report's
  bool compared = false;             // with a baseline
  std::vector<ObligationResult> results;
  std::vector<SelfCheckFailure> failures;
  std::vector<BoardReplay> replays;
  bool explained = false;                 // asked for: proofs in words, and
  std::vector<Explanation> explanations;  // of violations with a run
};

/// All that one run of `check`, `lint` or `prove` found.
struct Report {
  const SourceSet* sources = nullptr;
  std::string_view command;  // "check"
  std::string_view version;
  std::vector<std::pair<std::string, std::string>> solvers;
  std::span<const Rule* const> rules;  // documentation for SARIF; may be empty
  std::string working_directory;       // absolute; paths below it are relative
  Severity fail_on = Severity::Warning;
  bool self_check = true;
  bool linted = true;  // the lint rules were run
  bool proved = true;  // the properties were decided
  std::vector<FileReport> files;
};

struct Summary {
  std::size_t files = 0;
  std::size_t read = 0;  // files without input errors
  std::size_t rungs = 0;
  std::size_t obligations = 0;
  std::size_t proved = 0;
  std::size_t violated = 0;
  std::size_t bounded = 0;
  std::size_t vacuous = 0;
  std::size_t unknown = 0;
  std::size_t findings = 0;  // all, input errors too
  std::size_t notes = 0;
  std::size_t warnings = 0;
  std::size_t errors = 0;     // of lint rules
  std::size_t allowed = 0;    // waived in the source
  std::size_t baselined = 0;  // waived by a baseline
  std::size_t failing = 0;    // notes, warnings and errors from `fail_on` on
  std::size_t input_errors = 0;
  std::size_t failures = 0;  // self-checks
  std::size_t not_replayed = 0;
};
Summary summarise(const Report& report);
Summary summarise(const FileReport& file, Severity fail_on = Severity::Warning);

/// Which findings of the file make the exit status 1.
Severity fail_on_of(const Report& report, const FileReport& file);

/// Adds what the rules found to what the reader said: what counts, and what is
/// waived.
void take_findings(std::vector<Diagnostic> found, FileReport& file);

/// The program was not read to its end: codes RP0xx of severity error.
bool is_input_error(const Diagnostic& diagnostic);

/// The same for every format.
/// 4: a self-check failed. 2: an input error, or a violation that was to be
/// executed on a board and was not. 1: a violation, or a finding at
/// or above `fail_on`. 3: something bounded, vacuous or unknown. 0: none.
int exit_status(const Report& report);

/// The violation on the board; null where that was not asked for.
const BoardReplay* replay_of(const FileReport& file,
                             const Obligation& obligation);

/// The lint rule's name, or "input" for input errors.
std::string_view rule_name(const Diagnostic& diagnostic);

}  // namespace rung
