#pragma once

#include <atomic>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/lsp/outbox.h"
#include "app/lsp/snapshot.h"
#include "app/lsp/view.h"
#include "app/lsp/worker.h"
#include "app/options.h"
#include "smt/verify.h"

namespace rung::lsp {

/// An open file. What was found out about a text is dropped with it.
struct Document {
  std::string uri;
  std::int64_t version = 0;   // the client's: it may repeat one
  std::int64_t revision = 0;  // ours: never the same twice
  TextDocument text;
  std::shared_ptr<const Snapshot> snapshot;  // null: not read yet
  std::vector<Diagnostic> findings;
  std::vector<ObligationResult> results;
  std::set<std::string> running;
  bool fixes_decided = false;  // each fix says whether it is proved
  /// Set when the text is no longer this one: whoever works on it gives up.
  std::shared_ptr<std::atomic<bool>> stale =
      std::make_shared<std::atomic<bool>>(false);
  Options options;  // the command line's, and those of its configuration
};

/// Properties that are being proved, and the request that waits for them.
struct ProveJob {
  Json id;
  Json token;  // of its progress; null: the client shows none
  std::string uri;
  std::int64_t revision = 0;
  std::shared_ptr<const Snapshot> snapshot;
  Options options;
  std::string property;            // empty: all
  std::vector<std::string> names;  // those that are written
  std::atomic<bool> stop = false;
};

/// A language server: takes messages, one at a time, from one thread; rules and
/// proofs run on threads of their own and are answered when they are done.
class Server {
 public:
  Server(const Options& options, std::FILE* out);
  ~Server();  // stops what runs, and waits for it
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  void receive(const std::string& body);
  void receive_error(const std::string& what);

  /// The exit status, once the client has sent `exit`.
  const std::optional<int>& exit() const { return exit_; }

 private:
  struct Handler;
  static const Handler* find_handler(std::string_view method);

  // All but the functions of worker threads are called with mutex_ locked.
  void dispatch(const Json& message);
  void answer(const Handler& handler, const Json& id, bool asks,
              const Json& params);

  // Lifecycle and documents.
  Json initialize(const Json& params);
  Json nothing(const Json& params);
  Json shutdown(const Json& params);
  Json leave(const Json& params);
  Json did_open(const Json& params);
  Json did_change(const Json& params);
  Json did_close(const Json& params);
  Document& document_of(const Json& params);
  Options options_for(const Document& document);
  Document* find_document(const std::string& uri, std::int64_t revision);
  View view_of(Document& document) const;
  void text_changed(Document& document);
  void publish(Document& document);
  void refresh_lenses();

  // Questions about a document.
  Json hover(const Json& params);
  Json code_lens(const Json& params);
  Json document_symbol(const Json& params);
  Json definition(const Json& params);
  Json references(const Json& params);
  Json highlight(const Json& params);
  Json prepare_rename(const Json& params);
  Json rename(const Json& params);
  Json code_action(const Json& params);

  // Commands and proofs.
  Json execute_command(const Json& params);
  Json cancel(const Json& params);
  Json cancel_progress(const Json& params);
  Json show_counterexample(const Json& arguments);
  Document& document_at(const Json& arguments);
  void start_proof(const Json& arguments, Json token);
  void finish(const ProveJob& job, VerifyReport report);
  void stop(ProveJob& job, int code, std::string_view why);
  void stop_jobs(const std::string& uri);
  VerifyOptions verify_options(const Options& options) const;

  // On worker threads.
  void check(const std::string& uri, std::int64_t revision);
  void prove_fixes(const std::string& uri, std::int64_t revision);
  void prove(const ProveJob& job);

  const Options& options_;
  Outbox outbox_;
  std::mutex mutex_;  // of all that follows, but the workers
  std::map<std::string, std::unique_ptr<Document>> documents_;
  std::map<std::string, std::shared_ptr<ProveJob>> jobs_;  // by id, as JSON
  std::int64_t revisions_ = 0;
  Encoding encoding_ = Encoding::Utf16;
  bool initialized_ = false;
  bool shut_down_ = false;
  bool refreshes_lenses_ = false;
  bool makes_progress_ = false;
  double proof_seconds_;
  Json current_id_;        // of the request that is handled
  bool deferred_ = false;  // a worker answers it
  std::optional<int> exit_;
  Worker checker_;  // last: their tasks use the rest
  Worker prover_;
};

}  // namespace rung::lsp
