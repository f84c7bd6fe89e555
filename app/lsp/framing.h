#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rung::lsp {

/// Takes the bytes of a client apart: a header with `Content-Length`, an empty
/// line, so many bytes; and again.
///
/// Errors: what is no such message is given as one whose `error` says why; then
///         it goes on at the next header.
/// Limits: kMaxHeader and kMaxBody; a longer body is dropped as it comes in.
class MessageReader {
 public:
  static constexpr std::size_t kMaxHeader = std::size_t{1} << 13;
  static constexpr std::size_t kMaxBody = std::size_t{1} << 26;

  struct Message {
    std::string body;
    std::string error;
  };

  void feed(std::string_view bytes);
  /// The next whole message; nothing when more bytes are needed.
  std::optional<Message> next();

 private:
  std::optional<Message> read_header();
  std::optional<Message> read_body();
  void drop_lost(std::string_view text);
  std::string_view rest() const {
    return std::string_view(buffer_).substr(used_);
  }

  std::string buffer_;
  std::size_t used_ = 0;             // of the buffer
  std::optional<std::size_t> body_;  // its length, behind its header
  std::size_t skip_ = 0;             // bytes of a body that is too long
  bool lost_ = false;                // looks for a header; that was said
};

/// The same the other way round.
std::string frame(std::string_view body);

}  // namespace rung::lsp
