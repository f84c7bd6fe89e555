#include "block_programs.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "frontend/semantics.h"

namespace rung {
namespace {

constexpr std::int64_t kLowest = std::numeric_limits<std::int16_t>::min();
constexpr std::int64_t kHighest = std::numeric_limits<std::int16_t>::max();

class Writer {
 public:
  Writer() {
    program_.language = "il-iec";
    program_.dialect = "iec";
    program_.evaluation = Evaluation::ShortCircuit;
  }

  CellId cell(std::string name, CellRole role, Type type) {
    const bool word = type == Type::Word;
    const bool input = role == CellRole::Input;
    return program_.cells.add({.name = std::move(name),
                               .type = type,
                               .role = role,
                               .low = word ? kLowest : 0,
                               // Elapsed times are written to cells, too.
                               .high = !word   ? 1
                                       : input ? kHighest
                                               : 1'000'000});
  }

  InstanceId instance(const ElementKind& kind, std::int64_t index) {
    return program_.instances.add(
        {.kind = &kind,
         .index = index,
         .name = std::string(kind.letter) + std::to_string(index)});
  }

  std::uint32_t append(Node node) {
    program_.nodes.push_back(node);
    return static_cast<std::uint32_t>(program_.nodes.size() - 1);
  }
  std::uint32_t read(CellId cell) {
    return append(
        {.op = NodeOp::Read, .type = program_.cells[cell].type, .cell = cell});
  }
  std::uint32_t constant(Type type, std::int64_t value) {
    return append({.op = NodeOp::Constant, .type = type, .value = value});
  }

  std::uint32_t call(InstanceId id, const ElementOperation& operation,
                     std::int64_t preset,
                     std::vector<std::uint32_t> arguments) {
    Instance& instance = program_.instances[id];
    instance.largest_parameter = std::max(instance.largest_parameter, preset);
    instance.clock_cap = instance.largest_parameter + 1;
    const CallId call = program_.calls.add({.instance = id,
                                            .operation = &operation,
                                            .parameter = preset,
                                            .arguments = std::move(arguments)});
    return append({.op = NodeOp::Call,
                   .type = operation.word ? Type::Word : Type::Bit,
                   .call = call});
  }

  std::uint32_t begin() const {
    return static_cast<std::uint32_t>(program_.nodes.size());
  }
  void rung(CellId target, std::uint32_t begin) {
    program_.rungs.add(
        {.target = target, .begin = begin, .end = this->begin()});
  }
  /// What stands from `left` on is executed only where that node is true.
  void branch(std::uint32_t left) {
    open_ = append({.op = NodeOp::Branch, .a = left});
  }
  void join(std::uint32_t left, std::uint32_t right) {
    program_.nodes[open_].target =
        append({.op = NodeOp::And, .a = left, .b = right});
  }

  void set_dialect(std::string_view dialect) { program_.dialect = dialect; }
  std::string_view dialect() const { return program_.dialect; }

  Program take() { return std::move(program_); }

 private:
  Program program_;
  std::uint32_t open_ = 0;
};

bool has_preset(const ElementOperation& operation) {
  return std::any_of(operation.parameters.begin(), operation.parameters.end(),
                     [](const ElementParameter& parameter) {
                       return parameter.kind == ParameterKind::Seconds ||
                              parameter.kind == ParameterKind::Count;
                     });
}

/// Of programs that declare their cells: all but those of the scripts.
std::vector<std::string_view> block_dialects() {
  std::vector<std::string_view> dialects;
  for (const Semantics& preset : semantics_presets()) {
    const std::string_view dialect = preset.elements;
    if (dialect == "yun" || dialect == "sim" ||
        std::find(dialects.begin(), dialects.end(), dialect) !=
            dialects.end()) {
      continue;
    }
    dialects.push_back(dialect);
  }
  return dialects;
}

class Generator {
 public:
  explicit Generator(Tape& tape) : tape_(tape) {}

  Program generate() {
    for (int i = 0; i < 4; ++i) {
      bits_.push_back(
          out_.cell("I" + std::to_string(i), CellRole::Input, Type::Bit));
    }
    words_.push_back(out_.cell("W", CellRole::Input, Type::Word));
    std::vector<CellId> bits;
    for (int i = 0; i < 4; ++i) {
      bits.push_back(
          out_.cell("Q" + std::to_string(i), CellRole::Output, Type::Bit));
    }
    bits_.insert(bits_.end(), bits.begin(), bits.end());
    const CellId word = out_.cell("N", CellRole::Output, Type::Word);
    add_instances();
    const std::uint32_t rungs = 1 + tape_.pick(8);
    for (std::uint32_t i = 0; i < rungs; ++i) rung(bits, word);
    return out_.take();
  }

