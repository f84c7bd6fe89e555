#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.h"

namespace rung {

/// Passes diagnostics on, but no more than kLimit errors: a file that is no
/// script at all would give one for every line. finish() says how many were
/// left out (RP002).
class ErrorLimit : public DiagnosticSink {
 public:
  static constexpr std::uint64_t kLimit = 100;

  explicit ErrorLimit(DiagnosticSink& sink) : sink_(&sink) {}

  void report(Diagnostic diagnostic) override {
    if (diagnostic.severity == Severity::Error && ++errors_ > kLimit) {
      last_ = diagnostic.where;
      return;
    }
    sink_->report(std::move(diagnostic));
  }

  void error(std::string_view code, const SourceRange& where,
             std::string message, std::vector<Label> labels = {}) {
    report({.code = code,
            .severity = Severity::Error,
            .where = where,
            .message = std::move(message),
            .labels = std::move(labels)});
  }

  /// Further errors are only counted: their text need not be made.
  bool is_full() const { return errors_ >= kLimit; }
  bool has_errors() const { return errors_ > 0; }

  void finish() {
    if (errors_ <= kLimit) return;
    sink_->report(
        {.code = "RP002",
         .severity = Severity::Note,
         .where = last_,
         .message = "too many errors: " + std::to_string(errors_ - kLimit) +
                    " more are left out",
         .labels = {}});
  }

 private:
  DiagnosticSink* sink_;
  std::uint64_t errors_ = 0;
  SourceRange last_;
};

}  // namespace rung
