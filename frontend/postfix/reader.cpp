#include "frontend/postfix/reader.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/postfix_format.h"
#include "frontend/encoding.h"
#include "frontend/error_limit.h"
#include "frontend/postfix/disassemble.h"
#include "frontend/postfix/lines.h"

namespace rung {
namespace {

using postfix::ElementCode;
using postfix::Line;
using postfix::read_integer;
using postfix::shown;
using postfix::Token;

// "T(0,20ms)" taken apart.
struct ElementText {
  std::string_view name;
  std::string_view index;
  std::string_view preset;  // with its unit; empty when there is none
  bool has_value = false;
};

ElementText split_element(std::string_view text) {
  const std::size_t open = text.find('(');
  if (open == text.npos || open == 0 || text.back() != ')') return {};
  ElementText element;
  element.name = text.substr(0, open);
  const std::string_view inside = text.substr(open + 1, text.size() - open - 2);
  const std::size_t comma = inside.find(',');
  element.index = inside.substr(0, comma);
  if (comma != inside.npos) element.preset = inside.substr(comma + 1);
  element.has_value = comma == inside.npos || !element.preset.empty();
  return element;
}

class TextReader {
 public:
  TextReader(const SourceSet& sources, FileId file, DiagnosticSink& sink)
      : text_(sources[file].text()), sink_(sink) {
    ast_.file = file;
    ast_.language = "postfix";
  }

  Ast run() {
    postfix::LineReader lines(text_);
    Line line;
    while (lines.next(line)) {
      take_comment(line);
      if (line.open_quote) {
        fail(*line.open_quote, "RP080", "this name has no closing quote");
        in_rungs_ = in_rungs_ || rungs_missed(line);
        continue;
      }
      if (line.tokens.empty()) continue;
      if (in_rungs_) {
        read_rung(line);
      } else {
        read_header(line);
      }
    }
    check_end();
    return std::move(ast_);
  }

 private:
  enum Stage : std::uint8_t { Version, Dialect, Evaluating, Scan, Cells };

  SourceRange range(const Token& token) const {
    return {ast_.file, token.begin, token.end};
  }
  SourceRange range(const Line& line) const {
    return {ast_.file, line.tokens.front().begin, line.tokens.back().end};
  }

  bool fail(SourceRange where, std::string_view code, std::string message) {
    sink_.report({.code = code,
                  .severity = Severity::Error,
                  .where = where,
                  .message = std::move(message)});
    return false;
  }
  bool fail(const Token& token, std::string_view code, std::string message) {
    return fail(range(token), code, std::move(message));
  }

  void take_comment(const Line& line) {
    if (!line.comment) return;
    const SourceRange where = range(*line.comment);
    if (line.is_note) {
      ast_.annotations.push_back({line.comment->text, where});
    } else {
      ast_.comments.push_back({line.comment->text, where});
    }
  }

  // A line that ends in an open quote may have been the last of the header.
  static bool rungs_missed(const Line& line) {
    return std::any_of(line.tokens.begin(), line.tokens.end(),
                       [](const Token& token) { return token.target; });
  }

  // --- header ----------------------------------------------------------------

  void read_header(const Line& line) {
    static constexpr std::array<std::string_view, 4> kWords = {
        "postfix", "dialect", "evaluation", "scan"};
    const Token& first = line.tokens.front();
    const auto* const word =
        std::find(kWords.begin(), kWords.end(), first.text);
    const auto stage = static_cast<Stage>(std::distance(kWords.begin(), word));
    if (stage != stage_ && (stage_ != Cells || stage < Cells)) {
      fail(first, "RP081",
           stage_ == Cells
               ? "the " + shown(first.text) + " line comes first"
               : "a `" + std::string(kWords[stage_]) +
                     "` line is expected here, not " + shown(first.text));
      stage_ = std::max(stage_, stage);
    }
    if (stage < Cells) {
      if (stage == stage_) {
        read_setting(line);
        stage_ = static_cast<Stage>(stage_ + 1);
      }
      return;
    }
    if (first.text == "rungs" && line.tokens.size() == 1) {
      in_rungs_ = true;
    } else if (first.text == "element") {
      read_slot(line);
    } else {
      read_cell(line);
    }
  }

