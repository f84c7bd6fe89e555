#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "frontend/iec/token.h"

namespace rung::iec {

/// A place in the tokens.
class Cursor {
 public:
  explicit Cursor(const TokenList& list) : list_(&list) {}

  const Token& peek(std::size_t ahead = 0) const {
    const std::size_t at = std::min(at_ + ahead, list_->tokens.size() - 1);
    return list_->tokens[at];
  }
  bool at(TokenKind kind, std::size_t ahead = 0) const {
    return peek(ahead).kind == kind;
  }
  const Token& take() {
    const Token& token = peek();
    if (token.kind != TokenKind::End) ++at_;
    return token;
  }
  bool accept(TokenKind kind) {
    if (!at(kind)) return false;
    take();
    return true;
  }
  bool accept_word(std::string_view upper_word) {
    if (word() != upper_word) return false;
    take();
    return true;
  }
  /// The word in capitals; empty where there is none.
  std::string word(std::size_t ahead = 0) const {
    return at(TokenKind::Word, ahead) ? upper(text(peek(ahead)))
                                      : std::string();
  }
  std::string_view text(const Token& token) const {
    return list_->text_of(token);
  }
  SourceRange range(const Token& token) const { return list_->range_of(token); }
  SourceRange here() const { return range(peek()); }
  void skip_line_ends() {
    while (at(TokenKind::LineEnd)) take();
  }
  void skip_line() {
    while (!at(TokenKind::LineEnd) && !at(TokenKind::End)) take();
  }
  /// What stands here, for a message.
  std::string shown() const {
    if (at(TokenKind::End)) return "the end of the file";
    if (at(TokenKind::LineEnd)) return "the end of the line";
    return quoted_excerpt(text(peek()));
  }
  std::size_t position() const { return at_; }
  void go_to(std::size_t position) { at_ = position; }
  const TokenList& list() const { return *list_; }

 private:
  const TokenList* list_;
  std::size_t at_ = 0;
};

}  // namespace rung::iec
