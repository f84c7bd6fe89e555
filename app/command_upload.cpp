#include <fmt/format.h>

#include "app/commands.h"
#include "app/controller.h"
#include "app/link_client.h"
#include "app/output.h"
#include "app/session.h"
#include "app/translation.h"
#include "backend/postfix/lower.h"

namespace rung {
namespace {

/// The program in the bytes that a controller executes, once they are proved
/// to be the program; else an exit code.
std::variant<std::string, int> lowered(Session& session) {
  const Options& options = session.options();
  Loaded loaded = session.load(session.inputs().front());
  if (!loaded.program) {
    return print_input_errors(session.sources(), loaded.report, options);
  }
  DiagnosticList found;
  std::optional<std::string> bytes =
      lower_to_postfix_binary(*loaded.program, found);
  loaded.report.findings = found.take();
  print_input_errors(session.sources(), loaded.report, options);  // and notes
  if (!bytes) return kExitUsage;
  const Validation validation =
      validate_translation(*loaded.program, *bytes, options);
  if (validation.status == 0) return std::move(*bytes);
  return unproved(validation, "it is not sent");
}

/// What the board would say, before anything is sent.
std::string too_large(const std::string& program, const Board& board) {
  if (program.size() > board.capacity) {
    return fmt::format(
        "the program has {} bytes, and the board `{}` takes {} at most",
        program.size(), board.name, board.capacity);
  }
  const std::uint32_t words = LoadedMachine::memory_words(program);
  if (words > board.memory_words) {
    return fmt::format(
        "the program needs {} bytes of memory, and the board `{}` has {}",
        4 * std::uint64_t{words}, board.name,
        4 * std::uint64_t{board.memory_words});
  }
  return "";
}

int send(const std::string& program, const Options& options) {
  Connection connection = connect(options);
  if (!connection.client) return link_error(connection.failure);
  const Board& board = connection.board;
  const std::string large = too_large(program, board);
  if (!large.empty()) return link_error({kExitBoard, large});
  Progress progress(options.detail != TextOptions::Detail::Quiet);
  const bool done = connection.client->upload(
      program, options.clear_outputs, [&](std::size_t sent) {
        progress.show(fmt::format("{}: {} of {} bytes", board.name, sent,
                                  program.size()));
      });
  if (!done) return link_error(connection.client->failure());
  if (options.detail == TextOptions::Detail::Quiet) return 0;
  const bool stores = (board.flags & rungproof::kLinkStores) != 0;
  return print_out(fmt::format(
             "{}: runs {} of {} bytes, {}\n", board.name,
             options.files.front() == "-" ? "a program" : options.files.front(),
             program.size(),
             stores ? "and keeps it without power"
                    : "until its power goes: it has no storage"))
             ? 0
             : kExitUsage;
}

}  // namespace

int run_upload(const Options& options) {
  if (const auto error = check_connection(options)) return usage_error(*error);
  if (!options.formats.empty()) return usage_error("upload has no --format");
  Session session(options);
  if (session.error()) return usage_error(*session.error());
  if (session.inputs().size() != 1) {
    return usage_error("upload takes one program, and a directory is none");
  }
  const std::variant<std::string, int> program = lowered(session);
  if (const int* status = std::get_if<int>(&program)) return *status;
  return send(std::get<std::string>(program), options);
}

}  // namespace rung
