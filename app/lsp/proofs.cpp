#include <chrono>
#include <exception>
#include <utility>

#include "analysis/rule.h"
#include "app/lsp/refusal.h"
#include "app/lsp/server.h"
#include "app/select.h"

namespace rung::lsp {
namespace {

using Clock = std::chrono::steady_clock;

/// So much between two lines about one proof.
constexpr std::chrono::milliseconds kPause{100};

/// Says how a proof comes along; engines do so from several threads.
class Progress {
 public:
  Progress(Outbox& outbox, Json token)
      : outbox_(outbox), token_(std::move(token)) {}

  void begin(const std::string& title) {
    send({{"kind", "begin"}, {"title", title}, {"cancellable", true}});
  }
  void report(std::string_view what) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (Clock::now() < next_) return;
    next_ = Clock::now() + kPause;
    send({{"kind", "report"}, {"message", what}});
  }
  void end() { send({{"kind", "end"}}); }

 private:
  void send(Json value) {
    if (token_.is_null()) return;
    outbox_.notify("$/progress", {{"token", token_}, {"value", value}});
  }

  Outbox& outbox_;
  Json token_;
  std::mutex mutex_;
  Clock::time_point next_;
};

Json to_json(const ObligationResult& result) {
  return {{"name", result.obligation.name},
          {"verdict", to_string(result.verdict)},
          {"engine", result.engine},
          {"milliseconds", result.milliseconds},
          {"reason", result.reason}};
}

/// The new answers in the place of the old ones.
void merge(std::vector<ObligationResult> results,
           std::vector<ObligationResult>& all) {
  for (ObligationResult& result : results) {
    std::erase_if(all, [&](const ObligationResult& old) {
      return old.obligation.name == result.obligation.name;
    });
    all.push_back(std::move(result));
  }
}

}  // namespace

VerifyOptions Server::verify_options(const Options& options) const {
  VerifyOptions verify;
  verify.budget.seconds = proof_seconds_;
  verify.engine = options.engine;
  verify.jobs = options.jobs;
  verify.self_check = options.self_check;
  verify.recheck = options.recheck;
  return verify;
}

Json Server::execute_command(const Json& params) {
  const auto& command = params.at("command").get_ref<const std::string&>();
  const Json arguments = params.value("arguments", Json::array());
  if (command == "rungproof.prove") {
    start_proof(arguments, params.value("workDoneToken", Json()));
    return nullptr;
  }
  if (command == "rungproof.showCounterexample") {
    return show_counterexample(arguments);
  }
  if (command == "rungproof.showRule") {
    const Rule* const rule = find_rule(arguments.at(0).get<std::string>());
    if (rule == nullptr) throw Refusal{kInvalidParams, "there is no such rule"};
    return rule->doc;
  }
  throw Refusal{kInvalidParams, "there is no such command: " + command};
}

Document& Server::document_at(const Json& arguments) {
  return document_of(
      {{"textDocument", {{"uri", arguments.at(0).get<std::string>()}}}});
}

Json Server::show_counterexample(const Json& arguments) {
  const View view = view_of(document_at(arguments));
  const auto name = arguments.at(1).get<std::string>();
  const ObligationResult* const worst = worst_of(results_of(view, name));
  if (worst == nullptr || worst->verdict != Verdict::Violated) {
    throw Refusal{kRequestFailed, "no violation of `" + name +
                                      "` is known of the text as it is now"};
  }
  const std::string text = counterexample_text(view, *worst);
  constexpr int kError = 1;  // MessageType
  outbox_.notify(
      "window/showMessage",
      {{"type", kError}, {"message", text.substr(0, text.find("\n\n"))}});
  return text;
}

