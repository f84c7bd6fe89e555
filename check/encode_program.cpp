#include <utility>

#include "check/elements.h"
#include "check/model.h"

namespace rung::check {
namespace {

constexpr std::uint32_t kNoState = ProgramValues::kNoState;

/// A number that an element may be given: no count or time of a program is
/// near it, and fifty times it still is a number.
constexpr std::int64_t kLargestPreset = std::int64_t{1} << 45;

class ScanEncoder {
 public:
  ScanEncoder(const Program& program, Model& model, const Side& side)
      : program_(program), model_(model), terms_(model.terms()), side_(side) {}

  ProgramValues encode() {
    if (model_.dt.terms == nullptr) {
      model_.dt = model_.add_input("dt", true, program_.scan.min_ms,
                                   program_.scan.max_ms);
    }
    for (const CellId id : ids_of(program_.cells)) declare(program_.cells[id]);
    for (const InstanceId id : ids_of(program_.instances)) declare(id);
    if (!model_.unknown_element.empty()) return std::move(values_);
    nodes_.resize(program_.nodes.size());
    for (const Rung& rung : program_.rungs) run(rung);
    finish();
    return std::move(values_);
  }

 private:
  // --- what there is ---------------------------------------------------------

  void declare(const Cell& cell) {
    const bool word = cell.type == Type::Word;
    const std::string name = side_.prefix + cell.name;
    if (cell.role == CellRole::Input) {
      const auto same = side_.inputs.find(cell.name);
      values_.cells.push_back(
          same != side_.inputs.end()
              ? same->second
              : model_.add_input(name, word, cell.low, cell.high));
      values_.cell_state.push_back(kNoState);
      return;
    }
    const std::uint32_t state = model_.add_state(name, word, cell.initial);
    if (word) model_.claim(state, cell.low, cell.high);
    model_.name(name, model_.states[state].now);
    values_.cells.push_back(model_.states[state].now);
    values_.cell_state.push_back(state);
  }

  void declare(InstanceId id) {
    const Instance& instance = program_.instances[id];
    const Kind* const kind = find_kind(instance.kind->id);
    kinds_.push_back(kind);
    std::vector<Value> now;
    std::vector<std::uint32_t> states;
    const bool usable = kind != nullptr &&
                        instance.largest_parameter < kLargestPreset &&
                        instance.largest_parameter > -kLargestPreset;
    if (!usable) {
      if (model_.unknown_element.empty()) {
        model_.unknown_element = instance.name;
      }
    } else {
      for (const ElementState& state : kind->states) {
        states.push_back(declare(id, state));
        now.push_back(model_.states[states.back()].now);
      }
      pass_time(instance, *kind, now);
    }
    values_.elements.push_back(std::move(now));
    values_.element_state.push_back(std::move(states));
    values_.fired.push_back(terms_.bit(false));
  }

  std::uint32_t declare(InstanceId id, const ElementState& row) {
    const Instance& instance = program_.instances[id];
    const bool own = side_.clock_caps.empty();
    const bool word = row.shape != StateShape::Bit;
    const std::string name =
        side_.prefix + instance.name + "." + std::string(row.name);
    const std::uint32_t state = model_.add_state(name, word, 0);
    Value seen = model_.states[state].now;
    if (row.shape == StateShape::Clock) {
      model_.claim(state, 0, {});
      const std::int64_t cap =
          own ? instance.clock_cap : side_.clock_caps[id.index()];
      seen = smaller(seen, terms_.number(cap));
    } else if (row.shape == StateShape::Count) {
      claim_count(state, row, instance.largest_parameter);
      const Value floor = terms_.number(row.floor);
      if (own && row.floor != INT64_MIN)
        seen = choose(seen < floor, floor, seen);
    }
    model_.name(name, seen);
    return state;
  }

  void claim_count(std::uint32_t state, const ElementState& row,
                   std::int64_t preset) {
    std::optional<std::int64_t> low;
    std::optional<std::int64_t> high;
    if (row.low != nullptr) low = row.low(preset);
    if (row.high != nullptr) high = row.high(preset);
    model_.claim(state, low, high);
  }

  /// Before the first rung, every clock that runs grows by the scan's time.
  void pass_time(const Instance& instance, const Kind& kind,
                 std::vector<Value>& now) {
    if (kind.running == nullptr) return;
    const std::vector<Value> none;
    Element element(terms_, now, none, instance.largest_parameter,
                    program_.scan.max_ms);
    const Value runs = kind.running(element);
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (kind.states[i].shape != StateShape::Clock) continue;
      now[i] = choose(runs, now[i] + model_.dt, now[i]);
    }
  }

  // --- the rungs -------------------------------------------------------------

