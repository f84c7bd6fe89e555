#include "app/packed_answer.h"

#include <utility>
#include <vector>

#include "analysis/rule.h"
#include "app/packed_result.h"

namespace rung {
namespace {

/// What is no value of its own, or in a file that another run may not have.
struct CannotPack {};

class Packer {
 public:
  explicit Packer(const AnswerFiles& files) : files_(files) {}

  Packed range(const SourceRange& where) const {
    if (!where.has_value()) return nullptr;
    if (where.file == files_.program) return {0, where.begin, where.end};
    if (where.file == files_.properties) return {1, where.begin, where.end};
    throw CannotPack();
  }

  Packed diagnostic(const Diagnostic& from) const {
    Packed labels = Packed::array();
    for (const Label& label : from.labels) {
      labels.push_back(Packed::array({range(label.where), label.text}));
    }
    Packed fixes = Packed::array();
    for (const Fix& fix : from.fixes) fixes.push_back(pack(fix));
    Packed waiver;
    if (from.waiver) {
      waiver = Packed::array({from.waiver->kind, from.waiver->reason});
    }
    return Packed::array({from.code, from.severity, range(from.where),
                          from.message, std::move(labels), from.rule, from.help,
                          std::move(fixes), std::move(waiver)});
  }

  Packed result(const ObligationResult& from) const {
    const Obligation& obligation = from.obligation;
    return Packed::array({obligation.name, obligation.kind, obligation.text,
                          range(obligation.where), obligation.goal,
                          obligation.property, obligation.part,
                          obligation.built_in, pack_result(from)});
  }

 private:
  Packed pack(const Fix& fix) const {
    Packed edits = Packed::array();
    for (const Edit& edit : fix.edits) {
      edits.push_back(Packed::array({range(edit.where), edit.text}));
    }
    return Packed::array({fix.title, std::move(edits), fix.proved});
  }

  const AnswerFiles& files_;
};

class Unpacker {
 public:
  Unpacker(const AnswerFiles& files, TextPool& texts, std::size_t cells)
      : files_(files), texts_(texts), cells_(cells) {}

  Diagnostic diagnostic(const Packed& packed) const {
    Diagnostic to;
    to.code = text(packed.at(0));
    to.severity = unpack_enum(packed.at(1), Severity::Error);
    to.where = range(packed.at(2));
    packed.at(3).get_to(to.message);
    for (const Packed& label : packed.at(4)) {
      to.labels.push_back({range(label.at(0)), label.at(1)});
    }
    to.rule = text(packed.at(5));
    to.help = text(packed.at(6));
    for (const Packed& one : packed.at(7)) to.fixes.push_back(fix(one));
    const Packed& waiver = packed.at(8);
    if (!waiver.is_null()) {
      to.waiver = {unpack_enum(waiver.at(0), Waiver::Kind::Baseline),
                   waiver.at(1)};
    }
    return to;
  }

  ObligationResult result(const Packed& packed) const {
    ObligationResult to = unpack_result(packed.at(8), cells_);
    Obligation& obligation = to.obligation;
    packed.at(0).get_to(obligation.name);
    obligation.kind = text(packed.at(1));
    packed.at(2).get_to(obligation.text);
    obligation.where = range(packed.at(3));
    obligation.goal = unpack_enum(packed.at(4), Goal::Respond);
    packed.at(5).get_to(obligation.property);
    packed.at(6).get_to(obligation.part);
    obligation.built_in = packed.at(7).get<bool>();
    return to;
  }

 private:
  std::string_view text(const Packed& packed) const {
    return texts_.keep(packed.get<std::string>());
  }
  SourceRange range(const Packed& packed) const {
    if (packed.is_null()) return {};
    const bool in_program = packed.at(0).get<int>() == 0;
    return {in_program ? files_.program : files_.properties, packed.at(1),
            packed.at(2)};
  }
  Fix fix(const Packed& packed) const {
    Fix to;
    packed.at(0).get_to(to.title);
    for (const Packed& edit : packed.at(1)) {
      to.edits.push_back({range(edit.at(0)), edit.at(1)});
    }
    to.proved = packed.at(2).get<bool>();
    return to;
  }

  const AnswerFiles& files_;
  TextPool& texts_;
  std::size_t cells_;
};

Packed pack_all(const FileReport& report, std::size_t first_note,
                const Packer& packer) {
  Packed findings = Packed::array();
  for (const Diagnostic& one : report.findings) {
    findings.push_back(packer.diagnostic(one));
  }
  Packed waived = Packed::array();
  for (const Diagnostic& one : report.waived) {
    waived.push_back(packer.diagnostic(one));
  }
  Packed results = Packed::array();
  for (const ObligationResult& one : report.results) {
    results.push_back(packer.result(one));
  }
  const std::vector<std::string> notes(
      report.notes.begin() + static_cast<std::ptrdiff_t>(first_note),
      report.notes.end());
  return Packed::array(
      {notes, std::move(findings), std::move(waived), std::move(results)});
}

}  // namespace

std::optional<std::string> pack_answer(const FileReport& report,
                                       std::size_t first_note,
                                       const AnswerFiles& files) {
  const bool is_whole = report.failures.empty() && report.replays.empty() &&
                        !report.explained && report.program;
  if (!is_whole) return std::nullopt;
  try {
    return to_bytes(pack_all(report, first_note, Packer(files)));
  } catch (const CannotPack&) {
    return std::nullopt;
  }
}

bool unpack_answer(std::string_view bytes, const AnswerFiles& files,
                   TextPool& texts, FileReport& report) {
  const Packed packed = from_bytes(bytes);
  if (packed.is_null()) return false;
  FileReport answer;
  try {
    const Unpacker unpacker(files, texts, report.program->cells.size());
    packed.at(0).get_to(answer.notes);
    for (const Packed& one : packed.at(1)) {
      answer.findings.push_back(unpacker.diagnostic(one));
    }
    for (const Packed& one : packed.at(2)) {
      answer.waived.push_back(unpacker.diagnostic(one));
    }
    for (const Packed& one : packed.at(3)) {
      answer.results.push_back(unpacker.result(one));
    }
  } catch (const std::exception&) {
    return false;
  }
  for (std::string& note : answer.notes) {
    report.notes.push_back(std::move(note));
  }
  report.findings = std::move(answer.findings);
  report.waived = std::move(answer.waived);
  report.results = std::move(answer.results);
  return true;
}

}  // namespace rung
