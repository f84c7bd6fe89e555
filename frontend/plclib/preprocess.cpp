#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "frontend/plclib/token.h"

namespace rung::plclib {
namespace {

// A macro of macros may double: this keeps the whole linear.
constexpr std::size_t kLongestMacro = 16;

class Preprocessor {
 public:
  Preprocessor(TokenList& list, ErrorLimit& errors)
      : list_(list), errors_(errors) {}

  Directives run() {
    const std::vector<Token> tokens = std::exchange(list_.tokens, {});
    for (const Token& token : tokens) {
      if (token.kind == TokenKind::Directive) {
        directive(token);
      } else {
        add(token, list_.tokens);
      }
    }
    return said_;
  }

 private:
  void fail(const Token& token, std::string message) {
    errors_.error("RP055", list_.range_of(token), std::move(message));
  }

  void add(const Token& token, std::vector<Token>& to) {
    if (token.kind == TokenKind::Word) {
      const std::string_view word = list_.text_of(token);
      const auto macro = macros_.find(word);
      if (macro != macros_.end()) {
        to.insert(to.end(), macro->second.begin(), macro->second.end());
        return;
      }
      seen_.insert(word);
    }
    to.push_back(token);
  }

  /// The tokens of the line, with places in the whole text.
  std::vector<Token> tokens_of(const Token& line) const {
    TokenList part = tokenize(
        list_.text.substr(0, line.end).substr(line.begin + 1), list_.file);
    part.tokens.pop_back();
    for (Token& token : part.tokens) {
      token.begin += line.begin + 1;
      token.end += line.begin + 1;
    }
    return part.tokens;
  }

  void directive(const Token& line) {
    const std::vector<Token> tokens = tokens_of(line);
    const std::string_view word =
        tokens.empty() ? std::string_view() : list_.text_of(tokens.front());
    if (word == "include") return include(line, tokens);
    if (word == "define" && tokens.size() > 1 &&
        tokens[1].kind == TokenKind::Word) {
      return define(tokens);
    }
    if (tokens.empty()) return;  // a lone # says nothing
    fail(line, quoted_excerpt(list_.text_of(line)) + " is not supported");
  }

  void include(const Token& line, const std::vector<Token>& tokens) {
    std::string name;
    for (std::size_t i = 1; i < tokens.size(); ++i) {
      name += list_.text_of(tokens[i]);
    }
    for (const char* const known :
         {"<plcLib.h>", "\"plcLib.h\"", "<Arduino.h>", "\"Arduino.h\""}) {
      if (name == known) return;
    }
    fail(line, quoted_excerpt(list_.text_of(line)) +
                   " is not supported: what it declares is not known");
  }

  void define(const std::vector<Token>& tokens) {
    const Token& name = tokens[1];
    const std::string_view word = list_.text_of(name);
    if (tokens.size() > 2 && tokens[2].begin == name.end) {
      return fail(name, quoted_excerpt(word) +
                            " is a macro with parameters: that is not "
                            "supported");
    }
    if (tokens.size() == 2 && word == "noPinDefs") {
      said_.no_pin_defs = true;
      return;
    }
    if (macros_.contains(word) || seen_.contains(word)) {
      return fail(name, quoted_excerpt(word) +
                            " is used or defined above already: that is not "
                            "supported");
    }
    std::vector<Token> body;
    for (std::size_t i = 2; i < tokens.size(); ++i) {
      add(tokens[i], body);
      if (body.size() > kLongestMacro) {
        return fail(name, quoted_excerpt(word) + " stands for more than " +
                              std::to_string(kLongestMacro) +
                              " tokens: that is not supported");
      }
    }
    macros_.emplace(word, std::move(body));
  }

  TokenList& list_;
  ErrorLimit& errors_;
  Directives said_;
  std::unordered_map<std::string_view, std::vector<Token>> macros_;
  std::unordered_set<std::string_view> seen_;
};

}  // namespace

Directives preprocess(TokenList& list, ErrorLimit& errors) {
  return Preprocessor(list, errors).run();
}

}  // namespace rung::plclib
