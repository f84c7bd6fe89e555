#include "app/fixer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "analysis/fixes/apply_edits.h"
#include "app/fix_proof.h"
#include "app/lint.h"
#include "app/option_values.h"

namespace rung {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostRounds = 10;
constexpr double kOneProof = 10;  // seconds

class Fixer {
 public:
  Fixer(std::string path, const Options& options,
        const std::vector<AstAnnotation>& extra,
        const VerifyOptions& verify_options)
      : path_(std::move(path)),
        options_(options),
        extra_(extra),
        verify_options_(verify_options),
        end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(
                 std::chrono::duration<double>(options.timeout))) {}

  FixedText run(const std::string& text) {
    FixedText fixed{text, {}, ""};
    for (int i = 0; i < kMostRounds; ++i) {
      std::string next = round(fixed.text);
      if (next.empty()) break;
      fixed.text = std::move(next);
    }
    if (fixed.text != text) check_whole(text, fixed);
    fixed.records = std::move(applied_);
    fixed.records.insert(fixed.records.end(), refused_.begin(), refused_.end());
    return fixed;
  }

 private:
  /// The text after the fixes that can be applied to it now; empty: none can.
  std::string round(const std::string& text) {
    refused_.clear();
    SourceSet sources;
    const Input input{sources.add(path_, text), path_, std::nullopt};
    Loaded loaded = load(input, options_, extra_, sources);
    if (!loaded.program) return "";  // who runs it reports that
    lint(sources, *loaded.program, loaded.report, verify_options_,
         make_selection(options_.packs, options_.rules));
    const FixProof proof(loaded, path_, options_, extra_);
    std::vector<Edit> edits;
    if (!try_all(sources, proof, loaded.report.findings, edits)) {
      for (const Diagnostic& finding : loaded.report.findings) {
        try_finding(sources, proof, finding, edits);
      }
    }
    return edits.empty() ? "" : apply_edits(text, edits);
  }

  double seconds_left() const {
    const std::chrono::duration<double> left = end_ - Clock::now();
    return std::min(left.count(), kOneProof);
  }

  FixProof::Answer prove(const SourceSet& sources, const FixProof& proof,
                         SourceRange where,
                         const std::vector<Edit>& edits) const {
    const double seconds = seconds_left();
    if (seconds <= 0) return {false, "the time was up"};
    return proof.prove(apply_edits(sources[where.file].text(), edits), seconds);
  }

  /// The first fix of every finding, proved together: the usual case, where
  /// one proof is enough.
  bool try_all(const SourceSet& sources, const FixProof& proof,
               const std::vector<Diagnostic>& findings,
               std::vector<Edit>& edits) {
    std::vector<Edit> all;
    std::vector<const Diagnostic*> with_fix;
    for (const Diagnostic& finding : findings) {
      if (finding.fixes.empty()) continue;
      with_fix.push_back(&finding);
      const std::vector<Edit>& more = finding.fixes.front().edits;
      all.insert(all.end(), more.begin(), more.end());
    }
    if (with_fix.size() < 2 || !make_disjoint(all)) return false;
    const FixProof::Answer answer =
        prove(sources, proof, with_fix.front()->where, all);
    if (!answer.proved) return false;
    for (const Diagnostic* finding : with_fix) {
      applied_.push_back(
          record(sources, *finding, finding->fixes.front(), answer));
    }
    edits = std::move(all);
    return true;
  }

  /// The first of its fixes that is proved beside those that are taken.
  void try_finding(const SourceSet& sources, const FixProof& proof,
                   const Diagnostic& finding, std::vector<Edit>& edits) {
    std::vector<FixRecord> refused;
    for (const Fix& fix : finding.fixes) {
      std::vector<Edit> more = edits;
      more.insert(more.end(), fix.edits.begin(), fix.edits.end());
      FixProof::Answer answer{false, "another fix changes the same place"};
      if (make_disjoint(more) && more.size() > edits.size()) {
        answer = prove(sources, proof, finding.where, more);
      }
      if (answer.proved) {
        applied_.push_back(record(sources, finding, fix, answer));
        edits = std::move(more);
        return;
      }
      refused.push_back(record(sources, finding, fix, answer));
    }
    refused_.insert(refused_.end(), refused.begin(), refused.end());
  }

  static FixRecord record(const SourceSet& sources, const Diagnostic& finding,
                          const Fix& fix, const FixProof::Answer& answer) {
    const SourceFile& file = sources[finding.where.file];
    const LineColumn at = file.position(finding.where.begin);
    return {fmt::format("{}:{}:{}", file.path(), at.line, at.column),
            fmt::format("{} {}", finding.code, finding.rule), fix.title,
            answer.proved, answer.reason};
  }

  void check_whole(const std::string& text, FixedText& fixed) {
    SourceSet sources;
    const Input input{sources.add(path_, text), path_, std::nullopt};
    const Loaded before = load(input, options_, extra_, sources);
    const FixProof::Answer answer =
        FixProof(before, path_, options_, extra_)
            .prove(fixed.text, std::max(seconds_left(), 1.0));
    if (answer.proved) return;
    fixed.failure =
        "the fixes are not proved as a whole, so none is applied: " +
        answer.reason;
    fixed.text = text;
    for (FixRecord& it : applied_) {
      it.applied = false;
      it.reason = "not proved together with the others";
    }
  }

  const std::string path_;
  const Options& options_;
  const std::vector<AstAnnotation>& extra_;
  const VerifyOptions& verify_options_;
  const Clock::time_point end_;
  std::vector<FixRecord> applied_;  // in all rounds
  std::vector<FixRecord> refused_;  // in the last one
};

}  // namespace

FixedText fix_text(const std::string& path, const std::string& text,
                   const Options& options,
                   const std::vector<AstAnnotation>& extra,
                   const VerifyOptions& verify_options) {
  return Fixer(path, options, extra, verify_options).run(text);
}

}  // namespace rung
