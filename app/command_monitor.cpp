#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include "app/board_image.h"
#include "app/commands.h"
#include "app/link_client.h"
#include "app/output.h"

namespace rung {
namespace {

using Clock = std::chrono::steady_clock;
using rungproof::Command;

// Monitor mode ends where the host is silent for ten seconds.
constexpr std::chrono::seconds kRenewal(2);
constexpr std::chrono::milliseconds kRedraw(100);
constexpr int kPollMs = 200;

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

enum class View : std::uint8_t { Json, Lines, Table };

/// Shows images until it was asked to stop: what run_monitor is about.
class Monitor {
 public:
  Monitor(LinkClient& client, const Options& options, View view)
      : client_(client), options_(options), view_(view), image_("") {}

  /// An exit code.
  int run(const Board& board);

 private:
  bool enough() const {
    return interrupted != 0 || (options_.scans && shown_ >= *options_.scans);
  }
  bool open(const Board& board);
  bool renew();
  bool show();
  int failed();

  LinkClient& client_;
  const Options& options_;
  View view_;
  BoardImage image_;
  std::uint32_t checksum_ = 0;
  std::uint64_t shown_ = 0;
  std::size_t lines_ = 0;  // of the table that stands on the terminal
  Clock::time_point renewal_;
  Clock::time_point redraw_;
  int status_ = 0;
};

int Monitor::failed() { return link_error(client_.failure()); }

bool Monitor::open(const Board& board) {
  const auto program = client_.read_program(board);
  if (!program) {
    status_ = failed();
    return false;
  }
  image_ = BoardImage(*program);
  checksum_ = board.running_checksum;
  lines_ = 0;
  return true;
}

/// Tells the board that somebody looks, and looks at what it does.
bool Monitor::renew() {
  renewal_ = Clock::now() + kRenewal;
  const auto status = client_.ask(Command::Status, "");
  const auto on = client_.ask(Command::Monitor, "\1");
  if (!status || !on) {
    status_ = failed();
    return false;
  }
  const std::string& body = status->body;
  if (body.size() < 22) return true;
  const auto flags = static_cast<std::uint8_t>(body[0]);
  if ((flags & rungproof::kLinkStopped) != 0) {
    usage_error(fmt::format("the program has stopped: {} (at byte {})",
                            fault_words(static_cast<std::uint8_t>(body[1])),
                            frame_number_at(body, 2)));
    status_ = kExitBoard;
    return false;
  }
  if (frame_number_at(body, 18) == checksum_) return true;
  const auto board = client_.hello();  // another program has come
  if (board) return open(*board);
  status_ = failed();
  return false;
}

bool Monitor::show() {
  if (view_ == View::Json) return print_out(image_json(image_));
  if (view_ == View::Lines) return print_out(image_line(image_));
  const auto now = Clock::now();
  if (now < redraw_ && !enough()) return true;
  redraw_ = now + kRedraw;
  const std::string up = lines_ == 0 ? "" : fmt::format("\x1b[{}A", lines_);
  lines_ = image_.cells().size() + 1;
  return print_out(up + image_table(image_));
}

int Monitor::run(const Board& board) {
  if (!open(board)) return status_;
  while (!enough()) {
    if (Clock::now() >= renewal_ && !renew()) return status_;
    const auto frame = client_.next_image(kPollMs);
    if (!frame) return failed();
    if (frame->empty()) renewal_ = Clock::now();  // why is there none?
    if (!image_.take(*frame) || !image_.whole()) continue;
    ++shown_;
    if (!show()) {
      status_ = kExitUsage;
      break;
    }
  }
  client_.ask(Command::Monitor, std::string(1, '\0'));
  return status_;
}

std::optional<View> view_of(const Options& options) {
  const bool terminal = ::isatty(STDOUT_FILENO) != 0;
  if (options.formats.empty()) return terminal ? View::Table : View::Lines;
  const FormatRequest& request = options.formats.front();
  if (options.formats.size() > 1 || !request.path.empty()) return std::nullopt;
  if (request.format == "jsonl") return View::Json;
  if (request.format != "text") return std::nullopt;
  return terminal ? View::Table : View::Lines;
}

}  // namespace

int run_monitor(const Options& options) {
  if (const auto error = check_connection(options)) return usage_error(*error);
  const std::optional<View> view = view_of(options);
  if (!view) {
    return usage_error(
        "monitor writes the formats text and jsonl, to standard output");
  }
  Connection connection = connect(options);
  if (!connection.client) return link_error(connection.failure);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  return Monitor(*connection.client, options, *view).run(connection.board);
}

}  // namespace rung
