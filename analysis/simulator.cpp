#include "analysis/simulator.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>

#include "analysis/simulator_elements.h"
#include "analysis/simulator_plant.h"
#include "analysis/simulator_word.h"

namespace rung {
namespace {

using Word = std::int64_t;

Word divide(Word a, Word b) {
  assert(b != 0);
  return b == -1 ? saturating_subtract(0, a) : a / b;
}

/// The low bits; of -bits, the uppermost of them is the sign.
Word wrapped(Word a, Word bits) {
  const Word modulus = Word{1} << (bits < 0 ? -bits : bits);
  Word rest = a % modulus;
  if (rest < 0) rest += modulus;
  return bits < 0 && rest >= modulus / 2 ? rest - modulus : rest;
}

// Operators whose value is a function of their operands' values.
Word compute(NodeOp op, Word a, Word b) {
  switch (op) {
    case NodeOp::Not:
      return a ^ 1;
    case NodeOp::And:
      return a & b;
    case NodeOp::Or:
      return a | b;
    case NodeOp::Xor:
      return a ^ b;
    case NodeOp::Equal:
      return a == b ? 1 : 0;
    case NodeOp::NotEqual:
      return a != b ? 1 : 0;
    case NodeOp::Less:
      return a < b ? 1 : 0;
    case NodeOp::LessEqual:
      return a <= b ? 1 : 0;
    case NodeOp::Greater:
      return a > b ? 1 : 0;
    case NodeOp::GreaterEqual:
      return a >= b ? 1 : 0;
    case NodeOp::Add:
      return saturating_add(a, b);
    case NodeOp::Subtract:
      return saturating_subtract(a, b);
    case NodeOp::Multiply:
      return saturating_multiply(a, b);
    case NodeOp::Divide:
      return divide(a, b);
    case NodeOp::Negate:
      return saturating_subtract(0, a);
    case NodeOp::Wrap16:
      return static_cast<std::int16_t>(static_cast<std::uint16_t>(a));
    case NodeOp::ToWord:
      return a;
    case NodeOp::ToBit:
      return a != 0 ? 1 : 0;
    case NodeOp::Constant:
    case NodeOp::Read:
    case NodeOp::Call:
    case NodeOp::Branch:
    case NodeOp::Wrap:
      break;  // run_rung() has them
  }
  return 0;
}

enum class Step : std::uint8_t { Constant, Read, Call, Branch, Wrap, Compute };

// A node of Program::nodes, with what the loop needs and no more.
struct Instruction {
  Step step = Step::Constant;
  NodeOp op = NodeOp::Constant;
  bool skip_when = false;
  std::uint32_t a = 0;  // operand; Read: cell; Call: call
  std::uint32_t b = 0;  // operand; Branch: target; Wrap: its bits
};

struct RungCode {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t target = 0;
};

struct CallCode {
  decltype(SimulatedOperation::execute) execute = nullptr;
  std::uint32_t instance = 0;
  std::uint32_t arguments = 0;  // how many of `argument`
  std::array<std::uint32_t, 5> argument = {0, 0, 0, 0, 0};
  std::int64_t parameter = 0;
};

// Nodes [begin, end) were not executed in this scan.
struct Skipped {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

Instruction compile_node(const Node& node) {
  if (node.op == NodeOp::Constant) return {Step::Constant, node.op};
  if (node.op == NodeOp::Read) {
    return {Step::Read, node.op, false, node.cell.index()};
  }
  if (node.op == NodeOp::Call) {
    return {Step::Call, node.op, false, node.call.index()};
  }
  if (node.op == NodeOp::Branch) {
    return {Step::Branch, node.op, node.skip_when, node.a, node.target};
  }
  if (node.op == NodeOp::Wrap) {
    const auto bits = static_cast<std::int32_t>(node.value);
    return {Step::Wrap, node.op, false, node.a,
            static_cast<std::uint32_t>(bits)};
  }
  return {Step::Compute, node.op, false, node.a, node.b};
}

CallCode compile_call(const Program& program, const ElementCall& call) {
  const ElementKind& kind = *program.instances[call.instance].kind;
  const SimulatedOperation* const operation =
      find_simulated(kind, *call.operation);
  assert(operation != nullptr && call.arguments.size() <= 5);
  if (operation == nullptr || call.arguments.size() > 5) std::abort();
  CallCode result;
  result.execute = operation->execute;
  result.instance = call.instance.index();
  result.arguments = static_cast<std::uint32_t>(call.arguments.size());
  std::copy(call.arguments.begin(), call.arguments.end(),
            result.argument.begin());
  // Out of reach of any run, and small enough for 50 times the count.
  constexpr std::int64_t kLargest = std::int64_t{1} << 56;
  result.parameter = std::clamp(call.parameter, -kLargest, kLargest);
  return result;
}

}  // namespace

struct Simulator::Impl {
  explicit Impl(const Program& source);

