#include "backend/postfix/listing.h"

#include <algorithm>
#include <string>
#include <utility>

namespace rung::postfix {
namespace {

class Lister {
 public:
  Lister(const Program& program, DiagnosticSink& sink)
      : program_(program), sink_(sink) {}

  std::optional<Listing> run() {
    check_header();
    if (failed_) return std::nullopt;
    number_cells();
    check_slots();
    take_notes();
    note_plant();
    const bool coded = list_code(program_, address_, sink_, listing_.code);
    if (!coded || failed_) return std::nullopt;
    return std::move(listing_);
  }

 private:
  void fail(SourceRange where, std::string message) {
    failed_ = true;
    if (!where.has_value()) where = {program_.file, 0, 0};
    report_inexpressible(sink_, where, std::move(message));
  }

  void check_header() {
    // It says where a program came from and changes nothing: what another
    // language has that the machine has not is refused where it stands.
    const auto* found =
        std::find(kDialects.begin(), kDialects.end(), program_.dialect);
    if (found == kDialects.end()) found = kDialects.begin();
    listing_.dialect =
        static_cast<std::size_t>(std::distance(kDialects.begin(), found));
    const ScanInterval& scan = program_.scan;
    if (scan.min_ms < 0 || scan.min_ms > scan.max_ms ||
        scan.max_ms > kMaxScanMs) {
      fail({}, "a scan of " + std::to_string(scan.min_ms) + ".." +
                   std::to_string(scan.max_ms) +
                   " ms is outside the 0..2147483647 ms of the format");
    }
  }

  void number_cells() {
    address_.resize(program_.cells.size());
    for (const Type type : {Type::Bit, Type::Word}) {
      std::uint32_t count = 0;
      for (const CellId id : ids_of(program_.cells)) {
        if (program_.cells[id].type != type) continue;
        check_cell(program_.cells[id]);
        address_[id.index()] = count++;
        listing_.cells.push_back(id);
      }
      if (count > 0xffff) {
        fail({}, "more than 65535 " +
                     std::string(type == Type::Bit ? "bit" : "word") +
                     " cells: the format cannot address them");
      }
      if (type == Type::Bit) {
        listing_.bit_count = static_cast<std::uint16_t>(count);
      }
    }
  }

  void check_cell(const Cell& cell) {
    if (!is_name(cell.name)) {
      fail(cell.where,
           "the name `" + cell.name +
               "` cannot be written: 1 to 255 bytes, no quote, no control "
               "character");
    }
    const bool bit = cell.type == Type::Bit;
    const std::int64_t least = bit ? 0 : kWordMin;
    const std::int64_t most = bit ? 1 : kWordMax;
    const bool inside = bit ? cell.low == 0 && cell.high == 1
                            : cell.low >= least && cell.high <= most;
    if (!inside || cell.initial < cell.low || cell.initial > cell.high) {
      fail(cell.where, "`" + cell.name + "` starts at " +
                           std::to_string(cell.initial) + " in " +
                           std::to_string(cell.low) + ".." +
                           std::to_string(cell.high) + ": the format has " +
                           (bit ? "bits 0..1" : "words of 32 bits"));
    }
  }

  void check_slots() {
    if (program_.instances.size() > 0xffff) {
      fail({}, "more than 65535 elements: the format cannot address them");
    }
    for (const Instance& instance : program_.instances) {
      const auto kind = instance.kind->operations.front().opcode;
      if (find_kind(kind) == nullptr) {
        fail(instance.where, "the format has no element of kind `" +
                                 std::string(instance.kind->id) + "`");
      }
      if (instance.index < 0 || instance.index > kMaxIndex) {
        fail(instance.where,
             "the index of `" + instance.name + "` is outside 0..2147483647");
      }
    }
  }

  void note_plant() {
    if (program_.plant.statements.empty()) return;
    sink_.report({.code = "RP085",
                  .severity = Severity::Note,
                  .where = {program_.file, 0, 0},
                  .message = "the plant (`//Sim`) is left out: it is no part "
                             "of a controller's program"});
  }

  // `language` and `dialect` lines speak of the text that they stood in.
  void take_notes() {
    for (const AstAnnotation& note : program_.annotations) {
      const std::string_view word =
          note.text.substr(0, note.text.find_first_of(" \t"));
      if (word == "language" || word == "dialect") continue;
      if (!is_note(note.text)) {
        fail(note.where,
             "this property line cannot be written: it holds a control "
             "character, or more than 65535 bytes");
      }
      listing_.notes.push_back(note.text);
    }
  }

  const Program& program_;
  DiagnosticSink& sink_;
  Listing listing_;
  std::vector<std::uint32_t> address_;
  bool failed_ = false;
};

}  // namespace

std::optional<Listing> make_listing(const Program& program,
                                    DiagnosticSink& sink) {
  return Lister(program, sink).run();
}

void report_inexpressible(DiagnosticSink& sink, SourceRange where,
                          std::string message) {
  sink.report({.code = "RP084",
               .severity = Severity::Error,
               .where = where,
               .message = std::move(message)});
}

}  // namespace rung::postfix
