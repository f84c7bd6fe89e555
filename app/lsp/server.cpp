#include "app/lsp/server.h"

#include <array>
#include <exception>
#include <utility>

#include "app/lsp/features.h"
#include "app/lsp/refusal.h"
#include "app/version.h"

namespace rung::lsp {
namespace {

constexpr double kProofSeconds = 10;
constexpr double kMostSeconds = 3600;

/// The encoding that suits: the client's first that is known; UTF-16 is the
/// one that all have.
Encoding choose_encoding(const Json& capabilities) {
  const Json offered = capabilities.value(
      Json::json_pointer("/general/positionEncodings"), Json::array());
  for (const Json& name : offered) {
    if (name == "utf-8") return Encoding::Utf8;
    if (name == "utf-16") return Encoding::Utf16;
    if (name == "utf-32") return Encoding::Utf32;
  }
  return Encoding::Utf16;
}

std::string_view name_of(Encoding encoding) {
  switch (encoding) {
    case Encoding::Utf8:
      return "utf-8";
    case Encoding::Utf16:
      return "utf-16";
    case Encoding::Utf32:
      break;
  }
  return "utf-32";
}

/// The library copies and writes values by recursion.
bool is_deep(std::string_view body) {
  constexpr int kMostLevels = 64;
  int levels = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const char c = body[i];
    if (c == '"') quoted = !quoted;
    if (quoted && c == '\\') ++i;
    if (quoted) continue;
    if (c == '[' || c == '{') ++levels;
    if (c == ']' || c == '}') --levels;
    if (levels > kMostLevels) return true;
  }
  return false;
}

bool is_id(const Json& id) {
  return id.is_null() || id.is_number() || id.is_string();
}

Json capabilities_with(Encoding encoding) {
  constexpr int kIncremental = 2;
  return {{"positionEncoding", name_of(encoding)},
          {"textDocumentSync", {{"openClose", true}, {"change", kIncremental}}},
          {"hoverProvider", true},
          {"codeLensProvider", {{"resolveProvider", false}}},
          {"documentSymbolProvider", true},
          {"definitionProvider", true},
          {"referencesProvider", true},
          {"documentHighlightProvider", true},
          {"renameProvider", {{"prepareProvider", true}}},
          {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}},
          {"executeCommandProvider",
           {{"commands",
             {"rungproof.prove", "rungproof.showCounterexample",
              "rungproof.showRule"}},
            {"workDoneProgress", true}}}};
}

}  // namespace

struct Server::Handler {
  std::string_view method;
  Json (Server::*handle)(const Json& params);
  bool before_initialize = false;
};

const Server::Handler* Server::find_handler(std::string_view method) {
  static constexpr std::array kHandlers = {
      Handler{"initialize", &Server::initialize, true},
      Handler{"initialized", &Server::nothing},
      Handler{"shutdown", &Server::shutdown},
      Handler{"exit", &Server::leave, true},
      Handler{"$/cancelRequest", &Server::cancel},
      Handler{"$/setTrace", &Server::nothing},
      Handler{"window/workDoneProgress/cancel", &Server::cancel_progress},
      Handler{"workspace/didChangeConfiguration", &Server::nothing},
      Handler{"textDocument/didOpen", &Server::did_open},
      Handler{"textDocument/didChange", &Server::did_change},
      Handler{"textDocument/didClose", &Server::did_close},
      Handler{"textDocument/didSave", &Server::nothing},
      Handler{"textDocument/hover", &Server::hover},
      Handler{"textDocument/codeLens", &Server::code_lens},
      Handler{"textDocument/documentSymbol", &Server::document_symbol},
      Handler{"textDocument/definition", &Server::definition},
      Handler{"textDocument/references", &Server::references},
      Handler{"textDocument/documentHighlight", &Server::highlight},
      Handler{"textDocument/prepareRename", &Server::prepare_rename},
      Handler{"textDocument/rename", &Server::rename},
      Handler{"textDocument/codeAction", &Server::code_action},
      Handler{"workspace/executeCommand", &Server::execute_command},
  };
  for (const Handler& handler : kHandlers) {
    if (handler.method == method) return &handler;
  }
  return nullptr;
}

Server::Server(const Options& options, std::FILE* out)
    : options_(options), outbox_(out), proof_seconds_(kProofSeconds) {}

Server::~Server() {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto& [id, job] : jobs_) job->stop = true;
  for (auto& [uri, document] : documents_) *document->stale = true;
}

void Server::receive_error(const std::string& what) {
  outbox_.fail(nullptr, kParseError, what);
}

