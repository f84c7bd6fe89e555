#include <chrono>
#include <filesystem>
#include <utility>

#include "analysis/fixes/apply_edits.h"
#include "app/config.h"
#include "app/fix_proof.h"
#include "app/lint.h"
#include "app/lsp/features.h"
#include "app/lsp/refusal.h"
#include "app/lsp/server.h"
#include "app/option_values.h"

namespace rung::lsp {
namespace {

/// As long as nobody types for that long.
constexpr std::chrono::milliseconds kPause{150};

int hex(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// The file of an address; of one that is no file's, the address.
std::string path_in(const std::string& uri) {
  constexpr std::string_view kFile = "file://";
  if (!uri.starts_with(kFile)) return uri;
  std::string path;
  for (std::size_t i = kFile.size(); i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                         hex(uri[i + 1]) >= 0 && hex(uri[i + 2]) >= 0;
    path += escaped ? static_cast<char>(hex(uri[i + 1]) * 16 + hex(uri[i + 2]))
                    : uri[i];
    if (escaped) i += 2;
  }
  return path;
}

}  // namespace

Document& Server::document_of(const Json& params) {
  const auto& uri =
      params.at("textDocument").at("uri").get_ref<const std::string&>();
  const auto found = documents_.find(uri);
  if (found == documents_.end()) {
    throw Refusal{kInvalidParams, "the document is not open: " + uri};
  }
  return *found->second;
}

Document* Server::find_document(const std::string& uri, std::int64_t version) {
  const auto found = documents_.find(uri);
  if (found == documents_.end()) return nullptr;
  return found->second->revision == version ? found->second.get() : nullptr;
}

View Server::view_of(Document& document) const {
  if (!document.snapshot) {
    document.snapshot = take_snapshot(path_in(document.uri), document.revision,
                                      document.text, document.options);
  }
  return {document.uri,     *document.snapshot, document.findings,
          document.results, document.running,   document.fixes_decided,
          encoding_};
}

Json Server::did_open(const Json& params) {
  const Json& item = params.at("textDocument");
  auto document = std::make_unique<Document>();
  document->uri = item.at("uri").get<std::string>();
  document->version = version_in(item, 0);
  document->text = TextDocument(item.at("text").get<std::string>());
  Document& opened = *document;
  documents_[opened.uri] = std::move(document);
  text_changed(opened);
  return nullptr;
}

Json Server::did_change(const Json& params) {
  Document& document = document_of(params);
  // All of them or none: a half-changed text would be that of nobody.
  TextDocument text = document.text;
  for (const Json& change : params.at("contentChanges")) {
    const auto& inserted = change.at("text").get_ref<const std::string&>();
    const auto range = change.find("range");
    if (range == change.end() || range->is_null()) {
      text = TextDocument(inserted);
      continue;
    }
    const auto begin = text.offset(position_in(range->at("start")), encoding_);
    const auto end = text.offset(position_in(range->at("end")), encoding_);
    text.replace(begin, end, inserted);
  }
  document.version =
      version_in(params.at("textDocument"), document.version + 1);
  document.text = std::move(text);
  text_changed(document);
  return nullptr;
}

Json Server::did_close(const Json& params) {
  const std::string uri = document_of(params).uri;
  stop_jobs(uri);
  *documents_[uri]->stale = true;
  documents_.erase(uri);
  outbox_.notify("textDocument/publishDiagnostics",
                 {{"uri", uri}, {"diagnostics", Json::array()}});
  return nullptr;
}

/// A configuration is looked up anew for each text: it may have changed, too.
Options Server::options_for(const Document& document) {
  if (!document.uri.starts_with("file://")) return options_;
  ConfigFinder finder(options_);
  const Config* const config = finder.of(path_in(document.uri));
  if (finder.error()) {
    constexpr int kError = 1;  // MessageType
    outbox_.notify("window/logMessage",
                   {{"type", kError}, {"message", *finder.error()}});
  }
  return config == nullptr ? options_ : with_config(options_, *config);
}

/// Nothing that was known is known of the new text.
void Server::text_changed(Document& document) {
  stop_jobs(document.uri);
  document.revision = ++revisions_;
  document.snapshot.reset();
  document.options = options_for(document);
  document.findings.clear();
  document.results.clear();
  document.running.clear();
  document.fixes_decided = false;
  *document.stale = true;
  document.stale = std::make_shared<std::atomic<bool>>(false);
  checker_.post([this, uri = document.uri,
                 revision = document.revision] { check(uri, revision); },
                kPause);
}

void Server::publish(Document& document) {
  outbox_.notify("textDocument/publishDiagnostics",
                 {{"uri", document.uri},
                  {"version", document.version},
                  {"diagnostics", diagnostics_of(view_of(document))}});
}

void Server::refresh_lenses() {
  if (refreshes_lenses_) {
    outbox_.request("workspace/codeLens/refresh", nullptr);
  }
}

/// Errors of the text are told at once, findings when the rules have run.
void Server::check(const std::string& uri, std::int64_t revision) {
  std::shared_ptr<const Snapshot> snapshot;
  Options options;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    Document* const document = find_document(uri, revision);
    if (document == nullptr) return;
    view_of(*document);
    snapshot = document->snapshot;
    options = document->options;
    if (snapshot->program() == nullptr) {
      publish(*document);
      return;
    }
  }
  FileReport report = snapshot->loaded.report;
  report.findings.clear();
  lint(snapshot->sources, *snapshot->program(), report, verify_options(options),
       make_selection(options.packs, options.rules));
  const std::lock_guard<std::mutex> lock(mutex_);
  Document* const document = find_document(uri, revision);
  if (document == nullptr) return;  // the next check is under way
  document->findings = std::move(report.findings);
  publish(*document);
  refresh_lenses();
  checker_.post([this, uri, revision] { prove_fixes(uri, revision); });
}

/// Known a little later than the findings, and told by the quick fixes.
void Server::prove_fixes(const std::string& uri, std::int64_t revision) {
  using Clock = std::chrono::steady_clock;
  constexpr double kOneProof = 2;  // seconds
  constexpr std::chrono::seconds kAllProofs{5};
  std::shared_ptr<const Snapshot> snapshot;
  std::shared_ptr<std::atomic<bool>> stale;
  std::vector<Diagnostic> findings;
  Options options;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const Document* const document = find_document(uri, revision);
    if (document == nullptr) return;
    snapshot = document->snapshot;
    stale = document->stale;
    findings = document->findings;
    options = document->options;
  }
  const std::vector<AstAnnotation> none;
  const FixProof proof(snapshot->loaded, path_in(uri), options, none);
  const Clock::time_point end = Clock::now() + kAllProofs;
  for (Diagnostic& finding : findings) {
    for (Fix& fix : finding.fixes) {
      if (*stale || Clock::now() >= end) break;
      fix.proved = make_disjoint(fix.edits) &&
                   proof
                       .prove(apply_edits(snapshot->text.text(), fix.edits),
                              kOneProof, stale.get())
                       .proved;
    }
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  Document* const document = find_document(uri, revision);
  if (document == nullptr) return;
  document->findings = std::move(findings);
  document->fixes_decided = true;
}

}  // namespace rung::lsp