  void read_setting(const Line& line) {
    const auto& tokens = line.tokens;
    const std::string_view value =
        tokens.size() < 2 ? std::string_view() : tokens[1].text;
    bool fits = tokens.size() == 2;
    if (stage_ == Version) {
      fits = fits && value == "1";
    } else if (stage_ == Dialect) {
      const auto* const found = std::find(postfix::kDialects.begin(),
                                          postfix::kDialects.end(), value);
      fits = fits && found != postfix::kDialects.end();
      if (fits && found != postfix::kDialects.begin()) ast_.dialect = *found;
    } else if (stage_ == Evaluating) {
      const bool skips = value == "short-circuit";
      fits = fits && (skips || value == "strict");
      if (skips) ast_.evaluation = Evaluation::ShortCircuit;
    } else {
      fits = tokens.size() == 3 && tokens[2].text == "ms" &&
             read_interval(value, ast_.scan_min_ms, ast_.scan_max_ms) &&
             ast_.scan_min_ms >= 0;
    }
    if (fits) return;
    static constexpr std::array<std::string_view, 4> kForms = {
        "`postfix 1`: there is no other version",
        "`dialect none`, `dialect yun` or `dialect sim`",
        "`evaluation strict` or `evaluation short-circuit`",
        "`scan 1..100 ms`, two times from 0 to 2147483647"};
    fail(range(line), "RP081",
         "this line reads " + std::string(kForms[stage_]));
  }

  // LOW..HIGH with LOW <= HIGH.
  static bool read_interval(std::string_view text, std::int64_t& low,
                            std::int64_t& high) {
    const std::size_t dots = text.find("..");
    if (dots == text.npos) return false;
    const auto first = read_integer(text.substr(0, dots));
    const auto last = read_integer(text.substr(dots + 2));
    if (!first || !last || *first > *last) return false;
    low = *first;
    high = *last;
    return true;
  }

  // ROLE bit NAME [= VALUE], ROLE word NAME in LOW..HIGH [= VALUE]
  void read_cell(const Line& line) {
    const auto& tokens = line.tokens;
    const auto* const role = std::find(postfix::kRoles.begin(),
                                       postfix::kRoles.end(), tokens[0].text);
    if (role == postfix::kRoles.end() || tokens[0].quoted) {
      fail(tokens[0], "RP081",
           shown(tokens[0].text) +
               " begins no line here: cells (`input`, `output`, `memory`), "
               "`element` or `rungs`");
      return;
    }
    AstDeclaration cell;
    cell.kind = static_cast<AstDeclaration::Kind>(
        std::distance(postfix::kRoles.begin(), role));
    cell.where = range(line);
    std::size_t at = 3;
    bool fits = tokens.size() >= 3 && is_cell_name(tokens[2]);
    if (fits) {
      cell.word = tokens[1].text == "word";
      cell.name = tokens[2].text;
      fits = cell.word || tokens[1].text == "bit";
    }
    if (fits && cell.word) {
      fits = tokens.size() >= 5 && tokens[3].text == "in" &&
             read_interval(tokens[4].text, cell.low, cell.high);
      at = 5;
    }
    if (fits && tokens.size() > at) {
      const auto initial = tokens.size() == at + 2 && tokens[at].text == "="
                               ? read_integer(tokens[at + 1].text)
                               : std::nullopt;
      fits = initial.has_value();
      cell.initial = initial.value_or(0);
    }
    if (fits && cell.initial >= cell.low && cell.initial <= cell.high) {
      ast_.declarations.push_back(cell);
      return;
    }
    fail(cell.where, "RP081",
         "a cell's line reads `" + std::string(*role) +
             " bit NAME [= 1]` or `" + std::string(*role) +
             " word NAME in LOW..HIGH [= VALUE]`, the value in its range");
  }

  static bool is_cell_name(const Token& token) {
    return !token.target &&
           (token.quoted ? postfix::is_name(token.text)
                         : postfix::is_plain_name(token.text) &&
                               postfix::is_name(token.text));
  }

  // element T(0) timer-yun
  void read_slot(const Line& line) {
    const auto& tokens = line.tokens;
    const ElementCode* kind =
        tokens.size() == 3 ? postfix::find_kind(tokens[2].text) : nullptr;
    const ElementText element =
        tokens.size() == 3 ? split_element(tokens[1].text) : ElementText();
    const auto index = read_integer(element.index);
    if (kind == nullptr || !element.has_value || !element.preset.empty() ||
        element.name != kind->letter || !index || *index < 0) {
      fail(range(line), "RP081",
           "an element's line reads `element T(0) KIND`, its letter that of "
           "its kind: T timer-yun or timer-sim, TOF timer-off-sim, C "
           "counter-yun or counter-sim, E edge");
      return;
    }
    auto& slots = slots_[kind->letter];
    if (!slots.emplace(*index, kind).second) {
      fail(range(line), "RP081", "this element stands above already");
      return;
    }
    ast_.declarations.push_back({.kind = AstDeclaration::Kind::Element,
                                 .name = kind->kind_id,
                                 .index = *index,
                                 .where = range(line)});
  }

