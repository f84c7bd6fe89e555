#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/options.h"
#include "app/port.h"
#include "rungproof_link.h"

namespace rung {

/// How the controller has introduced itself.
struct Board {
  std::string name;
  std::uint8_t flags = 0;
  std::uint32_t capacity = 0;  // bytes of a program
  std::uint32_t memory_words = 0;
  std::uint32_t running_length = 0;
  std::uint32_t running_checksum = 0;
};

struct BoardAnswer {
  rungproof::Answer answer = rungproof::Answer::Ack;
  std::string body;
};

/// What is wrong, and the exit code that it means: kExitBoard where the board
/// says no, kExitUsage where there is none that could.
struct LinkFailure {
  int status = 0;
  std::string message;
};
inline constexpr int kExitBoard = 1;
/// Prints it, and returns its exit code.
int link_error(const LinkFailure& failure);

/// The host's end of docs/link.md: one request at a time, asked again until it
/// is answered or `seconds` have passed.
class LinkClient {
 public:
  LinkClient(std::unique_ptr<Port> port, double seconds);

  /// The controller's introduction. Failures: no answer, another protocol.
  std::optional<Board> hello();
  /// Nothing on failure().
  std::optional<BoardAnswer> ask(rungproof::Command command,
                                 std::string_view body);
  /// What the controller runs, as a whole; checked against `board`.
  std::optional<std::string> read_program(const Board& board);
  /// Whether `program` runs there now, and is stored where it can be.
  /// `progress` is told how many bytes have arrived.
  bool upload(const std::string& program, bool clear,
              const std::function<void(std::size_t)>& progress);
  /// The next frame of monitor mode; empty when none comes in that time.
  std::optional<std::string> next_image(int milliseconds);

  const LinkFailure& failure() const { return failure_; }

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<BoardAnswer> fail(int status, std::string message);
  bool receive(int milliseconds);
  std::optional<std::string> answer_to(std::uint8_t sequence,
                                       std::uint8_t command, int milliseconds);
  bool send_pieces(const std::string& program,
                   const std::function<void(std::size_t)>& progress);
  std::optional<BoardAnswer> ask_until_free(rungproof::Command command,
                                            std::string_view body);
  bool accepted(const std::optional<BoardAnswer>& answer,
                const std::string& program);

  std::unique_ptr<Port> port_;
  std::chrono::milliseconds patience_;
  rungproof::FrameReader reader_;
  std::deque<std::string> answers_;
  std::deque<std::string> images_;
  std::uint8_t sequence_ = 0;
  LinkFailure failure_;
};

/// Opens what `options` name and says hello. The client is null on failure.
struct Connection {
  std::unique_ptr<LinkClient> client;
  Board board;
  LinkFailure failure;
};
Connection connect(const Options& options);
/// Why these options name no controller; nothing when they do.
std::optional<std::string> check_connection(const Options& options);

/// Four bytes of a frame, the lowest first, as `runtime/` writes them.
std::string frame_number(std::uint32_t value);
std::uint32_t frame_number_at(std::string_view bytes, std::size_t at);

/// What a controller says, in words.
std::string refusal_words(std::uint8_t refusal);
std::string fault_words(std::uint8_t fault);

}  // namespace rung
