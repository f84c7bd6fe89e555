#include "frontend/st/endless.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>

namespace rung::st {
namespace {

using iec::TokenKind;

constexpr std::array<std::string_view, 14> kBeforeBracket = {
    "AND", "OR",   "XOR", "NOT", "MOD", "IF",   "ELSIF",
    "DO",  "THEN", "OF",  "TO",  "BY",  "CASE", "WHILE"};

class LoopReader {
 public:
  explicit LoopReader(iec::Cursor cursor) : cursor_(cursor) {}

  bool run() {
    const bool tested_first = cursor_.word() == "WHILE";
    cursor_.take();
    Names condition;
    Names body;
    if (tested_first) {
      read_until("DO", "", condition);
      read_until("END_WHILE", "WHILE", body);
    } else {
      read_until("UNTIL", "REPEAT", body);
      read_until("END_REPEAT", "", condition);
    }
    return !unclear_ && std::none_of(condition.begin(), condition.end(),
                                     [&](const std::string& name) {
                                       return assigned_.contains(name);
                                     });
  }

 private:
  using Names = std::set<std::string>;

  /// Reads a part of the loop: the names in it. A loop in it that begins with
  /// `opens` has an end of its own.
  void read_until(std::string_view closes, std::string_view opens,
                  Names& names) {
    std::size_t depth = 0;
    while (!unclear_) {
      const std::string word = cursor_.word();
      if (word == closes && depth-- == 0) break;
      if (!opens.empty() && word == opens) ++depth;
      token(word, names);
    }
    cursor_.take();
  }

  void token(const std::string& word, Names& names) {
    const TokenKind kind = cursor_.peek().kind;
    cursor_.take();
    if (kind == TokenKind::End || kind == TokenKind::Arrow ||
        kind == TokenKind::Unknown || kind == TokenKind::Pragma ||
        word == "EXIT" || word == "RETURN") {
      unclear_ = true;
      return;
    }
    if (kind != TokenKind::Word) return;
    while (cursor_.at(TokenKind::Dot) && cursor_.at(TokenKind::Word, 1)) {
      cursor_.take();
      cursor_.take();
    }
    if (cursor_.at(TokenKind::Assign)) assigned_.insert(word);
    const bool called = cursor_.at(TokenKind::Open) &&
                        std::find(kBeforeBracket.begin(), kBeforeBracket.end(),
                                  word) == kBeforeBracket.end();
    unclear_ = unclear_ || called;
    names.insert(word);
  }

  iec::Cursor cursor_;
  Names assigned_;
  bool unclear_ = false;
};

}  // namespace

bool keeps_its_condition(iec::Cursor cursor) {
  return LoopReader(cursor).run();
}

}  // namespace rung::st