  void check_end() {
    const auto size = static_cast<std::uint32_t>(text_.size());
    if (!in_rungs_) {
      fail({ast_.file, size, size}, "RP081",
           "the file ends before its `rungs` line");
    }
  }

  // --- rungs -----------------------------------------------------------------

  void read_rung(const Line& line) {
    starts_.clear();
    const auto begin = static_cast<std::uint32_t>(ast_.nodes.size());
    for (const Token& token : line.tokens) {
      const bool last = &token == &line.tokens.back();
      if (token.target != last) {
        fail(token, "RP080",
             last ? "a rung ends with its target, `=NAME`"
                  : "a rung ends at its target");
        return;
      }
      if (last ? !check_target(token) : !read_operand(token)) return;
    }
    ast_.rungs.push_back(
        {.target = line.tokens.back().text,
         .target_where = range(line.tokens.back()),
         .value = {begin, static_cast<std::uint32_t>(ast_.nodes.size())},
         .where = range(line)});
  }

  bool check_target(const Token& token) {
    if (!token.quoted && !postfix::is_plain_name(token.text)) {
      return fail(token, "RP080", shown(token.text) + " is no name");
    }
    if (starts_.size() == 1) return true;
    return fail(token, "RP080",
                starts_.empty()
                    ? "the rung has no value"
                    : "the rung has " + std::to_string(starts_.size()) +
                          " values: an operator is missing");
  }

  bool read_operand(const Token& token) {
    if (token.quoted || postfix::is_plain_name(token.text)) {
      return push(token, AstOp::Name, 0);
    }
    if (const auto* entry = postfix::find_operator(token.text)) {
      return read_operator(token, *entry);
    }
    if (read_integer(token.text)) return push(token, AstOp::Number, 0);
    if (token.text.find('(') != token.text.npos) return read_element(token);
    return fail(
        token, "RP080",
        shown(token.text) + " is no name, no operator and no word of 32 bits");
  }

  bool read_operator(const Token& token, const postfix::Operator& entry) {
    using postfix::Opcode;
    struct Row {
      Opcode opcode;
      AstOp op;
    };
    static constexpr std::array<Row, 17> kRows = {
        {{Opcode::False, AstOp::Bool},
         {Opcode::True, AstOp::Bool},
         {Opcode::Not, AstOp::Not},
         {Opcode::And, AstOp::And},
         {Opcode::Or, AstOp::Or},
         {Opcode::Xor, AstOp::Xor},
         {Opcode::Add, AstOp::Add},
         {Opcode::Subtract, AstOp::Subtract},
         {Opcode::Multiply, AstOp::Multiply},
         {Opcode::Divide, AstOp::Divide},
         {Opcode::Negate, AstOp::Negate},
         {Opcode::Equal, AstOp::Equal},
         {Opcode::NotEqual, AstOp::NotEqual},
         {Opcode::Less, AstOp::Less},
         {Opcode::LessEqual, AstOp::LessEqual},
         {Opcode::Greater, AstOp::Greater},
         {Opcode::GreaterEqual, AstOp::GreaterEqual}}};
    const auto* const row = std::find_if(
        kRows.begin(), kRows.end(),
        [&](const Row& candidate) { return candidate.opcode == entry.opcode; });
    // wrap16, to_word and to_bit have no operator of their own in a tree.
    const AstOp op = row == kRows.end() ? AstOp::Call : row->op;
    return push(token, op, entry.bits_in + std::uint32_t{entry.words_in});
  }