  /// Nodes in the order of execution. Behind a Branch they are executed only
  /// where the left operand does not decide.
  void run(const Rung& rung) {
    std::vector<std::pair<std::uint32_t, Value>> outer;  // until this node
    Value executed = terms_.bit(true);
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      while (!outer.empty() && outer.back().first == i) {
        executed = outer.back().second;
        outer.pop_back();
      }
      const Node& node = program_.nodes[i];
      if (node.op == NodeOp::Branch) {
        outer.emplace_back(node.target, executed);
        const Value left = nodes_[node.a];
        executed = executed & (node.skip_when ? ~left : left);
      } else {
        nodes_[i] =
            node.op == NodeOp::Call ? call(node.call, executed) : compute(node);
      }
    }
    values_.cells[rung.target.index()] = nodes_[rung.root()];
  }

  Value compute(const Node& node) {
    const Value a = nodes_[node.a];
    const Value b = nodes_[node.b];
    switch (node.op) {
      case NodeOp::Constant:
        return node.type == Type::Bit ? terms_.bit(node.value != 0)
                                      : terms_.number(node.value);
      case NodeOp::Read:
        return values_.cells[node.cell.index()];
      case NodeOp::Not:
        return ~a;
      case NodeOp::And:
        return a & b;
      case NodeOp::Or:
        return a | b;
      case NodeOp::Xor:
        return a ^ b;
      case NodeOp::Equal:
        return a == b;
      case NodeOp::NotEqual:
        return ~(a == b);
      case NodeOp::Less:
        return a < b;
      case NodeOp::LessEqual:
        return a <= b;
      case NodeOp::Greater:
        return a > b;
      case NodeOp::GreaterEqual:
        return a >= b;
      default:
        return compute_word(node, a, b);
    }
  }

  Value compute_word(const Node& node, Value a, Value b) {
    switch (node.op) {
      case NodeOp::Add:
        return a + b;
      case NodeOp::Subtract:
        return a - b;
      case NodeOp::Multiply:
        return a * b;
      case NodeOp::Divide:
        return divide(a, b);
      case NodeOp::Negate:
        return terms_.number(0) - a;
      case NodeOp::Wrap16:
        return terms_.make(Op::Wrap, true, a, {}, {}, -16);
      case NodeOp::Wrap:
        return terms_.make(Op::Wrap, true, a, {}, {}, node.value);
      case NodeOp::ToWord:
        return choose(a, 1, terms_.number(0));
      default:  // ToBit
        return ~(a == 0);
    }
  }

  Value divide(Value a, Value b) {
    const Term divisor = terms_[b.id];
    if (divisor.op == Op::Number && divisor.value != 0) {
      return terms_.make(Op::Divide, true, a, {}, {}, divisor.value);
    }
    model_.unknown_element = "a division by what is no number";
    return a;
  }

  Value call(CallId id, Value executed) {
    const ElementCall& call = program_.calls[id];
    const std::size_t instance = call.instance.index();
    const Operation* const operation =
        find_operation(*kinds_[instance], call.operation->name);
    if (operation == nullptr || call.parameter >= kLargestPreset ||
        call.parameter <= -kLargestPreset) {
      model_.unknown_element = program_.instances[call.instance].name + " " +
                               std::string(call.operation->name);
      return call.operation->word ? terms_.number(0) : terms_.bit(false);
    }
    std::vector<Value> arguments;
    for (const std::uint32_t node : call.arguments) {
      arguments.push_back(nodes_[node]);
    }
    std::vector<Value>& states = values_.elements[instance];
    const std::vector<Value> before = states;
    Element element(terms_, states, arguments, call.parameter,
                    program_.scan.max_ms);
    const Value result = operation->step(element);
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i] = choose(executed, states[i], before[i]);
    }
    if (operation->fires) {
      Value& fired = values_.fired[instance];
      fired = fired | (executed & result);
    }
    return result;
  }

  void finish() {
    for (std::size_t i = 0; i < values_.cells.size(); ++i) {
      const std::uint32_t state = values_.cell_state[i];
      if (state != kNoState) model_.states[state].next = values_.cells[i];
    }
    for (std::size_t i = 0; i < values_.elements.size(); ++i) {
      for (std::size_t j = 0; j < values_.elements[i].size(); ++j) {
        model_.states[values_.element_state[i][j]].next =
            values_.elements[i][j];
      }
    }
  }

  const Program& program_;
  Model& model_;
  Terms& terms_;
  const Side& side_;
  ProgramValues values_;
  std::vector<const Kind*> kinds_;  // by InstanceId
  std::vector<Value> nodes_;
};

}  // namespace

ProgramValues encode_program(const Program& program, Model& model,
                             const Side& side) {
  return ScanEncoder(program, model, side).encode();
}

}  // namespace rung::check
