#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/error_limit.h"
#include "frontend/il_iec/names.h"
#include "frontend/il_iec/token.h"
#include "frontend/il_iec/writer.h"

namespace rung::il_iec {

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
  /// The word in capitals; empty where there is none.
  std::string word(std::size_t ahead = 0) const {
    return at(TokenKind::Word, ahead) ? upper(text(peek(ahead)))
                                      : std::string();
  }
  std::string_view text(const Token& token) const {
    return list_->text_of(token);
  }
  SourceRange range(const Token& token) const { return list_->range_of(token); }
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

 private:
  const TokenList* list_;
  std::size_t at_ = 0;
};

/// Reads VAR ... END_VAR blocks, as long as there are any. False: there was
/// none.
bool read_declarations(Cursor& cursor, Names& names, ErrorLimit& errors);

/// Reads instructions up to `end_word` (END_PROGRAM), which is left, or to the
/// end of the file. `by_use`: names that are not declared are bits.
void read_instructions(Cursor& cursor, Names& names, Writer& writer,
                       ErrorLimit& errors, std::string_view end_word,
                       bool by_use);

/// Is the word, in capitals, an operator of instruction lists?
bool is_operator(std::string_view upper_word);

}  // namespace rung::il_iec