  void reset();
  void run_rung(const RungCode& rung);
  Word call(const CallCode& code);
  bool only_time_passed(std::int64_t dt_ms) const;
  bool restarted(std::size_t element) const {
    return elements[element].t0 == clock.now;
  }

  const Program& program;
  std::vector<Instruction> instructions;
  std::vector<RungCode> rungs;
  std::vector<CallCode> calls;
  std::vector<const SimulatedShape*> shapes;  // by InstanceId
  PlantMachine plant;

  std::vector<Word> values;  // by node
  std::vector<Word> cells;   // by CellId
  std::vector<SimulatedElement> elements;
  std::vector<Skipped> skipped;  // in this scan, ascending
  ElementClock clock;
  std::uint64_t scans = 0;
  std::int64_t last_dt = 0;

  // As idle_scans() last saw it.
  struct Snapshot {
    std::vector<Word> cells;
    std::vector<SimulatedElement> elements;
    std::int64_t now = 0;
    std::uint64_t scans = 0;
  };
  Snapshot seen;
};

Simulator::Impl::Impl(const Program& source)
    : program(source), plant(source), values(source.nodes.size()) {
  instructions.reserve(source.nodes.size());
  for (std::size_t i = 0; i < source.nodes.size(); ++i) {
    const Node& node = source.nodes[i];
    instructions.push_back(compile_node(node));
    if (node.op == NodeOp::Constant) values[i] = node.value;
  }
  rungs.reserve(source.rungs.size());
  for (const Rung& rung : source.rungs) {
    rungs.push_back({rung.begin, rung.end, rung.target.index()});
  }
  for (const Instance& instance : source.instances) {
    shapes.push_back(find_shape(*instance.kind));
  }
  for (const ElementCall& call : source.calls) {
    calls.push_back(compile_call(source, call));
  }
  reset();
}

void Simulator::Impl::reset() {
  cells.clear();
  for (const Cell& cell : program.cells) cells.push_back(cell.initial);
  elements.assign(program.instances.size(), {});
  skipped.clear();
  clock = {};
  scans = 0;
  last_dt = 0;
  seen = {};
  plant.reset(cells);
}

Word Simulator::Impl::call(const CallCode& code) {
  ElementInputs inputs;
  inputs.parameter = code.parameter;
  for (std::uint32_t i = 0; i < code.arguments; ++i) {
    inputs.value[i] = values[code.argument[i]];
  }
  return code.execute(elements[code.instance], inputs, clock);
}

void Simulator::Impl::run_rung(const RungCode& rung) {
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    const Instruction& node = instructions[i];
    switch (node.step) {
      case Step::Constant:
        break;  // never changes
      case Step::Read:
        values[i] = cells[node.a];
        break;
      case Step::Call:
        values[i] = call(calls[node.a]);
        break;
      case Step::Branch:
        if ((values[node.a] != 0) == node.skip_when) {
          values[node.b] = values[node.a];
          skipped.push_back({i + 1, node.b});
          i = node.b;
        }
        break;
      case Step::Compute:
        values[i] = compute(node.op, values[node.a], values[node.b]);
        break;
      case Step::Wrap:
        values[i] = wrapped(values[node.a], static_cast<std::int32_t>(node.b));
        break;
    }
  }
  cells[rung.target] = values[rung.end - 1];
}

// Was the last scan the same as the one before, and will the next be, as long
// as no timer fires? The scan reads cells, the elements' bits and counts, and
// times only as `now - t0` compared with presets. When the first two are the
// same after both scans, they were the same before the last one. A timer that
// both scans restarted showed in the last scan `dt` before the restart and 0
// after it, and will again; the times of all others go up by dt, and how far
// they may go is clock.next_event.
bool Simulator::Impl::only_time_passed(std::int64_t dt_ms) const {
  if (seen.scans + 1 != scans || last_dt != dt_ms) return false;
  if (seen.cells != cells) return false;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!same_but_for_time(seen.elements[i], elements[i])) return false;
    if ((seen.elements[i].t0 == seen.now) != restarted(i)) return false;
  }
  return true;
}

