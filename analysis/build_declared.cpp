#include "analysis/build_declared.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "base/postfix_format.h"
#include "frontend/error_limit.h"
#include "frontend/postfix/lines.h"

namespace rung {
namespace {

constexpr std::uint32_t kNoNode = 0xffff'ffff;

std::string quoted(std::string_view name) {
  return "`" + std::string(name) + "`";
}

std::string_view type_name(Type type) {
  return type == Type::Bit ? "bit" : "word";
}

/// What an operator of the tree is in the program.
struct Shape {
  NodeOp op = NodeOp::Constant;
  Type operands = Type::Bit;
  Type result = Type::Bit;
  std::int64_t value = 0;  // of Wrap
};

constexpr std::array<std::pair<std::string_view, std::int64_t>, 5> kWraps = {
    {{"wrap8", -8},
     {"wrap32", -32},
     {"wrap_u8", 8},
     {"wrap_u16", 16},
     {"wrap_u32", 32}}};

std::optional<Shape> shape_of(const AstNode& node) {
  using enum Type;
  switch (node.op) {
    case AstOp::Not:
      return Shape{NodeOp::Not, Bit, Bit};
    case AstOp::And:
      return Shape{NodeOp::And, Bit, Bit};
    case AstOp::Or:
      return Shape{NodeOp::Or, Bit, Bit};
    case AstOp::Xor:
      return Shape{NodeOp::Xor, Bit, Bit};
    case AstOp::Equal:
      return Shape{NodeOp::Equal, Word, Bit};
    case AstOp::NotEqual:
      return Shape{NodeOp::NotEqual, Word, Bit};
    case AstOp::Less:
      return Shape{NodeOp::Less, Word, Bit};
    case AstOp::LessEqual:
      return Shape{NodeOp::LessEqual, Word, Bit};
    case AstOp::Greater:
      return Shape{NodeOp::Greater, Word, Bit};
    case AstOp::GreaterEqual:
      return Shape{NodeOp::GreaterEqual, Word, Bit};
    case AstOp::Add:
      return Shape{NodeOp::Add, Word, Word};
    case AstOp::Subtract:
      return Shape{NodeOp::Subtract, Word, Word};
    case AstOp::Multiply:
      return Shape{NodeOp::Multiply, Word, Word};
    case AstOp::Divide:
      return Shape{NodeOp::Divide, Word, Word};
    case AstOp::Negate:
      return Shape{NodeOp::Negate, Word, Word};
    case AstOp::Call:
      if (node.text == "wrap16") return Shape{NodeOp::Wrap16, Word, Word};
      for (const auto& [name, bits] : kWraps) {
        if (node.text == name) return Shape{NodeOp::Wrap, Word, Word, bits};
      }
      if (node.text == "to_word") return Shape{NodeOp::ToWord, Bit, Word};
      if (node.text == "to_bit") return Shape{NodeOp::ToBit, Word, Bit};
      return std::nullopt;
    case AstOp::Name:
    case AstOp::Number:
    case AstOp::Bool:
    case AstOp::String:
      return std::nullopt;
  }
  return std::nullopt;
}

bool is_element_call(const AstNode& node) {
  return node.op == AstOp::Call && !shape_of(node);
}

/// How many arguments of an element's call are constants: index and preset.
std::uint32_t immediates_of(const Ast& ast, const AstNode& call) {
  if (ast.language != "postfix") {
    const FoundOperation found = find_operation(ast.dialect, call.text);
    if (found.operation == nullptr) return 0;
    const auto parameters = found.operation->parameters;
    const bool preset =
        std::any_of(parameters.begin(), parameters.end(),
                    [](const ElementParameter& parameter) {
                      return parameter.kind == ParameterKind::Seconds ||
                             parameter.kind == ParameterKind::Count;
                    });
    return preset ? 2 : 1;
  }
  for (const postfix::ElementCode& code : postfix::element_codes()) {
    if (code.name != call.text) continue;
    return code.preset == postfix::ElementCode::Preset::None ? 1 : 2;
  }
  return 0;
}

/// Of the `position`th operand that is no constant.
Type operand_type(const ElementOperation& operation, std::size_t position) {
  for (const ElementParameter& parameter : operation.parameters) {
    const bool word = parameter.kind == ParameterKind::Word;
    if (!word && parameter.kind != ParameterKind::Bit) continue;
    if (position-- == 0) return word ? Type::Word : Type::Bit;
  }
  return Type::Bit;
}

class DeclaredBuilder {
 public:
  DeclaredBuilder(const Ast& ast, DiagnosticSink& sink)
      : ast_(ast), sink_(sink) {}

