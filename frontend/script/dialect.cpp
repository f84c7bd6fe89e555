#include "frontend/script/dialect.h"

#include <algorithm>
#include <array>
#include <string>

namespace rung::script {
namespace {

constexpr std::string_view kYun = "yun";
constexpr std::string_view kSim = "sim";

/// The view in static storage, for Ast::dialect; empty for another word.
std::string_view dialect_named(std::string_view name) {
  if (name == kYun) return kYun;
  if (name == kSim) return kSim;
  return {};
}

/// `prefix` and then digits only.
bool is_numbered(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix) || name.size() == prefix.size()) return false;
  name.remove_prefix(prefix.size());
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

/// The dialect that alone gives `name` a meaning; empty when both or none do.
std::string_view dialect_of(std::string_view name, bool called) {
  constexpr std::array<std::string_view, 5> kYunCalls = {"TR", "CR", "ORN",
                                                         "Cmp", "Cnt"};
  if (called) {
    if (name == "TOF") return kSim;
    const bool yun =
        std::find(kYunCalls.begin(), kYunCalls.end(), name) != kYunCalls.end();
    return yun ? kYun : std::string_view();
  }
  if (is_numbered(name, "pin") || is_numbered(name, "y")) return kYun;
  if (name.size() == 2 && name >= "A0" && name <= "A5") return kYun;
  for (const std::string_view prefix : {"I", "Q", "IW", "QW"}) {
    if (is_numbered(name, prefix)) return kSim;
  }
  return {};
}

struct Evidence {
  std::string_view dialect;
  Token token;
};

std::string_view judge(const TokenList& list, const Evidence& first,
                       const Evidence& other, ErrorLimit& errors) {
  if (!other.dialect.empty()) {
    errors.error(
        "RP004", list.range_of(other.token),
        quoted_excerpt(list.text_of(other.token)) + " is of the " +
            std::string(other.dialect) + " dialect and " +
            quoted_excerpt(list.text_of(first.token)) + " of the " +
            std::string(first.dialect) +
            " dialect: say which with `--dialect` or `//@ dialect`",
        {{list.range_of(first.token), std::string(first.dialect) + " here"}});
  }
  return first.dialect.empty() ? kSim : first.dialect;
}

/// Names after a section marker are the plant's own.
std::string_view recognise(const TokenList& list, ErrorLimit& errors) {
  Evidence first;
  for (std::size_t i = 0; i < list.tokens.size(); ++i) {
    const Token& token = list.tokens[i];
    const bool marker = token.kind == TokenKind::VarSection ||
                        token.kind == TokenKind::SimSection;
    if (!marker && token.kind != TokenKind::Name) continue;
    const bool called = !marker && list.tokens[i + 1].kind == TokenKind::Open;
    const std::string_view found =
        marker ? kSim : dialect_of(list.text_of(token), called);
    if (first.dialect.empty()) {
      first = {found, token};
    } else if (!found.empty() && found != first.dialect) {
      return judge(list, first, {found, token}, errors);
    }
    if (marker) break;
  }
  return judge(list, first, {}, errors);
}

std::string_view trim_left(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  return text.substr(std::min(begin, text.size()));
}

}  // namespace

std::string_view find_dialect(const TokenList& list, std::string_view given,
                              ErrorLimit& errors) {
  std::string_view declared;
  for (const AstAnnotation& line : list.annotations) {
    std::string_view text = line.text;
    if (!text.starts_with("dialect ") && !text.starts_with("dialect\t")) {
      continue;
    }
    text = trim_left(text.substr(8));
    const std::string_view named = dialect_named(text);
    if (named.empty() || (!declared.empty() && named != declared)) {
      errors.error(
          "RP004", line.where,
          named.empty()
              ? quoted_excerpt(text) + " is no dialect: write `yun` or `sim`"
              : "the script is declared to be of both dialects");
    }
    if (declared.empty()) declared = named;
  }
  if (!given.empty()) {
    const std::string_view named = dialect_named(given);
    if (!named.empty()) return named;
    errors.error(
        "RP004", {list.file, 0, 0},
        quoted_excerpt(given) + " is no dialect: write `yun` or `sim`");
  }
  return declared.empty() ? recognise(list, errors) : declared;
}

}  // namespace rung::script