Simulator::Simulator(const Program& program)
    : impl_(std::make_unique<Impl>(program)) {}

Simulator::~Simulator() = default;

void Simulator::reset() { impl_->reset(); }

void Simulator::set_input(CellId cell, std::int64_t value) {
  assert(impl_->program.cells[cell].role == CellRole::Input);
  const bool is_bit = impl_->program.cells[cell].type == Type::Bit;
  impl_->cells[cell.index()] = is_bit ? (value != 0 ? 1 : 0) : value;
}

void Simulator::scan(std::int64_t dt_ms) {
  assert(dt_ms >= 0);
  impl_->clock.now = saturating_add(impl_->clock.now, dt_ms);
  impl_->clock.longest_scan = impl_->program.scan.max_ms;
  impl_->clock.next_event = ElementClock::kNever;
  impl_->skipped.clear();
  for (const RungCode& rung : impl_->rungs) impl_->run_rung(rung);
  impl_->last_dt = dt_ms;
  ++impl_->scans;
}

void Simulator::run_plant() { impl_->plant.run(impl_->cells); }

bool Simulator::has_plant() const { return !impl_->plant.empty(); }

std::uint64_t Simulator::idle_scans(std::int64_t dt_ms) {
  Impl& impl = *impl_;
  const bool idle = impl.only_time_passed(dt_ms);
  impl.seen.scans = impl.scans;
  impl.seen.now = impl.clock.now;
  impl.seen.elements = impl.elements;
  if (!idle) {
    impl.seen.cells = impl.cells;
    return 0;
  }
  constexpr std::int64_t kNever = ElementClock::kNever;
  if (dt_ms == 0 || impl.clock.next_event == kNever) return kNever;
  // The scan at which `next_event` ms have passed is not one of them.
  return static_cast<std::uint64_t>((impl.clock.next_event - 1) / dt_ms);
}

void Simulator::skip(std::uint64_t count, std::int64_t dt_ms) {
  if (count == 0) return;
  Impl& impl = *impl_;
  const std::int64_t time =
      saturating_multiply(static_cast<std::int64_t>(count), dt_ms);
  const std::int64_t later = saturating_add(impl.clock.now, time);
  for (std::size_t i = 0; i < impl.elements.size(); ++i) {
    if (impl.restarted(i)) impl.elements[i].t0 = later;
  }
  impl.clock.now = later;
  impl.scans += count;
}

std::int64_t Simulator::value(CellId cell) const {
  return impl_->cells[cell.index()];
}

std::int64_t Simulator::elapsed(InstanceId instance) const {
  const std::uint32_t i = instance.index();
  return elapsed_ms(impl_->shapes[i], impl_->elements[i], impl_->clock.now);
}

std::int64_t Simulator::count(InstanceId instance) const {
  return impl_->elements[instance.index()].count;
}

bool Simulator::done(InstanceId instance) const {
  const std::uint32_t i = instance.index();
  const SimulatedShape* const shape = impl_->shapes[i];
  return shape != nullptr &&
         shape->done(impl_->elements[i],
                     impl_->program.instances[instance].largest_parameter,
                     impl_->clock.now);
}

bool Simulator::elapsed_grows(InstanceId instance) const {
  const std::uint32_t i = instance.index();
  return is_running(impl_->shapes[i], impl_->elements[i]) &&
         !impl_->restarted(i);
}

bool Simulator::node_executed(std::uint32_t index) const {
  const auto after = std::upper_bound(
      impl_->skipped.begin(), impl_->skipped.end(), index,
      [](std::uint32_t node, const Skipped& run) { return node < run.begin; });
  const bool is_skipped =
      after != impl_->skipped.begin() && index < std::prev(after)->end;
  return impl_->scans > 0 && !is_skipped;
}

std::int64_t Simulator::node_value(std::uint32_t index) const {
  return node_executed(index) ? impl_->values[index] : 0;
}

std::int64_t Simulator::now_ms() const { return impl_->clock.now; }

std::uint64_t Simulator::scans() const { return impl_->scans; }

}  // namespace rung
