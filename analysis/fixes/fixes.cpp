#include "analysis/fixes/fixes.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "analysis/fixes/source_edits.h"

namespace rung {
namespace {

using Fixes = std::vector<Fix>;

std::string quoted(std::string_view text) {
  constexpr std::size_t kMost = 60;
  if (text.size() > kMost || text.find('\n') != text.npos) return "it";
  return "`" + std::string(text) + "`";
}

std::string name_of(const SourceEdits& source, RungId rung) {
  const Program& program = source.program();
  return "`" + program.cells[program.rungs[rung].target].name + "`";
}

void add(Fixes& fixes, std::string title, std::optional<Edit> edit) {
  if (edit) fixes.push_back({std::move(title), {std::move(*edit)}});
}

Fixes remove_operand(const SourceEdits& source, const Diagnostic& finding) {
  Fixes fixes;
  add(fixes, "remove " + quoted(source.text(finding.where)),
      source.remove_operand(source.node_at(finding.where)));
  return fixes;
}

Fixes remove_rung(const SourceEdits& source, const Diagnostic& finding) {
  Fixes fixes;
  const RungId rung = source.rung_at(finding.where);
  if (!rung.has_value()) return fixes;
  add(fixes, "remove the rung of " + name_of(source, rung),
      source.remove_rung(rung));
  return fixes;
}

/// Every rung of a cell that nothing reads.
Fixes remove_writers(const SourceEdits& source, const Diagnostic& finding) {
  const Program& program = source.program();
  const RungId first = source.rung_at(finding.where);
  if (!first.has_value()) return {};
  Fix fix{"remove " + name_of(source, first), {}};
  for (const std::uint32_t rung : source.writers(program.rungs[first].target)) {
    std::optional<Edit> edit = source.remove_rung(RungId(rung));
    if (!edit) return {};
    fix.edits.push_back(std::move(*edit));
  }
  return {std::move(fix)};
}

Fixes follow_first(const SourceEdits& source, const Diagnostic& finding) {
  Fixes fixes;
  if (finding.labels.empty()) return fixes;
  const RungId first = source.rung_at(finding.labels.front().where);
  const auto value = source.value_of(source.rung_at(finding.where));
  if (!first.has_value() || !value) return fixes;
  const Program& program = source.program();
  const std::string& name = program.cells[program.rungs[first].target].name;
  add(fixes, "write `" + name + "` instead", Edit{*value, name});
  return fixes;
}

/// One of the two is enough, where that is proved; else both may be meant.
Fixes merge_coils(const SourceEdits& source, const Diagnostic& finding) {
  Fixes fixes;
  if (finding.labels.empty()) return fixes;
  const RungId later = source.rung_at(finding.where);
  const RungId earlier = source.rung_at(finding.labels.front().where);
  if (!later.has_value() || !earlier.has_value()) return fixes;
  const std::string name = name_of(source, later);
  const auto removal = source.remove_rung(earlier);
  add(fixes, "remove the earlier rung of " + name, removal);
  add(fixes, "remove the later rung of " + name, source.remove_rung(later));
  const auto one = source.value_of(earlier);
  const auto two = source.value_of(later);
  const Program& program = source.program();
  const bool bits =
      program.cells[program.rungs[later].target].type == Type::Bit;
  if (!removal || !one || !two || !bits) return fixes;
  const std::string_view sign = program.language == "st" ? " OR " : " || ";
  const auto in_parentheses = [&](SourceRange where) {
    return "(" + std::string(source.text(where)) + ")";
  };
  fixes.push_back(
      {"merge both rungs of " + name + " into one",
       {*removal, Edit{*two, in_parentheses(*one) + std::string(sign) +
                                 in_parentheses(*two)}}});
  return fixes;
}

bool is_literal(std::string_view text, bool& value) {
  constexpr std::array<std::pair<std::string_view, bool>, 6> kLiterals = {
      {{"true", true},
       {"false", false},
       {"TRUE", true},
       {"FALSE", false},
       {"1", true},
       {"0", false}}};
  for (const auto& [word, meaning] : kLiterals) {
    if (text != word) continue;
    value = meaning;
    return true;
  }
  return false;
}

/// `x == true` becomes `x`, `x == false` becomes `!x`.
Fixes without_literal(const SourceEdits& source, const Diagnostic& finding) {
  constexpr std::array<std::pair<std::string_view, bool>, 6> kSigns = {
      {{"===", true},
       {"!==", false},
       {"==", true},
       {"!=", false},
       {"<>", false},
       {"=", true}}};
  const std::string_view text = source.text(finding.where);
  for (const auto& [sign, equal] : kSigns) {
    const std::size_t at = text.find(sign);
    if (at == text.npos) continue;
    const auto part = [](std::string_view piece) {
      while (piece.starts_with(' ')) piece.remove_prefix(1);
      while (piece.ends_with(' ')) piece.remove_suffix(1);
      return piece;
    };
    std::string_view left = part(text.substr(0, at));
    std::string_view right = part(text.substr(at + sign.size()));
    bool literal = false;
    if (is_literal(left, literal)) std::swap(left, right);
    if (!is_literal(right, literal)) return {};
    const bool simple = std::all_of(left.begin(), left.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
             (c >= '0' && c <= '9') || c == '_' || c == '.' || c == '%';
    });
    const bool st = source.program().language == "st";
    std::string better =
        simple ? std::string(left) : "(" + std::string(left) + ")";
    if (literal != equal) better.insert(0, st ? "NOT " : "!");
    Fixes fixes;
    add(fixes, "write " + quoted(better), Edit{finding.where, better});
    return fixes;
  }
  return {};
}

Fixes parenthesise(const SourceEdits& source, const Diagnostic& finding) {
  const SourceRange where = finding.where;
  Fix fix{"put " + quoted(source.text(where)) + " in parentheses", {}};
  fix.edits.push_back({{where.file, where.begin, where.begin}, "("});
  fix.edits.push_back({{where.file, where.end, where.end}, ")"});
  return {std::move(fix)};
}

// --- what changes a program: never proved ------------------------------------

/// A name of the same kind that is still free: behind I0 and I3 it is I4.
std::string free_input(const Program& program) {
  std::string prefix;
  std::uint64_t number = 0;
  for (const Cell& cell : program.cells) {
    if (cell.role != CellRole::Input || cell.type != Type::Bit) continue;
    const std::size_t digits = cell.name.find_last_not_of("0123456789") + 1;
    if (digits == 0 || digits == cell.name.size() ||
        cell.name.size() - digits > 4) {
      continue;
    }
    const auto value = std::stoull(cell.name.substr(digits)) + 1;
    if (!prefix.empty() && cell.name.substr(0, digits) != prefix) continue;
    prefix = cell.name.substr(0, digits);
    number = std::max<std::uint64_t>(number, value);
  }
  const std::string name = prefix + std::to_string(number);
  const bool taken = prefix.empty() || find_cell(program, name).has_value();
  return taken ? "stop" : name;
}

Fixes add_stop(const SourceEdits& source, const Diagnostic& finding) {
  const auto value = source.value_of(source.rung_at(finding.where));
  if (!value) return {};
  const bool st = source.program().language == "st";
  const std::string stop = free_input(source.program());
  const std::string behind = st ? ") AND NOT " + stop : ") && !" + stop;
  Fix fix{"add a stop contact, `" + stop + "`", {}};
  fix.edits.push_back({{value->file, value->begin, value->begin}, "("});
  fix.edits.push_back({{value->file, value->end, value->end}, behind});
  return {std::move(fix)};
}

/// A rung behind that of the timer; its target is a memory that is free.
Fixes add_reset(const SourceEdits& source, const Diagnostic& finding) {
  const Program& program = source.program();
  if (program.dialect != "yun" || program.language != "script") return {};
  const std::uint32_t node = source.node_at(finding.where);
  if (node == SourceEdits::kNone || program.nodes[node].op != NodeOp::Call) {
    return {};
  }
  const ElementCall& call = program.calls[program.nodes[node].call];
  if (call.arguments.empty()) return {};
  const SourceRange input = program.nodes[call.arguments.back()].where;
  std::string target;
  for (int i = 0; i < 16 && target.empty(); ++i) {
    const std::string name = "y" + std::to_string(i);
    if (!find_cell(program, name).has_value()) target = name;
  }
  if (target.empty() || !input.has_value()) return {};
  const RungId rung = source.rung_around(node);
  if (!rung.has_value() || !program.rungs[rung].where.has_value()) return {};
  const std::string reset =
      "TR(" + std::to_string(program.instances[call.instance].index) + ", !(" +
      std::string(source.text(input)) + "))";
  const std::uint32_t end = source.statement_end(rung);
  Fixes fixes;
  add(fixes, "add `" + reset + "`",
      Edit{{input.file, end, end}, "\n" + target + " = " + reset + ";"});
  return fixes;
}

struct Fixer {
  std::string_view rule;
  Fixes (*make)(const SourceEdits& source, const Diagnostic& finding);
};

constexpr Fixer kFixers[] = {
    {"constant-operand", remove_operand},
    {"double-coil", merge_coils},
    {"duplicate-rung", follow_first},
    {"literal-comparison", without_literal},
    {"mixed-operators", parenthesise},
    {"overwritten-value", remove_rung},
    {"redundant-branch", remove_operand},
    {"redundant-contact", remove_operand},
    {"self-assignment", remove_rung},
    {"set-without-reset", add_stop},
    {"timer-without-reset", add_reset},
    {"written-never-read", remove_writers},
};

}  // namespace

void offer_fixes(const SourceSet& sources, const Program& program,
                 std::vector<Diagnostic>& findings) {
  if (program.language != "script" && program.language != "st") return;
  const bool any = std::any_of(
      findings.begin(), findings.end(), [](const Diagnostic& finding) {
        return std::any_of(
            std::begin(kFixers), std::end(kFixers),
            [&](const Fixer& fixer) { return fixer.rule == finding.rule; });
      });
  if (!any) return;
  // Names that are free are looked for in the whole program, for each.
  constexpr std::size_t kMostFindings = 500;
  std::size_t left = kMostFindings;
  const SourceEdits source(sources, program);
  for (Diagnostic& finding : findings) {
    if (finding.where.file != program.file || left == 0) continue;
    for (const Fixer& fixer : kFixers) {
      if (fixer.rule != finding.rule) continue;
      finding.fixes = fixer.make(source, finding);
      --left;
    }
  }
}

}  // namespace rung
