#include "app/certificate_names.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace rung {
namespace {

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

/// The letters and digits that it begins with; else its first character.
std::string_view first_word(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && is_word(text[end])) ++end;
  return text.substr(0, std::max<std::size_t>(end, 1));
}

/// Does `name` stand at `at`, and not within a longer word?
bool stands_at(std::string_view text, std::size_t at, std::string_view name) {
  if (name.empty() || text.substr(at, name.size()) != name) return false;
  const std::size_t end = at + name.size();
  const bool goes_on =
      end < text.size() && is_word(text[end]) && is_word(name.back());
  const bool began = at > 0 && is_word(text[at - 1]) && is_word(name.front());
  return !goes_on && !began;
}

template <class Visit>
void each_text(Certificate& certificate, const Visit& visit) {
  for (std::string& text : certificate.lemmas) visit(text);
  for (std::string& text : certificate.ways) visit(text);
  for (std::string& text : certificate.conditions) visit(text);
}

std::string renamed(std::string_view text, const NewNames& names) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::pair<std::string, std::string>* longest = nullptr;
    for (const auto& name : names) {
      if (!stands_at(text, at, name.first)) continue;
      if (longest == nullptr || longest->first.size() < name.first.size()) {
        longest = &name;
      }
    }
    if (longest == nullptr) {
      result += text[at++];
    } else {
      result += longest->second;
      at += longest->first.size();
    }
  }
  return result;
}

}  // namespace

CertificateNames::CertificateNames(const TransitionSystem& ts) : ts_(ts) {
  for (std::uint32_t i = 0; i < ts.vars.size(); ++i) {
    by_word_[first_word(ts.vars[VarId(i)].name)].push_back(VarId(i));
  }
}

std::vector<VarId> CertificateNames::in(const Certificate& certificate) const {
  std::set<VarId> found;
  Certificate texts = certificate;
  each_text(texts, [&](const std::string& text) {
    for (std::size_t at = 0; at < text.size(); ++at) {
      const auto named =
          by_word_.find(first_word(std::string_view(text).substr(at)));
      if (named == by_word_.end()) continue;
      for (const VarId var : named->second) {
        if (stands_at(text, at, ts_.vars[var].name)) found.insert(var);
      }
    }
  });
  return {found.begin(), found.end()};
}

void rename(Certificate& certificate, const NewNames& names) {
  if (names.empty()) return;
  each_text(certificate,
            [&](std::string& text) { text = renamed(text, names); });
}

}  // namespace rung