  Program run() {
    program_.file = ast_.file;
    program_.language = ast_.language;
    program_.dialect = ast_.dialect;
    program_.evaluation = ast_.evaluation;
    program_.scan = {ast_.scan_min_ms, ast_.scan_max_ms};
    program_.annotations = ast_.annotations;
    program_.texts = ast_.made_names;
    program_.comments = ast_.comments;
    declare();
    mark_nodes();
    for (const AstAssignment& rung : ast_.rungs) build_rung(rung);
    return std::move(program_);
  }

 private:
  void fail(SourceRange where, std::string message) {
    sink_.report({.code = "RP083",
                  .severity = Severity::Error,
                  .where = where,
                  .message = std::move(message)});
  }

  // --- declarations ----------------------------------------------------------

  void declare() {
    for (const AstDeclaration& declaration : ast_.declarations) {
      if (declaration.kind == AstDeclaration::Kind::Element) {
        declare_element(declaration);
      } else {
        declare_cell(declaration);
      }
    }
  }

  void declare_cell(const AstDeclaration& declaration) {
    const CellId id(static_cast<std::uint32_t>(program_.cells.size()));
    if (!cells_.emplace(declaration.name, id).second) {
      fail(declaration.where,
           "the cell " + quoted(declaration.name) + " stands above already");
      return;
    }
    CellRole role = CellRole::Memory;
    if (declaration.kind == AstDeclaration::Kind::Input) {
      role = CellRole::Input;
    } else if (declaration.kind == AstDeclaration::Kind::Output) {
      role = CellRole::Output;
    }
    program_.cells.add({.name = std::string(declaration.name),
                        .type = declaration.word ? Type::Word : Type::Bit,
                        .role = role,
                        .initial = declaration.initial,
                        .low = declaration.low,
                        .high = declaration.high,
                        .where = declaration.where,
                        .initialised = declaration.initialised,
                        .declared = role != CellRole::Memory,
                        .made = declaration.made});
  }

  void declare_element(const AstDeclaration& declaration) {
    const auto kinds = element_kinds();
    const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                   [&](const ElementKind& candidate) {
                                     return candidate.id == declaration.name;
                                   });
    if (kind == kinds.end()) {
      fail(declaration.where,
           "there is no element of kind " + quoted(declaration.name));
      return;
    }
    std::string name(declaration.instance);
    if (name.empty()) {
      name = std::string(kind->letter) + "(" +
             std::to_string(declaration.index) + ")";
    }
    const InstanceId id = program_.instances.add({.kind = &*kind,
                                                  .index = declaration.index,
                                                  .name = std::move(name),
                                                  .where = declaration.where});
    for (const ElementOperation& operation : kind->operations) {
      elements_[operation.name].emplace(declaration.index,
                                        Element{id, &operation});
    }
  }

  // --- rungs -----------------------------------------------------------------

  // Which nodes are an element's index or preset, and after which ones a
  // short circuit may leave: where the right operand holds an element.
  void mark_nodes() {
    const std::size_t count = ast_.nodes.size();
    immediate_.assign(count, false);
    leaves_for_.assign(count, kNoNode);
    std::vector<std::uint32_t> calls(count + 1, 0);
    for (std::uint32_t at = 0; at < count; ++at) {
      const AstNode& node = ast_.nodes[at];
      calls[at + 1] = calls[at] + (is_element_call(node) ? 1U : 0U);
      if (is_element_call(node)) {
        const std::uint32_t immediates = immediates_of(ast_, node);
        for (std::uint32_t i = 1; i <= immediates; ++i) {
          immediate_[at - i] = true;
        }
      }
      const bool joins = node.op == AstOp::And || node.op == AstOp::Or;
      if (!joins || ast_.evaluation == Evaluation::Strict) continue;
      const std::uint32_t right = at - ast_.nodes[at - 1].size;
      if (calls[at] != calls[right]) leaves_for_[right - 1] = at;
    }
  }

