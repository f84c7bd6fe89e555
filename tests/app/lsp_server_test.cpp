// The language server on messages that no client sends.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <map>
#include <random>
#include <string>

#include "app/lsp/framing.h"
#include "app/lsp/server.h"

namespace rung::lsp {
namespace {

/// A server, and what it said.
class Session {
 public:
  Session() : out_(std::tmpfile()), server_(new Server(options_, out_)) {}
  ~Session() {
    server_.reset();
    std::fclose(out_);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void send(const Json& message) { server_->receive(message.dump()); }
  void send_text(const std::string& body) { server_->receive(body); }
  std::optional<int> exit() const { return server_->exit(); }

  void initialize() {
    send({{"id", 0}, {"method", "initialize"}, {"params", Json::object()}});
  }
  void open(const std::string& text) {
    send({{"method", "textDocument/didOpen"},
          {"params",
           {{"textDocument",
             {{"uri", "untitled:x"}, {"version", 1}, {"text", text}}}}}});
  }

  /// The messages so far; workers may say more later.
  std::vector<Json> said() {
    std::fflush(out_);
    std::string bytes(std::size_t{1} << 24, '\0');
    // Not through the stream: a worker may be writing to it.
    const ssize_t size = ::pread(::fileno(out_), bytes.data(), bytes.size(), 0);
    bytes.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    MessageReader reader;
    reader.feed(bytes);
    std::vector<Json> all;
    while (const auto message = reader.next()) {
      all.push_back(Json::parse(message->body));
    }
    return all;
  }

  /// The code of the error that answers `id`; 0: it was answered without one.
  int error_of(const Json& id) {
    for (const Json& message : said()) {
      if (message.value("id", Json()) != id || message.contains("method")) {
        continue;
      }
      return message.contains("error") ? message["error"]["code"].get<int>()
                                       : 0;
    }
    ADD_FAILURE() << id << " was not answered";
    return 1;
  }

 private:
  Options options_;
  std::FILE* out_;
  std::unique_ptr<Server> server_;
};

TEST(LspServer, RefusesWhatIsNoRequest) {
  const std::pair<std::string, int> kMessages[] = {
      {"", kParseError},
      {"{", kParseError},
      {"{} {}", kParseError},
      {"\xff\xfe", kParseError},
      {std::string(100000, '['), kParseError},
      {"{\"id\":" + std::string(90, '[') + std::string(90, ']') + "}",
       kParseError},
      {"[]", kInvalidRequest},
      {"[1, 2]", kInvalidRequest},
      {"3", kInvalidRequest},
      {"null", kInvalidRequest},
      {"{}", kInvalidRequest},
      {R"({"method": 3})", kInvalidRequest},
      {R"({"method": "initialize", "id": {"a": 1}})", kInvalidRequest},
      {R"({"method": "initialize", "id": [1]})", kInvalidRequest},
  };
  for (const auto& [body, code] : kMessages) {
    Session session;
    session.send_text(body);
    EXPECT_EQ(session.error_of(nullptr), code) << body.substr(0, 40);
  }
}

TEST(LspServer, KeepsTheOrderOfItsLife) {
  Session session;
  session.send({{"id", 1}, {"method", "textDocument/hover"}});
  EXPECT_EQ(session.error_of(1), kNotInitialized);
  session.initialize();
  EXPECT_EQ(session.error_of(0), 0);
  session.send({{"id", 2}, {"method", "initialize"}});
  EXPECT_EQ(session.error_of(2), kInvalidRequest);
  session.send({{"id", 3}, {"method", "textDocument/dance"}});
  EXPECT_EQ(session.error_of(3), kMethodNotFound);
  session.send({{"method", "textDocument/dance"}});
  session.send({{"id", 4}, {"method", "shutdown"}});
  EXPECT_EQ(session.error_of(4), 0);
  session.send({{"id", 5}, {"method", "textDocument/hover"}});
  EXPECT_EQ(session.error_of(5), kInvalidRequest);
  EXPECT_FALSE(session.exit());
  session.send({{"method", "exit"}});
  EXPECT_EQ(session.exit(), 0);
  Session rude;
  rude.send({{"method", "exit"}});
  EXPECT_EQ(rude.exit(), 1);
}

TEST(LspServer, RefusesParametersOfAnotherKind) {
  const char* const kParams[] = {
      "null",
      "[]",
      "3",
      "{}",
      R"({"textDocument": 3})",
      R"({"textDocument": {"uri": 3}})",
      R"({"textDocument": {"uri": "file:///not-open"}})",
      R"({"textDocument": {"uri": "untitled:x"}})",
      R"({"textDocument": {"uri": "untitled:x"}, "position": {"line": -1}})",
      R"({"textDocument": {"uri": "untitled:x"},
          "position": {"line": "0", "character": 0}})"};
  int id = 1;
  Session session;
  session.initialize();
  session.open("Q0 = I0;");
  for (const char* const params : kParams) {
    session.send({{"id", ++id},
                  {"method", "textDocument/definition"},
                  {"params", Json::parse(params)}});
    EXPECT_EQ(session.error_of(id), kInvalidParams) << params;
    session.send({{"id", ++id},
                  {"method", "workspace/executeCommand"},
                  {"params", Json::parse(params)}});
    EXPECT_EQ(session.error_of(id), kInvalidParams) << params;
  }
}

TEST(LspServer, PositionsPastTheEndAreAnswered) {
  Session session;
  session.initialize();
  session.open("Q0 = I0;");
  session.send(
      {{"id", 1},
       {"method", "textDocument/hover"},
       {"params",
        {{"textDocument", {{"uri", "untitled:x"}}},
         {"position", {{"line", 4294967295U}, {"character", 4294967295U}}}}}});
  EXPECT_EQ(session.error_of(1), 0);
}

/// Puts another value in some place of a message.
void disturb(Json& json, std::mt19937& random) {
  Json* at = &json;
  while (at->is_structured() && !at->empty() && random() % 4 != 0) {
    auto it = at->begin();
    std::advance(it, random() % at->size());
    at = &*it;
  }
  const Json kValues[] = {
      nullptr,        -1,   1e300,        "", "untitled:x", Json::array(),
      Json::object(), true, 4294967296ULL};
  *at = kValues[random() % 9];
}

TEST(LspServer, AnswersEveryDisturbedRequestOnce) {
  const Json kRequests[] = {
      {{"method", "textDocument/didChange"},
       {"params",
        {{"textDocument", {{"uri", "untitled:x"}, {"version", 2}}},
         {"contentChanges",
          {{{"range",
             {{"start", {{"line", 0}, {"character", 1}}},
              {"end", {{"line", 0}, {"character", 2}}}}},
            {"text", "0 = I1; Q"}}}}}}},
      {{"method", "textDocument/rename"},
       {"params",
        {{"textDocument", {{"uri", "untitled:x"}}},
         {"position", {{"line", 0}, {"character", 1}}},
         {"newName", "Q3"}}}},
      {{"method", "textDocument/codeAction"},
       {"params",
        {{"textDocument", {{"uri", "untitled:x"}}},
         {"range",
          {{"start", {{"line", 0}, {"character", 0}}},
           {"end", {{"line", 9}, {"character", 0}}}}}}}},
      {{"method", "workspace/executeCommand"},
       {"params",
        {{"command", "rungproof.showCounterexample"},
         {"arguments", {"untitled:x", "p"}}}}},
      {{"method", "$/cancelRequest"}, {"params", {{"id", 3}}}},
  };
  std::mt19937 random(7);
  Session session;
  session.initialize();
  session.open("Q0 = I0; //@ p: never Q0\n");
  for (int id = 1; id <= 400; ++id) {
    Json request = kRequests[random() % 5];
    disturb(request["params"], random);
    request["id"] = id;
    session.send(request);
  }
  std::map<int, int> answers;
  for (const Json& message : session.said()) {
    if (message.contains("method") || !message["id"].is_number()) continue;
    ++answers[message["id"].get<int>()];
  }
  for (int id = 1; id <= 400; ++id) EXPECT_EQ(answers[id], 1) << id;
}

}  // namespace
}  // namespace rung::lsp
