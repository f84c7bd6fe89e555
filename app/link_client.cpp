#include "app/link_client.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>

#include "base/postfix_format.h"
#include "reports/unicode.h"

namespace rung {
namespace {

using rungproof::Answer;
using rungproof::Command;
using std::chrono::milliseconds;

// A frame of 64 bytes takes 67 ms at 9600 baud, there and back twice that.
constexpr int kTryMs = 300;
constexpr int kBusyMs = 20;
// EEPROM of AVR: 3.4 ms a byte; a store of 64 KiB would take four minutes.
constexpr std::chrono::minutes kStoring(5);
constexpr std::size_t kPiece = rungproof::kFrameContent - 6;
constexpr std::uint32_t kMostProgram = 1U << 20;
constexpr std::size_t kMostImages = 4096;
constexpr std::size_t kHelloBytes = 18;

std::uint8_t byte_of(char value) { return static_cast<std::uint8_t>(value); }

std::string frame_of(std::string_view content) {
  rungproof::FrameWriter writer;
  std::transform(content.begin(), content.end(), writer.content(), byte_of);
  writer.send(static_cast<std::uint8_t>(content.size()));
  std::string bytes;
  for (std::int16_t byte = writer.next(); byte >= 0; byte = writer.next()) {
    bytes += static_cast<char>(byte);
  }
  return bytes;
}

std::string checksum_of(const std::string& program) {
  return program.substr(postfix::ChecksumField, 4);
}

std::string answer_words(const BoardAnswer& answer) {
  switch (answer.answer) {
    case Answer::Ack:
      return "it agrees";
    case Answer::UnknownCommand:
      return "it does not know the command";
    case Answer::Malformed:
      return "it does not understand the request";
    case Answer::TooLarge:
      return "the program is too large for it";
    case Answer::NoUpload:
      return "it has given the upload up";
    case Answer::OutOfOrder:
      return "a piece of the program is missing";
    case Answer::Incomplete:
      return "the program has not arrived as a whole";
    case Answer::Refused:
      return "it refuses the program";
    case Answer::Busy:
      return "it is storing a program";
    case Answer::NotStored:
      return "the program runs, but its storage did not hold it: after a power "
             "cut the one before runs again";
  }
  return fmt::format("answer {}", static_cast<int>(answer.answer));
}

/// The signal that a refusal speaks of, where its place is that of a name.
std::string named_at(const std::string& program, std::uint32_t at) {
  if (at >= program.size()) return "";
  const std::size_t size = byte_of(program[at]);
  if (size == 0 || size > program.size() - at - 1) return "";
  return fmt::format(": `{}`", printable(program.substr(at + 1, size)));
}

std::string refusal_message(const std::string& program,
                            const BoardAnswer& answer) {
  if (answer.body.size() < 5) return "the board refuses the program";
  const std::uint8_t refusal = byte_of(answer.body[0]);
  const std::uint32_t at = frame_number_at(answer.body, 1);
  const bool pin = refusal >= static_cast<int>(rungproof::Refusal::NoPin);
  return fmt::format(
      "the board refuses the program: {}{} (refusal {} at byte {})",
      refusal_words(refusal), pin ? named_at(program, at) : "", refusal, at);
}

}  // namespace

int link_error(const LinkFailure& failure) {
  usage_error(failure.message);
  return failure.status;
}

std::string frame_number(std::uint32_t value) {
  std::uint8_t bytes[4];
  rungproof::put32(bytes, value);
  return {bytes, bytes + 4};
}

std::uint32_t frame_number_at(std::string_view bytes, std::size_t at) {
  std::uint8_t four[4] = {};
  for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i) {
    four[i] = byte_of(bytes[at + i]);
  }
  return rungproof::get32(four);
}

LinkClient::LinkClient(std::unique_ptr<Port> port, double seconds)
    : port_(std::move(port)),
      patience_(static_cast<std::int64_t>(seconds * 1000)) {}