  void build_rung(const AstAssignment& assignment) {
    const auto target = cells_.find(assignment.target);
    if (target == cells_.end()) {
      return unknown(assignment.target, assignment.target_where);
    }
    const auto begin = static_cast<std::uint32_t>(program_.nodes.size());
    operands_.clear();
    branches_.clear();
    failed_ = false;
    for (std::uint32_t at = assignment.value.begin; at < assignment.value.end;
         ++at) {
      if (!immediate_[at]) build_node(at);
      if (failed_) break;
    }
    const Cell& cell = program_.cells[target->second];
    if (!failed_ && cell.role == CellRole::Input) {
      failed_ = true;
      fail(assignment.target_where,
           quoted(cell.name) + " is an input: no rung writes it");
    }
    if (!failed_) expect(operands_.back(), cell.type, assignment.target_where);
    if (failed_) return program_.nodes.resize(begin);
    program_.rungs.add(
        {.target = target->second,
         .begin = begin,
         .end = static_cast<std::uint32_t>(program_.nodes.size()),
         .target_where = assignment.target_where,
         .where = assignment.where});
  }

  void unknown(std::string_view name, SourceRange where) {
    failed_ = true;
    fail(where, "no cell " + postfix::shown(name) + " is declared");
  }

  void expect(std::uint32_t operand, Type type, SourceRange where) {
    const Type seen = program_.nodes[operand].type;
    if (seen == type || failed_) return;
    failed_ = true;
    fail(where, "a " + std::string(type_name(type)) +
                    " is expected here and a " + std::string(type_name(seen)) +
                    " is given: `to_" + std::string(type_name(type)) +
                    "` converts it");
  }

  std::uint32_t append(Node node) {
    program_.nodes.push_back(node);
    return static_cast<std::uint32_t>(program_.nodes.size() - 1);
  }

  void build_node(std::uint32_t at) {
    const AstNode& node = ast_.nodes[at];
    if (node.op == AstOp::Name) {
      build_read(node);
    } else if (node.op == AstOp::Number || node.op == AstOp::Bool) {
      build_constant(node);
    } else if (const auto shape = shape_of(node)) {
      build_operator(at, *shape);
    } else {
      build_call(at);
    }
    if (!failed_ && leaves_for_[at] != kNoNode) build_branch(at);
  }

  void build_read(const AstNode& node) {
    const auto cell = cells_.find(node.text);
    if (cell == cells_.end()) return unknown(node.text, node.where);
    operands_.push_back(append({.op = NodeOp::Read,
                                .type = program_.cells[cell->second].type,
                                .cell = cell->second,
                                .where = node.where}));
  }

  void build_constant(const AstNode& node) {
    const bool word = node.op == AstOp::Number;
    const std::int64_t value =
        word ? postfix::read_integer(node.text).value_or(0)
             : (node.text == "true" ? 1 : 0);
    operands_.push_back(append({.op = NodeOp::Constant,
                                .type = word ? Type::Word : Type::Bit,
                                .value = value,
                                .where = node.where}));
  }

  void build_operator(std::uint32_t at, const Shape& shape) {
    const AstNode& node = ast_.nodes[at];
    const std::size_t first = operands_.size() - node.arguments;
    for (std::size_t i = first; i < operands_.size(); ++i) {
      expect(operands_[i], shape.operands, program_.nodes[operands_[i]].where);
    }
    if (failed_) return;
    const std::uint32_t right = operands_.back();
    const bool two = node.arguments == 2;
    if (shape.op == NodeOp::Divide &&
        (program_.nodes[right].op != NodeOp::Constant ||
         program_.nodes[right].value == 0)) {
      failed_ = true;
      return fail(program_.nodes[right].where,
                  "the divisor must be a constant other than 0");
    }
    const std::uint32_t built = append({.op = shape.op,
                                        .type = shape.result,
                                        .a = operands_[first],
                                        .b = two ? right : 0,
                                        .value = shape.value,
                                        .where = node.where});
    operands_.resize(first);
    operands_.push_back(built);
    close_branches(at, built);
  }

