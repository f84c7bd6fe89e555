#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/source.h"

namespace rung {

enum class Severity : std::uint8_t { Note, Warning, Error };

std::string_view to_string(Severity severity);

struct Label {
  SourceRange where;
  std::string text;
};

/// One replacement in a source: an empty range inserts, empty text deletes.
struct Edit {
  SourceRange where;
  std::string text;
};

/// A change of the source that takes a finding away.
struct Fix {
  std::string title;        // "remove the contact `I0`"
  std::vector<Edit> edits;  // of one file, in its order, without overlap
  bool proved = false;      // the program after it is proved to do the same
};

/// Why a finding does not count. It is still told where a format has a place
/// for it: a finding that vanished would be opened anew by the next reader.
struct Waiver {
  enum class Kind : std::uint8_t { InSource, Baseline };
  Kind kind = Kind::InSource;
  std::string reason;
};

/// One finding about the user's input: data, not text that is already laid
/// out, so that every report writer reads the same record.
///
/// Codes: RP0xx input errors (the file is not read further than diagnostics:
///        exit 2), RP1xx and above are lint rules.
struct Diagnostic {
  std::string_view code;  // "RP101": static storage, never reused
  Severity severity = Severity::Warning;
  SourceRange where;
  std::string message;         // lower case, no full stop, names in `backticks`
  std::vector<Label> labels;   // other places, each with what it has to do here
  std::string_view rule = {};  // "double-coil"; empty for input errors
  std::string help = {};       // a remedy, or what was proved; may be empty
  std::vector<Fix> fixes = {};
  std::optional<Waiver> waiver = {};
};

class DiagnosticSink {
 public:
  virtual ~DiagnosticSink() = default;
  virtual void report(Diagnostic diagnostic) = 0;
};

/// Keeps what is reported, in the order of arrival.
class DiagnosticList : public DiagnosticSink {
 public:
  void report(Diagnostic diagnostic) override {
    has_errors_ = has_errors_ || diagnostic.severity == Severity::Error;
    items_.push_back(std::move(diagnostic));
  }
  bool has_errors() const { return has_errors_; }
  const std::vector<Diagnostic>& items() const { return items_; }
  std::vector<Diagnostic> take() { return std::move(items_); }

 private:
  std::vector<Diagnostic> items_;
  bool has_errors_ = false;
};

/// Sorts by file, offset, code, message: reports never depend on the order in
/// which rules ran.
void sort_diagnostics(std::vector<Diagnostic>& diagnostics);

}  // namespace rung