std::optional<BoardAnswer> LinkClient::fail(int status, std::string message) {
  failure_ = {status, std::move(message)};
  return std::nullopt;
}

bool LinkClient::receive(int wait) {
  const std::optional<std::string> bytes = port_->read(wait);
  if (!bytes) {
    fail(kExitUsage, "the port is gone: " + port_->error());
    return false;
  }
  for (const char byte : *bytes) {
    if (!reader_.put(byte_of(byte)) || reader_.size() < 3) continue;
    std::string content(reader_.content(), reader_.content() + reader_.size());
    const bool image = byte_of(content[1]) == rungproof::kImage;
    std::deque<std::string>& queue = image ? images_ : answers_;
    queue.push_back(std::move(content));
    if (queue.size() > kMostImages) queue.pop_front();
  }
  return true;
}

/// Empty: there was none in time. No value: the port is gone.
std::optional<std::string> LinkClient::answer_to(std::uint8_t sequence,
                                                 std::uint8_t command,
                                                 int wait) {
  const auto end = Clock::now() + milliseconds(wait);
  for (;;) {
    while (!answers_.empty()) {
      std::string content = std::move(answers_.front());
      answers_.pop_front();
      if (byte_of(content[0]) == sequence &&
          byte_of(content[1]) == (command | rungproof::kAnswerBit)) {
        return content;
      }
    }
    const auto left =
        std::chrono::duration_cast<milliseconds>(end - Clock::now());
    if (left.count() <= 0) return "";
    if (!receive(static_cast<int>(left.count()))) return std::nullopt;
  }
}

std::optional<BoardAnswer> LinkClient::ask(Command command,
                                           std::string_view body) {
  const std::uint8_t sequence = ++sequence_;
  const auto number = static_cast<std::uint8_t>(command);
  std::string content = {static_cast<char>(sequence),
                         static_cast<char>(number)};
  content += body;
  const std::string bytes = frame_of(content);
  const auto end = Clock::now() + patience_;
  do {
    if (!port_->write(bytes)) {
      return fail(kExitUsage, "the port is gone: " + port_->error());
    }
    const auto answer = answer_to(
        sequence, number,
        static_cast<int>(std::min<std::int64_t>(kTryMs, patience_.count())));
    if (!answer) return std::nullopt;
    if (!answer->empty()) {
      return BoardAnswer{static_cast<Answer>(byte_of((*answer)[2])),
                         answer->substr(3)};
    }
  } while (Clock::now() < end);
  return fail(kExitUsage,
              fmt::format("no answer in {} s: is it the right port and speed, "
                          "and a controller that takes programs?",
                          static_cast<double>(patience_.count()) / 1000));
}

std::optional<Board> LinkClient::hello() {
  const auto answer = ask(Command::Hello, "");
  if (!answer) return std::nullopt;
  const std::string& body = answer->body;
  if (!body.empty() && byte_of(body[0]) != rungproof::kLinkProtocol) {
    fail(kExitUsage,
         fmt::format("the board speaks version {} of the protocol, and this "
                     "program version {}",
                     byte_of(body[0]), rungproof::kLinkProtocol));
    return std::nullopt;
  }
  if (answer->answer != Answer::Ack || body.size() < kHelloBytes) {
    fail(kExitUsage, "the board does not introduce itself");
    return std::nullopt;
  }
  Board board;
  board.flags = byte_of(body[1]);
  board.capacity = frame_number_at(body, 2);
  board.memory_words = frame_number_at(body, 6);
  board.running_length = frame_number_at(body, 10);
  board.running_checksum = frame_number_at(body, 14);
  board.name = printable(body.substr(kHelloBytes));
  return board;
}

