#include "app/lsp/framing.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace rung::lsp {
namespace {

constexpr std::string_view kLength = "content-length:";

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool starts_with_length(std::string_view line) {
  return line.size() >= kLength.size() &&
         std::equal(kLength.begin(), kLength.end(), line.begin(),
                    [](char a, char b) { return a == lower(b); });
}

/// Where the first one stands; the end: nowhere.
std::size_t find_length(std::string_view text) {
  const auto found =
      std::search(text.begin(), text.end(), kLength.begin(), kLength.end(),
                  [](char a, char b) { return lower(a) == b; });
  return static_cast<std::size_t>(found - text.begin());
}

/// The value of `Content-Length`; nothing when it is missing or no number.
std::optional<std::size_t> length_in(std::string_view header) {
  std::optional<std::size_t> length;
  while (!header.empty()) {
    const std::size_t end = std::min(header.find('\n'), header.size());
    std::string_view line = header.substr(0, end);
    header.remove_prefix(std::min(end + 1, header.size()));
    if (!starts_with_length(line)) continue;
    line.remove_prefix(kLength.size());
    while (line.starts_with(' ')) line.remove_prefix(1);
    while (line.ends_with('\r') || line.ends_with(' ')) line.remove_suffix(1);
    std::size_t value = 0;
    const auto [behind, error] =
        std::from_chars(line.data(), line.data() + line.size(), value);
    if (error != std::errc{} || behind != line.data() + line.size()) return {};
    length = value;
  }
  return length;
}

/// Where the body begins; npos while the header is not whole.
std::size_t header_end(std::string_view text) {
  const std::size_t end = text.find("\r\n\r\n");
  const std::size_t bare = text.find("\n\n");  // sent by hand
  if (end == std::string_view::npos && bare == std::string_view::npos) {
    return std::string_view::npos;
  }
  return end < bare ? end + 4 : bare + 2;
}

}  // namespace

void MessageReader::feed(std::string_view bytes) {
  if (used_ > buffer_.size() / 2) {
    buffer_.erase(0, used_);
    used_ = 0;
  }
  const std::size_t dropped = std::min(skip_, bytes.size());
  skip_ -= dropped;
  buffer_.append(bytes.substr(dropped));
}

std::optional<MessageReader::Message> MessageReader::next() {
  return body_ ? read_body() : read_header();
}

std::optional<MessageReader::Message> MessageReader::read_body() {
  if (rest().size() < *body_) return std::nullopt;
  Message message{std::string(rest().substr(0, *body_)), ""};
  used_ += *body_;
  body_.reset();
  return message;
}

/// No header ends here: everything up to what looks like one is dropped.
void MessageReader::drop_lost(std::string_view text) {
  const std::size_t found = find_length(text.substr(1)) + 1;
  // What may be the beginning of one stays.
  used_ += found == text.size()
               ? text.size() - std::min(text.size() - 1, kLength.size())
               : found;
}

std::optional<MessageReader::Message> MessageReader::read_header() {
  std::size_t begin = header_end(rest().substr(0, kMaxHeader));
  while (begin == std::string_view::npos) {
    if (rest().size() < kMaxHeader) return std::nullopt;
    drop_lost(rest());
    if (!std::exchange(lost_, true)) {
      return Message{"", "the header is longer than 8192 bytes"};
    }
    begin = header_end(rest().substr(0, kMaxHeader));
  }
  std::string_view header = rest().substr(0, begin);
  // Behind bytes that were no header it need not begin a line.
  if (lost_) header.remove_prefix(find_length(header));
  const std::optional<std::size_t> length = length_in(header);
  used_ += begin;
  lost_ = false;
  if (!length) return Message{"", "the header has no valid Content-Length"};
  if (*length > kMaxBody) {
    const std::size_t here = std::min(*length, rest().size());
    used_ += here;
    skip_ = *length - here;
    return Message{"", "the message is longer than 64 MiB"};
  }
  body_ = *length;
  return read_body();
}

std::string frame(std::string_view body) {
  return "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
         std::string(body);
}

}  // namespace rung::lsp