  bool read_element(const Token& token) {
    const ElementText element = split_element(token.text);
    const auto index = read_integer(element.index);
    if (!element.has_value || !index || *index < 0) {
      return fail(token, "RP080",
                  shown(token.text) + " is no element: `T(0,2000ms)`, `TR(0)`");
    }
    const ElementCode* code = find_code(element.name, *index);
    if (code == nullptr) {
      return fail(
          token, "RP080",
          "no line above `rungs` declares an element for " + shown(token.text));
    }
    if (!preset_fits(*code, element.preset)) {
      return fail(token, "RP080",
                  code->preset == ElementCode::Preset::None
                      ? "this element takes no preset"
                  : code->preset == ElementCode::Preset::Count
                      ? "this element takes a count of 32 bits, as in `C(0,5)`"
                      : "this element takes a time of 32 bits, as in "
                        "`T(0,2000ms)`");
    }
    if (starts_.size() < code->bits_in) return missing(token);
    push_number(token, element.index);
    const bool preset = !element.preset.empty();
    if (preset) push_number(token, element.preset);
    if (!push(token, AstOp::Call, code->bits_in + (preset ? 2U : 1U))) {
      return false;
    }
    ast_.nodes.back().text = element.name;
    return true;
  }

  const ElementCode* find_code(std::string_view name, std::int64_t index) {
    for (const ElementCode& code : postfix::element_codes()) {
      if (code.name != name) continue;
      const auto& slots = slots_[code.letter];
      const auto slot = slots.find(index);
      if (slot != slots.end() && slot->second->kind == code.kind) return &code;
    }
    return nullptr;
  }

  static bool preset_fits(const ElementCode& code, std::string_view preset) {
    if (code.preset == ElementCode::Preset::None) return preset.empty();
    if (code.preset == ElementCode::Preset::Milliseconds) {
      if (!preset.ends_with("ms")) return false;
      preset.remove_suffix(2);
    }
    return read_integer(preset).has_value();
  }

  void push_number(const Token& token, std::string_view number) {
    starts_.push_back(static_cast<std::uint32_t>(ast_.nodes.size()));
    ast_.nodes.push_back(
        {.op = AstOp::Number, .where = range(token), .text = number});
  }

  bool missing(const Token& token) {
    return fail(token, "RP080",
                "an operand is missing before " + shown(token.text));
  }

  bool push(const Token& token, AstOp op, std::uint32_t arguments) {
    if (starts_.size() < arguments) return missing(token);
    const auto size = static_cast<std::uint32_t>(ast_.nodes.size());
    const std::uint32_t begin =
        arguments == 0 ? size : starts_[starts_.size() - arguments];
    starts_.resize(starts_.size() - arguments);
    starts_.push_back(begin);
    ast_.nodes.push_back({.op = op,
                          .arguments = arguments,
                          .size = size - begin + 1,
                          .where = range(token),
                          .text = token.text});
    return true;
  }

  std::string_view text_;
  DiagnosticSink& sink_;
  Ast ast_;
  Stage stage_ = Version;
  bool in_rungs_ = false;
  /// By letter and index: no two elements are written alike.
  std::unordered_map<std::string_view,
                     std::unordered_map<std::int64_t, const ElementCode*>>
      slots_;
  std::vector<std::uint32_t> starts_;  // where each operand's nodes begin
};

}  // namespace

bool is_postfix(std::string_view content) {
  if (is_postfix_binary(content)) return true;
  postfix::LineReader lines(content);
  Line line;
  while (lines.next(line)) {
    if (line.tokens.empty() && !line.open_quote) continue;
    return line.tokens.size() == 2 && line.tokens[0].text == "postfix" &&
           !line.tokens[0].quoted && !line.tokens[0].target;
  }
  return false;
}

FileId add_postfix(SourceSet& sources, std::string path, std::string content,
                   DiagnosticSink& sink) {
  if (!is_postfix_binary(content)) {
    return sources.add(std::move(path), std::move(content));
  }
  Disassembly program = disassemble_postfix(content);
  if (program.has_value()) {
    return sources.add(std::move(path), std::move(program.text));
  }
  std::string message = "`" + path + "` is refused: " + program.refusal;
  if (program.code != 0) {
    message += " (refusal " + std::to_string(program.code) + ")";
  }
  sink.report({.code = "RP082",
               .severity = Severity::Error,
               .message = message + ", at byte " + std::to_string(program.at)});
  return {};
}

Ast read_postfix(const SourceSet& sources, FileId file, DiagnosticSink& sink) {
  if (auto problem = check_text(sources, file)) {
    sink.report(std::move(*problem));
    return {.file = file, .language = "postfix"};
  }
  ErrorLimit errors(sink);
  Ast ast = TextReader(sources, file, errors).run();
  errors.finish();
  return ast;
}

}  // namespace rung