  // Branches nest as operators do: the last one that is open ends here.
  void close_branches(std::uint32_t at, std::uint32_t built) {
    if (branches_.empty() || branches_.back().second != at) return;
    program_.nodes[branches_.back().first].target = built;
    branches_.pop_back();
  }

  void build_branch(std::uint32_t at) {
    const std::uint32_t join = leaves_for_[at];
    expect(operands_.back(), Type::Bit, ast_.nodes[at].where);
    if (failed_) return;
    branches_.emplace_back(
        append({.op = NodeOp::Branch,
                .skip_when = ast_.nodes[join].op == AstOp::Or,
                .a = operands_.back(),
                .where = ast_.nodes[join].where}),
        join);
  }

  void build_call(std::uint32_t at) {
    const AstNode& node = ast_.nodes[at];
    const std::uint32_t immediates = immediates_of(ast_, node);
    const Element* element =
        immediates == 0
            ? nullptr
            : find_element(node.text, ast_.nodes[at - immediates].text);
    const std::size_t count = node.arguments - immediates;
    if (element == nullptr || operands_.size() < count) {
      failed_ = true;
      return fail(node.where, "there is no element " + quoted(node.text));
    }
    const std::size_t first = operands_.size() - count;
    ElementCall call{.instance = element->instance,
                     .operation = element->operation,
                     .where = node.where};
    for (std::size_t i = first; i < operands_.size(); ++i) {
      expect(operands_[i], operand_type(*element->operation, i - first),
             program_.nodes[operands_[i]].where);
      call.arguments.push_back(operands_[i]);
    }
    if (failed_) return;
    const Type result = call.operation->word ? Type::Word : Type::Bit;
    if (immediates == 2) take_preset(ast_.nodes[at - 1].text, call);
    operands_.resize(first);
    operands_.push_back(append({.op = NodeOp::Call,
                                .type = result,
                                .call = program_.calls.add(std::move(call)),
                                .where = node.where}));
  }

  struct Element {
    InstanceId instance;
    const ElementOperation* operation = nullptr;
  };

  const Element* find_element(std::string_view operation,
                              std::string_view index) const {
    const auto by_index = elements_.find(operation);
    if (by_index == elements_.end()) return nullptr;
    const auto found =
        by_index->second.find(postfix::read_integer(index).value_or(-1));
    return found == by_index->second.end() ? nullptr : &found->second;
  }

  void take_preset(std::string_view text, ElementCall& call) {
    if (text.ends_with("ms")) text.remove_suffix(2);
    call.parameter = postfix::read_integer(text).value_or(0);
    Instance& instance = program_.instances[call.instance];
    instance.largest_parameter =
        std::max(instance.largest_parameter, call.parameter);
    instance.clock_cap = instance.largest_parameter + 1;
  }

  const Ast& ast_;
  DiagnosticSink& sink_;
  Program program_;
  std::unordered_map<std::string_view, CellId> cells_;
  /// By operation and index.
  std::unordered_map<std::string_view,
                     std::unordered_map<std::int64_t, Element>>
      elements_;
  std::vector<bool> immediate_;            // by Ast node: index or preset
  std::vector<std::uint32_t> leaves_for_;  // by Ast node: the And or Or
  std::vector<std::uint32_t> operands_;    // Program nodes
  /// Open branches: the marker, and the And or Or in the Ast.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> branches_;
  bool failed_ = false;
};

}  // namespace

Program build_declared(const Ast& ast, DiagnosticSink& sink) {
  ErrorLimit errors(sink);
  Program program = DeclaredBuilder(ast, errors).run();
  errors.finish();
  return program;
}

}  // namespace rung
