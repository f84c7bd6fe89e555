#include <fmt/format.h>

#include "analysis/rule.h"
#include "app/lsp/features.h"

namespace rung::lsp {
namespace {

bool touches(SourceRange a, SourceRange b) {
  return a.begin <= b.end && b.begin <= a.end;
}

Json workspace_edit(const View& view, const std::vector<Edit>& edits) {
  Json all = Json::array();
  for (const Edit& edit : edits) {
    all.push_back(
        {{"range", range_of(view, edit.where)}, {"newText", edit.text}});
  }
  return {{"changes", {{view.uri, std::move(all)}}}};
}

/// What a client sent as the diagnostics of the finding is found again by the
/// code; it need not be sent back.
Json action(std::string title, bool preferred, Json edit) {
  return {{"title", std::move(title)},
          {"kind", "quickfix"},
          {"isPreferred", preferred},
          {"edit", std::move(edit)}};
}

std::string_view status_of(const View& view, const Fix& fix) {
  if (fix.proved) return " (proved: the program does the same)";
  return view.fixes_decided ? " (changes what the program does, or may)"
                            : " (not proved yet)";
}

/// A line above the finding. The reason is left for the one who knows it:
/// without, the line allows nothing, and a finding says so.
Json allow_action(const View& view, const Diagnostic& finding) {
  const std::string& text = view.snapshot.text.text();
  std::uint32_t begin = finding.where.begin;
  while (begin > 0 && text[begin - 1] != '\n' && text[begin - 1] != '\r') {
    --begin;
  }
  std::uint32_t end = begin;
  while (end < text.size() && (text[end] == ' ' || text[end] == '\t')) ++end;
  const std::string line = fmt::format(
      "{}//@ allow {}: \n", text.substr(begin, end - begin), finding.rule);
  return action(
      fmt::format("allow {} here (write the reason)", finding.rule), false,
      workspace_edit(view, {{{finding.where.file, begin, begin}, line}}));
}

}  // namespace

Json code_actions_in(const View& view, SourceRange range) {
  Json all = Json::array();
  if (view.snapshot.program() == nullptr) return all;
  for (const Diagnostic& finding : view.findings) {
    if (!touches(finding.where, range)) continue;
    for (const Fix& fix : finding.fixes) {
      all.push_back(action(fix.title + std::string(status_of(view, fix)),
                           fix.proved, workspace_edit(view, fix.edits)));
    }
    if (view.snapshot.program()->language == "script" &&
        find_rule(finding.code) != nullptr) {
      all.push_back(allow_action(view, finding));
    }
  }
  return all;
}

}  // namespace rung::lsp
