#include <fmt/format.h>

#include "analysis/rule.h"
#include "app/lsp/features.h"
#include "reports/proof_words.h"

namespace rung::lsp {
namespace {

/// In Markdown, where a backtick would end it.
std::string code(std::string_view text) { return fmt::format("`{}`", text); }

std::string_view role_of(const Cell& cell) {
  switch (cell.role) {
    case CellRole::Input:
      return "input";
    case CellRole::Output:
      return "output";
    case CellRole::Memory:
      break;
  }
  return "memory";
}

std::string proof_of(const ObligationResult& result) {
  std::string out;
  if (!result.certificate) return out;
  for (const std::string& lemma : result.certificate->lemmas) {
    out += "- " + in_words(lemma) + "\n";
  }
  return out.empty() ? out : "\nBecause in every reachable state\n" + out;
}

std::string about_property(const View& view, const Property& property) {
  std::string out =
      fmt::format("**{}**: {}\n\n", property.name, code(property.text));
  if (view.running.count(property.name) != 0) return out + "proving ...\n";
  const auto results = results_of(view, property.name);
  if (results.empty()) return out + "not proved yet\n";
  for (const ObligationResult* const it : results) {
    out += fmt::format("{}: {}\n\n", it->obligation.name,
                       status_text(*it, it->milliseconds));
    if (it->verdict == Verdict::Violated) {
      out += "```text\n" + counterexample_text(view, *it) + "```\n";
    } else {
      out += proof_of(*it);
    }
  }
  return out;
}

/// What the built-in properties of a cell say, where they were proved.
std::string about_values(const View& view, const Cell& cell) {
  std::string out;
  for (const ObligationResult& result : view.results) {
    if (!result.obligation.built_in) continue;
    if (result.obligation.name.find("." + cell.name + ".") ==
        std::string::npos) {
      continue;
    }
    out += fmt::format("\n- {}: {}", result.obligation.text,
                       status_text(result, result.milliseconds));
  }
  return out;
}

std::string about_cell(const View& view, CellId id) {
  const Cell& cell = view.snapshot.program()->cells[id];
  std::size_t reads = 0;
  std::size_t writes = 0;
  for (const Occurrence& it : view.snapshot.occurrences) {
    if (it.cell != id) continue;
    reads += it.kind == Occurrence::Kind::Read ? 1U : 0U;
    writes += it.kind == Occurrence::Kind::Write ? 1U : 0U;
  }
  const std::string type =
      cell.type == Type::Bit ? "bit"
                             : fmt::format("word, {}..{}", cell.low, cell.high);
  return fmt::format(
      "**{}**: {}, {}\n\nwritten in {} place{}, read in {}; before the first "
      "scan {}{}\n",
      cell.name, role_of(cell), type, writes, writes == 1 ? "" : "s", reads,
      cell.initial, about_values(view, cell));
}

/// What stands under a heading of the rule's page.
std::string section(const Rule& rule, std::string_view heading) {
  const std::size_t at = rule.doc.find(heading);
  if (at == std::string_view::npos) return "";
  const std::size_t begin = at + heading.size();
  const std::size_t end = rule.doc.find("\n## ", begin);
  return std::string(rule.doc.substr(begin, end - begin));
}

std::string about_finding(const Diagnostic& finding) {
  std::string out = fmt::format("**{} {}**: {}\n", finding.code, finding.rule,
                                finding.message);
  if (!finding.help.empty()) out += "\n" + finding.help + "\n";
  const Rule* const rule = find_rule(finding.code);
  if (rule == nullptr) return out;
  return out + section(*rule, "## Why it matters\n");
}

}  // namespace

Json hover_at(const View& view, std::uint32_t offset) {
  if (view.snapshot.program() == nullptr) return nullptr;
  std::vector<std::string> parts;
  Json range;
  if (const Occurrence* const name = occurrence_at(view.snapshot, offset)) {
    parts.push_back(about_cell(view, name->cell));
    range = range_of(view, name->where);
  }
  if (const auto index = property_at(view.snapshot, offset)) {
    parts.push_back(about_property(view, view.property(*index)));
    if (range.is_null()) range = range_of(view, view.property(*index).where);
  }
  for (const Diagnostic& finding : view.findings) {
    if (finding.where.begin <= offset && offset <= finding.where.end) {
      parts.push_back(about_finding(finding));
      if (range.is_null()) range = range_of(view, finding.where);
    }
  }
  if (parts.empty()) return nullptr;
  std::string text;
  for (const std::string& part : parts) {
    text += (text.empty() ? "" : "\n---\n\n") + part;
  }
  return {{"contents", {{"kind", "markdown"}, {"value", text}}},
          {"range", range}};
}

}  // namespace rung::lsp
