#pragma once

#include <cstdio>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace rung::lsp {

/// Only .cpp files and this folder's headers include it: it is slow to compile.
using Json = nlohmann::json;

/// Codes of JSON-RPC and of the protocol.
inline constexpr int kParseError = -32700;
inline constexpr int kInvalidRequest = -32600;
inline constexpr int kMethodNotFound = -32601;
inline constexpr int kInvalidParams = -32602;
inline constexpr int kInternalError = -32603;
inline constexpr int kNotInitialized = -32002;
inline constexpr int kRequestCancelled = -32800;
inline constexpr int kContentModified = -32801;
inline constexpr int kRequestFailed = -32803;

/// What the server says, from any of its threads: whole messages, one after
/// the other.
class Outbox {
 public:
  explicit Outbox(std::FILE* out) : out_(out) {}

  void answer(const Json& id, Json result);
  void fail(const Json& id, int code, std::string_view message);
  void notify(std::string_view method, Json params);
  /// Its answer is of no interest.
  void request(std::string_view method, Json params);

 private:
  void send(const Json& message);

  std::FILE* out_;
  std::mutex mutex_;
  std::uint64_t next_id_ = 1;
};

}  // namespace rung::lsp
