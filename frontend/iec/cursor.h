#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "frontend/iec/token.h"

namespace rung::iec {

/// A place in the tokens, or in a part of them: behind it there is End.
class Cursor {
 public:
  explicit Cursor(const TokenList& list)
      : Cursor(list, 0, list.tokens.size() - 1) {}
  Cursor(const TokenList& list, std::size_t begin, std::size_t end)
      : list_(&list), at_(begin), end_(end) {}

  const Token& peek(std::size_t ahead = 0) const {
    const std::size_t at = at_ + ahead;
    return at < end_ ? list_->tokens[at] : list_->tokens.back();
  }
  bool at(TokenKind kind, std::size_t ahead = 0) const {
    return peek(ahead).kind == kind;
  }
  const Token& take() {
    const Token& token = peek();
    if (at_ < end_) ++at_;
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
  /// Of the next token; at the end, of the last one.
  SourceRange here() const {
    if (at_ < end_ || end_ == 0) return range(peek());
    return range(list_->tokens[end_ - 1]);
  }
  void skip_line_ends() {
    while (at(TokenKind::LineEnd)) take();
  }
  void skip_line() {
    while (!at(TokenKind::LineEnd) && !at(TokenKind::End)) take();
  }
  /// What stands here, for a message.
  std::string shown() const {
    if (at(TokenKind::End)) return "the end";
    if (at(TokenKind::LineEnd)) return "the end of the line";
    return quoted_excerpt(text(peek()));
  }
  std::size_t position() const { return at_; }
  void go_to(std::size_t position) { at_ = position; }
  const TokenList& list() const { return *list_; }

 private:
  const TokenList* list_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;
};

}  // namespace rung::iec
