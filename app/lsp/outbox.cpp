#include "app/lsp/outbox.h"

#include "app/lsp/framing.h"

namespace rung::lsp {

void Outbox::send(const Json& message) {
  const std::string bytes =
      frame(message.dump(-1, ' ', false, Json::error_handler_t::replace));
  const std::lock_guard<std::mutex> lock(mutex_);
  // A client that reads no more is told nothing more.
  (void)std::fwrite(bytes.data(), 1, bytes.size(), out_);
  (void)std::fflush(out_);
}

void Outbox::answer(const Json& id, Json result) {
  send({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}});
}

void Outbox::fail(const Json& id, int code, std::string_view message) {
  send({{"jsonrpc", "2.0"},
        {"id", id},
        {"error", {{"code", code}, {"message", message}}}});
}

void Outbox::notify(std::string_view method, Json params) {
  send({{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}});
}

void Outbox::request(std::string_view method, Json params) {
  std::string id;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    id = "rungproof-" + std::to_string(next_id_++);
  }
  send({{"jsonrpc", "2.0"},
        {"id", id},
        {"method", method},
        {"params", std::move(params)}});
}

}  // namespace rung::lsp
