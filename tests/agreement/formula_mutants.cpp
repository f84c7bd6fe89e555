#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mutant.h"

namespace rung {
namespace {

struct Token {
  std::size_t begin = 0;
  std::string_view text;
};

bool is_name_part(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
         c == '\'';
}

std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> tokens;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t length = 1;
    if (is_name_part(text[at])) {
      while (at + length < text.size() && is_name_part(text[at + length])) {
        ++length;
      }
    } else {
      for (const std::string_view sign : {"&&", "||", "==", "<=", ">="}) {
        if (text.substr(at, 2) == sign) length = 2;
      }
    }
    if (text[at] != ' ') tokens.push_back({at, text.substr(at, length)});
    at += length;
  }
  return tokens;
}

bool ends_operand(const Token& token) {
  return is_name_part(token.text.front()) || token.text == ")";
}

std::vector<std::string> in_place_of(const Token& token, bool infix) {
  if (token.text == "-" && !infix) return {""};
  struct Row {
    std::string_view sign;
    std::vector<std::string> others;
  };
  static const std::vector<Row> kRows = {
      {"&&", {"||"}},      {"||", {"&&"}},       {"!", {""}},
      {"<", {"<=", ">"}},  {"<=", {"<", ">="}},  {">", {">=", "<"}},
      {">=", {">", "<="}}, {"==", {">=", "<="}}, {"+", {"-"}},
      {"-", {"+"}},        {"*", {"+"}}};
  for (const Row& row : kRows) {
    if (row.sign == token.text) return row.others;
  }
  return {};
}

std::vector<std::string> in_place_of_operand(
    std::string_view token, const std::vector<std::string_view>& bits) {
  const std::string text(token);
  if (std::isdigit(static_cast<unsigned char>(token.front())) != 0) {
    const long number = std::stol(text);
    return {std::to_string(number + 1), "(" + text + " - 1)"};
  }
  if (token == "p") return {"(p + 1)", "(p - 1)"};
  std::vector<std::string> others;
  for (const std::string_view bit : bits) {
    if (token == bit || token == std::string(bit) + "'") {
      others.push_back("!" + text);
    }
  }
  return others;
}

// `a ? b : c`, where b has no choice of its own.
void exchange_branches(std::string_view text, const std::vector<Token>& tokens,
                       std::vector<std::string>& result) {
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].text != "?") continue;
    std::size_t colon = i;
    while (tokens[colon].text != ":") ++colon;
    const std::size_t then = tokens[i].begin + 1;
    const std::size_t otherwise = tokens[colon].begin + 1;
    result.push_back(
        std::string(text.substr(0, then)) + " (" +
        std::string(text.substr(otherwise)) +
        ") :" + std::string(text.substr(then, tokens[colon].begin - then)));
  }
}

}  // namespace

std::vector<std::string> mutated_formulas(
    std::string_view text, const std::vector<std::string_view>& bits) {
  std::vector<std::string> result;
  const std::vector<Token> tokens = tokens_of(text);
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const Token& token = tokens[i];
    const std::vector<std::string> others =
        is_name_part(token.text.front())
            ? in_place_of_operand(token.text, bits)
            : in_place_of(token, i > 0 && ends_operand(tokens[i - 1]));
    for (const std::string& other : others) {
      std::string mutated(text);
      mutated.replace(token.begin, token.text.size(), other);
      result.push_back(std::move(mutated));
    }
  }
  exchange_branches(text, tokens, result);
  return result;
}

}  // namespace rung