void Server::receive(const std::string& body) {
  if (is_deep(body)) {
    outbox_.fail(nullptr, kParseError, "the message is nested too deep");
    return;
  }
  const Json message = Json::parse(body, nullptr, false);
  if (message.is_discarded()) {
    outbox_.fail(nullptr, kParseError, "the message is no JSON");
    return;
  }
  if (!message.is_object()) {
    outbox_.fail(nullptr, kInvalidRequest, "the message is no object");
    return;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  dispatch(message);
}

void Server::dispatch(const Json& message) {
  const Json id = message.value("id", Json());
  const bool asks = message.contains("id");
  if (!is_id(id)) {
    outbox_.fail(nullptr, kInvalidRequest, "the id is no number and no text");
    return;
  }
  const auto method = message.find("method");
  if (method == message.end() || !method->is_string()) {
    // The answer to a request of ours has no method.
    if (message.contains("result") || message.contains("error")) return;
    outbox_.fail(id, kInvalidRequest, "the message has no method");
    return;
  }
  const auto& name = method->get_ref<const std::string&>();
  const Handler* const handler = find_handler(name);
  if (handler == nullptr) {
    if (asks) outbox_.fail(id, kMethodNotFound, "not supported: " + name);
    return;
  }
  if (asks && shut_down_) {
    outbox_.fail(id, kInvalidRequest, "the server was shut down");
  } else if (!initialized_ && !handler->before_initialize) {
    if (asks) outbox_.fail(id, kNotInitialized, "not initialized yet");
  } else {
    answer(*handler, id, asks, message.value("params", Json::object()));
  }
}

void Server::answer(const Handler& handler, const Json& id, bool asks,
                    const Json& params) {
  current_id_ = id;
  deferred_ = false;
  try {
    Json result = (this->*handler.handle)(params);
    if (asks && !deferred_) outbox_.answer(id, std::move(result));
  } catch (const Refusal& refusal) {
    if (asks) outbox_.fail(id, refusal.code, refusal.what);
  } catch (const Json::exception& error) {
    if (asks) outbox_.fail(id, kInvalidParams, error.what());
  } catch (const std::exception& error) {
    if (asks) outbox_.fail(id, kInternalError, error.what());
  }
}

// --- lifecycle ---------------------------------------------------------------

Json Server::initialize(const Json& params) {
  if (initialized_) throw Refusal{kInvalidRequest, "initialized already"};
  const Json capabilities = params.value("capabilities", Json::object());
  encoding_ = choose_encoding(capabilities);
  refreshes_lenses_ = capabilities.value(
      Json::json_pointer("/workspace/codeLens/refreshSupport"), false);
  makes_progress_ =
      capabilities.value(Json::json_pointer("/window/workDoneProgress"), false);
  const Json wanted = params.value("initializationOptions", Json());
  if (wanted.is_object()) {
    const double seconds = wanted.value("proofSeconds", kProofSeconds);
    if (seconds > 0 && seconds <= kMostSeconds) proof_seconds_ = seconds;
  }
  initialized_ = true;
  return {{"capabilities", capabilities_with(encoding_)},
          {"serverInfo", {{"name", "rungproof"}, {"version", kVersion}}}};
}

Json Server::nothing(const Json& /*params*/) { return nullptr; }

Json Server::shutdown(const Json& /*params*/) {
  shut_down_ = true;
  for (auto& [id, job] : jobs_) job->stop = true;
  return nullptr;
}

Json Server::leave(const Json& /*params*/) {
  exit_ = shut_down_ ? 0 : 1;
  return nullptr;
}

// --- questions ---------------------------------------------------------------

Json Server::hover(const Json& params) {
  const View view = view_of(document_of(params));
  return hover_at(view, offset_in(view, params.at("position")));
}

Json Server::code_lens(const Json& params) {
  return code_lenses_of(view_of(document_of(params)));
}

Json Server::document_symbol(const Json& params) {
  return symbols_of(view_of(document_of(params)));
}

Json Server::definition(const Json& params) {
  const View view = view_of(document_of(params));
  return definition_at(view, offset_in(view, params.at("position")));
}

Json Server::references(const Json& params) {
  const View view = view_of(document_of(params));
  const bool declaration =
      params.value(Json::json_pointer("/context/includeDeclaration"), true);
  return references_at(view, offset_in(view, params.at("position")),
                       declaration);
}

Json Server::highlight(const Json& params) {
  const View view = view_of(document_of(params));
  return highlights_at(view, offset_in(view, params.at("position")));
}

Json Server::prepare_rename(const Json& params) {
  const View view = view_of(document_of(params));
  return rename_range_at(view, offset_in(view, params.at("position")));
}

Json Server::rename(const Json& params) {
  Document& document = document_of(params);
  const View view = view_of(document);
  const auto offset = offset_in(view, params.at("position"));
  Rename renamed = rename_at(
      view, offset, params.at("newName").get<std::string>(), document.options);
  if (!renamed.refusal.empty()) {
    throw Refusal{kRequestFailed, std::move(renamed.refusal)};
  }
  return std::move(renamed.edit);
}

Json Server::code_action(const Json& params) {
  const View view = view_of(document_of(params));
  const Json& range = params.at("range");
  return code_actions_in(
      view, {view.snapshot.file, offset_in(view, range.at("start")),
             offset_in(view, range.at("end"))});
}

}  // namespace rung::lsp
