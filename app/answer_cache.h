#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "app/options.h"
#include "app/packed_answer.h"
#include "app/result_store.h"
#include "app/text_pool.h"
#include "base/source.h"
#include "reports/report.h"
#include "smt/verify.h"

namespace rung {

/// Whole answers about programs that were asked before: with the same bytes,
/// options and property lines, by the same build. docs/cache.md says what is
/// kept and what is not. For any thread.
class AnswerCache {
 public:
  /// What `--cache` and RUNGPROOF_CACHE ask for. Null: none, or what is asked
  /// for is never kept. A text: why it cannot be used.
  static std::variant<std::unique_ptr<AnswerCache>, std::string> open(
      const Options& options);
  /// Keeps within bounds what this run has added to.
  ~AnswerCache();
  AnswerCache(const AnswerCache&) = delete;
  AnswerCache& operator=(const AnswerCache&) = delete;

  /// One program as it was loaded, and what else its answer depends on.
  struct Question {
    Digest key;
    AnswerFiles files;
    std::size_t first_note = 0;  // of those that loading did not make
  };
  /// `preset`: as Session::load() was asked for it. `options`: those of the
  /// program, with its configuration.
  Question question(const SourceSet& sources, const FileReport& loaded,
                    FileId properties, std::string_view preset,
                    const Options& options) const;

  /// Puts the answer into `report`, and says whether there is one.
  bool find(const Question& question, FileReport& report);

  /// One that was left open is as good as any: the budget is part of the
  /// question. One whose self-check failed is never kept.
  void keep(const Question& question, const FileReport& report);

  /// As verify(), on the properties of `report`. Of the program that was at its
  /// path before, it takes over what is about the same slices.
  VerifyReport verify(const FileReport& report, std::string_view preset,
                      const Options& settings, const VerifyOptions& options);

  /// Why entries could not be written; empty: they were.
  std::string failure() const;

 private:
  AnswerCache(const Options& options, ResultStore store, const Digest& build);

  void write(const Digest& key, std::string_view bytes);

  ResultStore store_;
  Digest answers_;  // of all that programs of one run have in common
  Digest proofs_;   // the same, of what is decided for good
  TextPool texts_;
  mutable std::mutex mutex_;
  bool has_written_ = false;
  std::string failure_;
};

/// Where `--cache` (else RUNGPROOF_CACHE) says that answers are kept; empty:
/// nowhere. `on` is rungproof/ in the user's directory for such.
std::string cache_directory(const Options& options);

}  // namespace rung
