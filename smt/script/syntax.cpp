#include "smt/script/syntax.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <unordered_map>
#include <utility>

namespace rung::script {
namespace {

constexpr std::array<std::pair<std::string_view, Op>, 18> kOperators = {{
    {"not", Op::Not},
    {"and", Op::And},
    {"or", Op::Or},
    {"xor", Op::Xor},
    {"=>", Op::Implies},
    {"=", Op::Equal},
    {"<", Op::Less},
    {"<=", Op::LessEqual},
    {">", Op::Greater},
    {">=", Op::GreaterEqual},
    {"+", Op::Add},
    {"-", Op::Subtract},
    {"*", Op::Multiply},
    {"div", Op::Divide},
    {"mod", Op::Modulo},
    {"ite", Op::Ite},
    {"true", Op::True},
    {"false", Op::False},
}};

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {
    for (const auto& [name, op] : kOperators) operators_.emplace(name, op);
  }

  Script read() {
    for (next(); !token_.empty() && script_.error.empty(); next()) command();
    return std::move(script_);
  }

 private:
  /// A parenthesis, an atom, or nothing at the end.
  void next() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == ';') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (c == ' ' || c == '\n') {
        ++at_;
      } else {
        break;
      }
    }
    std::size_t end = at_;
    if (end < text_.size() && (text_[end] == '(' || text_[end] == ')')) {
      ++end;
    } else {
      end = std::min(text_.find_first_of(" \n();", at_), text_.size());
    }
    token_ = text_.substr(at_, end - at_);
    at_ = end;
  }

  void fail(std::string_view what) {
    if (!script_.error.empty()) return;
    script_.error = std::string(what) + " `" + std::string(token_) + "`";
  }
  void expect(std::string_view token) {
    next();
    if (token_ != token) fail("unexpected");
  }

  void command() {
    if (token_ != "(") return fail("unexpected");
    next();
    if (token_ == "set-logic") {
      next();
      expect(")");
    } else if (token_ == "declare-const") {
      declare();
    } else if (token_ == "assert") {
      assertion();
      expect(")");
    } else {
      fail("unknown command");
    }
  }

  void declare() {
    next();
    const auto index = static_cast<std::int64_t>(script_.symbols.size());
    if (!symbols_.emplace(token_, index).second) fail("declared twice:");
    Symbol symbol{token_, false};
    next();
    symbol.is_int = token_ == "Int";
    if (!symbol.is_int && token_ != "Bool") fail("unknown sort");
    script_.symbols.push_back(symbol);
    expect(")");
  }

  struct Open {  // an application whose operands are being read
    Op op;
    std::size_t operands;  // of it and those around it, in pending_
  };

  void assertion() {
    const auto begin = static_cast<std::uint32_t>(script_.nodes.size());
    pending_.clear();
    open_.clear();
    do {
      next();
      if (token_.empty()) return fail("the text ends in a term");
      if (token_ == "(") {
        next();
        const auto op = operators_.find(token_);
        if (op == operators_.end()) return fail("unknown operator");
        open_.push_back({op->second, pending_.size()});
      } else if (token_ == ")") {
        if (open_.empty()) return fail("unexpected");
        close();
      } else {
        atom();
      }
    } while (!open_.empty() && script_.error.empty());
    if (!script_.error.empty()) return;
    script_.assertions.push_back({begin, pending_.front()});
  }

  void push(const Node& node) {
    pending_.push_back(static_cast<std::uint32_t>(script_.nodes.size()));
    script_.nodes.push_back(node);
  }

  void atom() {
    if (token_ == "true") return push({.op = Op::True});
    if (token_ == "false") return push({.op = Op::False});
    const auto symbol = symbols_.find(token_);
    if (symbol != symbols_.end()) {
      return push({.op = Op::Symbol, .value = symbol->second});
    }
    Node number{.op = Op::Number};
    const char* end = token_.data() + token_.size();
    const auto read = std::from_chars(token_.data(), end, number.value);
    const bool whole = read.ec == std::errc() && read.ptr == end;
    if (!whole || number.value < 0) return fail("unknown name");
    push(number);
  }

  void close() {
    const Open of = open_.back();
    open_.pop_back();
    const std::size_t count = pending_.size() - of.operands;
    if (count == 0) return fail("no operand before");
    Node node{.op = of.op,
              .first = static_cast<std::uint32_t>(script_.operands.size()),
              .count = static_cast<std::uint32_t>(count)};
    Node& last = script_.nodes[pending_.back()];
    if (of.op == Op::Subtract && count == 1 && last.op == Op::Number) {
      last.value = -last.value;  // a number below zero
      return;
    }
    script_.operands.insert(
        script_.operands.end(),
        pending_.begin() + static_cast<std::ptrdiff_t>(of.operands),
        pending_.end());
    pending_.resize(of.operands);
    push(node);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string_view token_;
  std::unordered_map<std::string_view, Op> operators_;
  std::unordered_map<std::string_view, std::int64_t> symbols_;
  std::vector<Open> open_;
  std::vector<std::uint32_t> pending_;  // nodes whose application is open
  Script script_;
};

}  // namespace

Script read_script(std::string_view text) { return Reader(text).read(); }

}  // namespace rung::script
