#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/plclib/token.h"
#include "frontend/plclib/values.h"

namespace rung::plclib {

/// A place in the tokens.
class Cursor {
 public:
  explicit Cursor(const TokenList& list) : list_(&list) {}

  const Token& peek(std::size_t ahead = 0) const {
    return list_->tokens[std::min(at_ + ahead, list_->tokens.size() - 1)];
  }
  std::string_view text(std::size_t ahead = 0) const {
    return list_->text_of(peek(ahead));
  }
  bool at_end() const { return peek().kind == TokenKind::End; }
  bool at_word(std::size_t ahead = 0) const {
    return peek(ahead).kind == TokenKind::Word;
  }
  bool at(std::string_view symbol, std::size_t ahead = 0) const {
    return peek(ahead).kind == TokenKind::Symbol && text(ahead) == symbol;
  }
  bool at_keyword(std::string_view word, std::size_t ahead = 0) const {
    return at_word(ahead) && text(ahead) == word;
  }
  const Token& take() {
    const Token& token = peek();
    if (token.kind != TokenKind::End) ++at_;
    ++taken_;
    return token;
  }
  bool accept(std::string_view symbol) {
    if (!at(symbol)) return false;
    take();
    return true;
  }
  std::string_view text_of(const Token& token) const {
    return list_->text_of(token);
  }
  SourceRange range(const Token& token) const { return list_->range_of(token); }
  SourceRange here() const { return range(peek()); }
  /// What stands here, for a message.
  std::string shown() const {
    return at_end() ? "the end of the file" : quoted_excerpt(text());
  }
  /// From the opening bracket here to behind the one that closes it; false when
  /// none does.
  bool skip_brackets();
  /// To behind the next `;` or block, but not out of the block around it.
  void skip_statement();

  /// Tokens taken so far, also those that were taken before.
  std::size_t taken() const { return taken_; }
  std::size_t position() const { return at_; }
  void go_to(std::size_t position) { at_ = position; }

 private:
  const TokenList* list_;
  std::size_t at_ = 0;
  std::size_t taken_ = 0;
};

/// Reads a type of arithmetic; no value and no token taken when there is none.
/// `is_constant` becomes true for `const`.
std::optional<CType> take_type(Cursor& cursor, bool& is_constant);

enum class ObjectKind : std::uint8_t { Counter, Shift, Stack, Pulse };
std::optional<ObjectKind> object_kind(std::string_view word);

/// A global variable or object, as declared.
struct Global {
  std::string_view name;
  CType type = CType::Void;
  std::optional<ObjectKind> object;
  bool constant = false;
  std::size_t initialiser = 0;  // position of the tokens behind = or (; 0: none
  SourceRange where;
};

struct Function {
  std::string_view name;
  std::size_t begin = 0;  // position behind the opening brace
  std::size_t end = 0;    // of the closing brace
  SourceRange where;
};

/// loopN(period): a task of its own.
struct Task {
  const Function* function = nullptr;
  std::int64_t period_ms = 0;
};

/// The parts of a sketch.
struct Sketch {
  std::vector<Global> globals;
  std::unordered_map<std::string_view, Function> functions;
  std::vector<Task> tasks;  // longest period first
  bool no_pin_defs = false;

  const Function* find(std::string_view name) const {
    const auto found = functions.find(name);
    return found == functions.end() ? nullptr : &found->second;
  }
};

Sketch read_sketch(const TokenList& list, const Directives& directives,
                   ErrorLimit& errors);

}  // namespace rung::plclib