 private:
  void add_instances() {
    const std::vector<std::string_view> dialects = block_dialects();
    out_.set_dialect(
        dialects[tape_.pick(static_cast<std::uint32_t>(dialects.size()))]);
    std::vector<const ElementKind*> kinds;
    for (const ElementKind& kind : element_kinds()) {
      if (kind.is_in(out_.dialect()) && !kind.dialect.empty()) {
        kinds.push_back(&kind);
      }
    }
    const std::uint32_t count = 1 + tape_.pick(3);
    for (std::uint32_t i = 0; i < count; ++i) {
      const ElementKind* kind =
          kinds[tape_.pick(static_cast<std::uint32_t>(kinds.size()))];
      instances_.emplace_back(out_.instance(*kind, i), kind);
    }
  }

  std::uint32_t operand(ParameterKind kind) {
    if (kind == ParameterKind::Bit) {
      const std::uint32_t choice = tape_.pick(10);
      if (choice == 9) return out_.constant(Type::Bit, tape_.pick(2));
      return out_.read(bits_[choice % bits_.size()]);
    }
    constexpr std::array<std::int64_t, 6> kPresets = {2,  0,        1,
                                                      -1, kHighest, kLowest};
    const std::uint32_t choice = tape_.pick(10);
    if (choice > 5) return out_.read(words_[0]);
    return out_.constant(Type::Word, kPresets[choice]);
  }

  void rung(const std::vector<CellId>& bits, CellId word) {
    constexpr std::array<std::int64_t, 6> kTimes = {30, 0, 1, 10, 100, 250};
    const auto& [id, kind] =
        instances_[tape_.pick(static_cast<std::uint32_t>(instances_.size()))];
    const std::uint32_t choice =
        tape_.pick(static_cast<std::uint32_t>(kind->operations.size()) + 1);
    const ElementOperation& operation =
        kind->operations[choice % kind->operations.size()];
    const std::uint32_t begin = out_.begin();
    const bool guarded = !operation.word && tape_.pick(3) == 0;
    std::uint32_t left = 0;
    if (guarded) {
      left = operand(ParameterKind::Bit);
      out_.branch(left);
    }
    std::vector<std::uint32_t> arguments;
    for (const ElementParameter& parameter : operation.parameters) {
      if (parameter.kind == ParameterKind::Bit ||
          parameter.kind == ParameterKind::Word) {
        arguments.push_back(operand(parameter.kind));
      }
    }
    const std::int64_t time = has_preset(operation) ? kTimes[tape_.pick(6)] : 0;
    const std::uint32_t result =
        out_.call(id, operation, time, std::move(arguments));
    if (guarded) out_.join(left, result);
    out_.rung(operation.word ? word : bits[tape_.pick(4)], begin);
  }

  Tape& tape_;
  Writer out_;
  std::vector<CellId> bits_;
  std::vector<CellId> words_;
  std::vector<std::pair<InstanceId, const ElementKind*>> instances_;
};

}  // namespace

Program random_block_program(Tape& tape) { return Generator(tape).generate(); }

Program single_block(std::string_view kind_id) {
  const auto kinds = element_kinds();
  const auto kind =
      std::find_if(kinds.begin(), kinds.end(),
                   [&](const ElementKind& it) { return it.id == kind_id; });
  Writer out;
  std::vector<CellId> inputs;
  for (const ElementParameter& it : kind->operations.front().parameters) {
    if (it.kind != ParameterKind::Bit && it.kind != ParameterKind::Word) {
      continue;
    }
    inputs.push_back(
        out.cell(std::string(it.name), CellRole::Input,
                 it.kind == ParameterKind::Bit ? Type::Bit : Type::Word));
  }
  const InstanceId id = out.instance(*kind, 0);
  for (const ElementOperation& operation : kind->operations) {
    const CellId target =
        out.cell(operation.steps() ? "Q" : std::string(operation.name),
                 CellRole::Output, operation.word ? Type::Word : Type::Bit);
    const std::uint32_t begin = out.begin();
    std::vector<std::uint32_t> arguments;
    if (operation.steps()) {
      for (const CellId input : inputs) arguments.push_back(out.read(input));
    }
    out.call(id, operation, has_preset(operation) ? 30 : 0,
             std::move(arguments));
    out.rung(target, begin);
  }
  return out.take();
}

}  // namespace rung