std::optional<std::string> LinkClient::read_program(const Board& board) {
  if (board.running_length > kMostProgram) {
    fail(kExitUsage, "the board says that it runs more than 1 MiB");
    return std::nullopt;
  }
  std::string program;
  while (program.size() < board.running_length) {
    const auto at = static_cast<std::uint32_t>(program.size());
    const auto answer = ask(Command::Read, frame_number(at));
    if (!answer) return std::nullopt;
    if (answer->answer != Answer::Ack || answer->body.size() <= 4 ||
        frame_number_at(answer->body, 0) != at) {
      fail(kExitUsage, "the board does not show its program");
      return std::nullopt;
    }
    program += answer->body.substr(4);
  }
  if (program.size() < postfix::kHeaderBytes ||
      frame_number_at(program, postfix::ChecksumField) !=
          board.running_checksum ||
      postfix::checksum(program) != board.running_checksum) {
    fail(kExitUsage, board.running_length == 0
                         ? "the board runs no program"
                         : "the board has changed its program meanwhile");
    return std::nullopt;
  }
  return program;
}

bool LinkClient::accepted(const std::optional<BoardAnswer>& answer,
                          const std::string& program) {
  if (!answer) return false;
  if (answer->answer == Answer::Ack) return true;
  if (answer->answer == Answer::Refused) {
    fail(kExitBoard, refusal_message(program, *answer));
  } else {
    fail(kExitBoard, "the board: " + answer_words(*answer));
  }
  return false;
}

bool LinkClient::upload(const std::string& program, bool clear,
                        const std::function<void(std::size_t)>& progress) {
  const auto length = static_cast<std::uint32_t>(program.size());
  const std::string body = frame_number(length) + checksum_of(program) +
                           std::string(1, clear ? '\1' : '\0');
  return accepted(ask_until_free(Command::Begin, body), program) &&
         send_pieces(program, progress) &&
         accepted(ask_until_free(Command::Commit, checksum_of(program)),
                  program);
}

bool LinkClient::send_pieces(const std::string& program,
                             const std::function<void(std::size_t)>& progress) {
  std::size_t sent = 0;
  while (sent < program.size()) {
    const auto answer =
        ask(Command::Data, frame_number(static_cast<std::uint32_t>(sent)) +
                               program.substr(sent, kPiece));
    if (!accepted(answer, program)) return false;
    const std::size_t arrived = frame_number_at(answer->body, 0);
    if (arrived <= sent || arrived > program.size()) {
      fail(kExitUsage, "the board counts the bytes of the program otherwise");
      return false;
    }
    sent = arrived;
    progress(sent);
  }
  return true;
}

/// While a program is being stored, nothing else can be begun.
std::optional<BoardAnswer> LinkClient::ask_until_free(Command command,
                                                      std::string_view body) {
  const auto end = Clock::now() + kStoring;
  for (;;) {
    auto answer = ask(command, body);
    const bool busy = answer && answer->answer == Answer::Busy;
    if (!busy || Clock::now() > end) return answer;
    if (!receive(kBusyMs)) return std::nullopt;
  }
}

std::optional<std::string> LinkClient::next_image(int wait) {
  if (images_.empty() && !receive(wait)) return std::nullopt;
  if (images_.empty()) return "";
  std::string image = std::move(images_.front());
  images_.pop_front();
  return image;
}

std::optional<std::string> check_connection(const Options& options) {
  if (options.port.empty() == options.tcp.empty()) {
    return options.command + " needs --port PORT or --tcp HOST:PORT";
  }
  return std::nullopt;
}

Connection connect(const Options& options) {
  // A peer that has gone is an error of write(), and said so.
  std::signal(SIGPIPE, SIG_IGN);
  Connection made;
  OpenedPort opened = options.tcp.empty()
                          ? open_serial(options.port, options.baud)
                          : open_tcp(options.tcp, options.wait);
  if (!opened.port) {
    made.failure = {kExitUsage, opened.error};
    return made;
  }
  auto client =
      std::make_unique<LinkClient>(std::move(opened.port), options.wait);
  const std::optional<Board> board = client->hello();
  if (!board) {
    const std::string& where = options.tcp.empty() ? options.port : options.tcp;
    made.failure = {client->failure().status,
                    where + ": " + client->failure().message};
    return made;
  }
  made.board = *board;
  made.client = std::move(client);
  return made;
}

}  // namespace rung