void Server::start_proof(const Json& arguments, Json token) {
  Document& document = document_at(arguments);
  const View view = view_of(document);
  if (view.snapshot.program() == nullptr) {
    throw Refusal{kRequestFailed, "the text has errors: nothing is proved"};
  }
  auto job = std::make_shared<ProveJob>();
  job->id = current_id_;
  job->uri = document.uri;
  job->revision = document.revision;
  job->snapshot = document.snapshot;
  job->options = document.options;
  if (token.is_string() || token.is_number()) job->token = std::move(token);
  if (arguments.size() > 1) {
    job->property = arguments.at(1).get<std::string>();
  }
  for (const Property& property :
       view.snapshot.loaded.report.properties.properties) {
    if (property.built_in) continue;
    if (job->property.empty() || property.name == job->property) {
      document.running.insert(property.name);
      job->names.push_back(property.name);
    }
  }
  if (job->names.empty()) {
    throw Refusal{kInvalidParams, "there is no such property"};
  }
  if (job->token.is_null() && makes_progress_) {
    job->token = "rungproof/" + job->id.dump();
    outbox_.request("window/workDoneProgress/create", {{"token", job->token}});
  }
  deferred_ = true;
  jobs_[job->id.dump()] = job;
  prover_.post([this, job] { prove(*job); });
  refresh_lenses();
}

void Server::prove(const ProveJob& job) {
  if (job.stop) return;  // and was answered
  Progress progress(outbox_, job.token);
  progress.begin("proving " + (job.property.empty()
                                   ? std::string("all properties")
                                   : job.property));
  VerifyOptions options = verify_options(job.options);
  options.budget.stop = &job.stop;
  options.progress = [&](std::string_view what) { progress.report(what); };
  if (!job.property.empty()) options.wanted = wanted_by({job.property});
  VerifyReport report;
  try {
    report = verify(*job.snapshot->program(),
                    job.snapshot->loaded.report.properties, options);
  } catch (const std::exception& error) {
    report.failures.push_back({job.property, error.what()});
  }
  progress.end();
  const std::lock_guard<std::mutex> lock(mutex_);
  finish(job, std::move(report));
}

/// A job that was stopped has been answered, and says nothing more.
void Server::finish(const ProveJob& job, VerifyReport report) {
  if (jobs_.erase(job.id.dump()) == 0 || job.stop) return;
  Document* const document = find_document(job.uri, job.revision);
  if (document == nullptr) {
    outbox_.fail(job.id, kContentModified, "the text has changed");
    return;
  }
  for (const std::string& name : job.names) document->running.erase(name);
  if (!report.failures.empty()) {
    outbox_.fail(job.id, kInternalError,
                 "self-check failed: " + report.failures.front().what);
    refresh_lenses();
    return;
  }
  Json answers = Json::array();
  for (const ObligationResult& result : report.results) {
    answers.push_back(to_json(result));
  }
  merge(std::move(report.results), document->results);
  outbox_.answer(job.id, {{"results", std::move(answers)}});
  publish(*document);
  refresh_lenses();
}

void Server::stop(ProveJob& job, int code, std::string_view why) {
  job.stop = true;
  outbox_.fail(job.id, code, why);
  if (Document* const document = find_document(job.uri, job.revision)) {
    for (const std::string& name : job.names) document->running.erase(name);
  }
}

void Server::stop_jobs(const std::string& uri) {
  for (auto it = jobs_.begin(); it != jobs_.end();) {
    if (it->second->uri == uri) {
      stop(*it->second, kContentModified, "the text has changed");
      it = jobs_.erase(it);
    } else {
      ++it;
    }
  }
}

Json Server::cancel(const Json& params) {
  const auto found = jobs_.find(params.at("id").dump());
  if (found == jobs_.end()) return nullptr;  // answered already
  stop(*found->second, kRequestCancelled, "cancelled");
  jobs_.erase(found);
  refresh_lenses();
  return nullptr;
}

Json Server::cancel_progress(const Json& params) {
  const Json& token = params.at("token");
  for (const auto& [id, job] : jobs_) {
    if (job->token == token) return cancel({{"id", job->id}});
  }
  return nullptr;
}

}  // namespace rung::lsp
