#include "frontend/plclib/machine.h"

#include <utility>

namespace rung::plclib {
namespace {

constexpr std::string_view kScanValue = "scanValue";
constexpr std::int64_t kLastPin = 69;  // of a Mega or a Due
// Above this, looking for a name in the accumulator costs more than a cell.
constexpr std::size_t kLongAccumulator = 64;
constexpr std::size_t kLongestCall = 100;  // tokens, of a timer
constexpr int kWideningPass = 3;
constexpr int kGiveUpPass = 6;

struct NamedPin {
  std::string_view name;
  std::int64_t number;
};
// Uno, as plcLib.h of the published library has them.
constexpr std::array<NamedPin, 8> kUnoPins = {{{"X0", 14},
                                               {"X1", 15},
                                               {"X2", 16},
                                               {"X3", 17},
                                               {"Y0", 3},
                                               {"Y1", 5},
                                               {"Y2", 6},
                                               {"Y3", 9}}};
constexpr std::array<NamedPin, 12> kThesisPins = {{{"X0", 2},
                                                   {"X1", 3},
                                                   {"X2", 4},
                                                   {"X3", 5},
                                                   {"X4", 6},
                                                   {"X5", 7},
                                                   {"Y0", 8},
                                                   {"Y1", 9},
                                                   {"Y2", 10},
                                                   {"Y3", 11},
                                                   {"Y4", 12},
                                                   {"Y5", 13}}};

std::span<const NamedPin> named_pins(bool thesis) {
  if (thesis) return kThesisPins;
  return kUnoPins;
}

}  // namespace

Machine::Machine(const TokenList& list, const Sketch& sketch,
                 const Reading& reading, Estimates& estimates, Ast& ast,
                 ErrorLimit& errors)
    : cursor_(list),
      list_(list),
      sketch_(sketch),
      reading_(reading),
      estimates_(estimates),
      ast_(ast),
      errors_(errors),
      writer_(ast),
      arithmetic_(writer_, reading.int_bits()) {}

void Machine::run() {
  mark_timers();
  declare_globals();
  for (const Task& task : sketch_.tasks) {
    task_elements_.push_back(writer_.element("task-plclib", task.function->name,
                                             task.function->where));
    task_runs_.push_back(0);
  }
  const Function* const setup = sketch_.find("setup");
  const Function* const loop = sketch_.find("loop");
  if (setup == nullptr || loop == nullptr) return;
  in_setup_ = true;
  execute(*setup);
  in_setup_ = false;
  // Whatever is left of the last scan.
  const Range range = estimates_.ranges[kScanValue];
  acc_ = Arithmetic::cell(kScanValue, !range.is_bit(), range, CType::Int,
                          loop->where);
  execute(*loop);
  check_calls();
  finish();
}

/// What is not executed is not read.
void Machine::check_calls() {
  std::vector<const Function*> unread;
  for (const auto& [name, function] : sketch_.functions) {
    if (!executed_.contains(&function)) unread.push_back(&function);
  }
  std::sort(
      unread.begin(), unread.end(),
      [](const Function* a, const Function* b) { return a->begin < b->begin; });
  for (const Function* const function : unread) {
    fail("RP055", function->where,
         quoted_excerpt(function->name) +
             " is never called here: what it does is not read");
  }
}

void Machine::fail(std::string_view code, SourceRange where,
                   std::string message) {
  errors_.error(code, where, std::move(message));
}

// --- declarations ------------------------------------------------------------

/// `unsigned long` variables that calls use as a timer's start.
void Machine::mark_timers() {
  struct Row {
    std::string_view name;
    std::size_t first;
    std::size_t second;
  };
  constexpr std::array<Row, 6> kRows = {{{"timerOn", 0, 0},
                                         {"timerOff", 0, 0},
                                         {"timerPulse", 0, 0},
                                         {"timerDelay", 0, 0},
                                         {"timerCycle", 0, 2},
                                         {"m8013", 0, 1}}};
  const std::vector<Token>& tokens = list_.tokens;
  const auto is = [&](std::size_t at, std::string_view text) {
    return at < tokens.size() && list_.text_of(tokens[at]) == text;
  };
  for (std::size_t at = 0; at + 2 < tokens.size(); ++at) {
    for (const Row& row : kRows) {
      if (!is(at, row.name) || !is(at + 1, "(")) continue;
      std::size_t argument = 0;
      const std::size_t end = std::min(tokens.size(), at + kLongestCall);
      for (std::size_t i = at + 2; i < end && argument <= row.second; ++i) {
        if (is(i, ";") || is(i, ")")) break;
        const bool begins = is(i - 1, "(") || is(i - 1, ",");
        if (begins && (argument == row.first || argument == row.second)) {
          variables_[list_.text_of(tokens[i])].timer = true;
        }
        if (is(i, ",")) ++argument;
      }
    }
  }
  // Only what is declared is a variable.
  std::unordered_map<std::string_view, Variable> declared;
  for (const Global& global : sketch_.globals) {
    const auto found = variables_.find(global.name);
    if (found == variables_.end() || global.object) continue;
    declared[global.name].timer = true;
  }
  variables_ = std::move(declared);
}

void Machine::declare_globals() {
  std::unordered_set<std::string_view> seen;
  for (const Global& global : sketch_.globals) {
    const bool taken =
        sketch_.find(global.name) != nullptr || find_call(global.name) ||
        global.name == kScanValue ||
        (!sketch_.no_pin_defs && pin_number(global.name).has_value() &&
         !variables_.contains(global.name));
    if (taken || !seen.insert(global.name).second) {
      fail("RP057", global.where,
           quoted_excerpt(global.name) +
               " is declared twice, or it is a name "
               "of the library");
      continue;
    }
    if (global.object) {
      declare_object(global);
    } else {
      declare_global(global);
    }
  }
}

void Machine::declare_global(const Global& global) {
  Variable variable;
  variable.timer = variables_.contains(global.name);
  variable.type = global.type;
  variable.constant = global.constant;
  variable.where = global.where;
  if (global.initialiser != 0) {
    cursor_.go_to(global.initialiser);
    variable.initial = constant_expression("an initial value").value_or(0);
    if (!range_of(global.type, reading_.int_bits())
             .contains({variable.initial, variable.initial})) {
      fail("RP055", global.where,
           "this initial value does not fit " +
               std::string(to_string(global.type)));
      variable.initial = 0;
    }
  }
  if (variable.timer && variable.initial != 0) {
    fail("RP058", global.where,
         "a timer's variable that does not begin with 0 is not supported");
  }
  if (variable.timer && variable.type != CType::UnsignedLong) {
    fail("RP058", global.where, "a timer's variable must be `unsigned long`");
  }
  note(global.name, {variable.initial, variable.initial}, variable.type);
  variables_.insert_or_assign(global.name, variable);
  order_.push_back(global.name);
}

void Machine::note(std::string_view name, Range range, CType type) {
  const auto [place, is_new] = estimates_.ranges.emplace(name, range);
  if (!is_new && place->second.contains(range)) return;
  place->second.join(range);
  if (is_new) return;
  if (estimates_.pass >= kWideningPass && !place->second.is_bit()) {
    place->second.join(range_of(type, reading_.int_bits()));
  }
  estimates_.grown = true;
}

Range Machine::estimate(std::string_view name, const Variable& variable) const {
  if (variable.constant) return {variable.initial, variable.initial};
  // A long chain of variables: no more is learned of each of them.
  if (estimates_.pass >= kGiveUpPass) {
    return range_of(variable.type, reading_.int_bits());
  }
  const auto found = estimates_.ranges.find(name);
  const Range range =
      found == estimates_.ranges.end() ? Range{} : found->second;
  // So a long chain of bits, as of a shift register, needs no pass for each.
  const bool chained = estimates_.pass >= kWideningPass && range.is_bit() &&
                       estimates_.assigned.contains(name);
  return chained ? Range{0, 1} : range;
}

/// A `long` is a number, whatever it may hold.
bool Machine::is_word(std::string_view name, const Variable& variable) const {
  return variable.type == CType::Long || !estimate(name, variable).is_bit();
}

void Machine::finish() {
  for (const auto& [name, object] : objects_) {
    if (object.pushed.empty()) continue;
    fail("RP055", object.where,
         quoted_excerpt(name) +
             " is not empty at the end of the scan: that is not supported");
  }
  bool used = false;
  for (const AstNode& node : ast_.nodes) {
    used = used || (node.op == AstOp::Name && node.text == kScanValue);
  }
  for (const AstAnnotation& line : list_.annotations) {
    used = used || line.text.find(kScanValue) != std::string_view::npos;
  }
  if (!used) {
    std::erase_if(ast_.rungs, [](const AstAssignment& rung) {
      return rung.target == kScanValue;
    });
  } else {
    flush();
    const Range range = estimates_.ranges[kScanValue];
    const std::uint32_t place = writer_.declare(
        kScanValue,
        range.is_bit() ? kBitCell : CellShape{true, range.low, range.high},
        AstDeclaration::Kind::Memory, sketch_.find("loop")->where);
    ast_.declarations[place].made = true;
  }
  declare_outputs();
}

void Machine::declare_outputs() {
  for (const std::int64_t number : pin_order_) {
    const Pin& pin = pins_.at(number);
    if (!pin.used || mode_of(pin) != Pin::Mode::Output) continue;
    const std::uint32_t place = writer_.declare(
        pin.name, pin.pulse_width ? CellShape{true, 0, 255} : kBitCell,
        AstDeclaration::Kind::Output, pin.where);
    ast_.declarations[place].initial = pin.initial;
    ast_.declarations[place].initialised = true;
  }
  for (const std::string_view name : order_) {
    const Variable& variable = variables_.at(name);
    if (variable.constant || variable.timer || variable.pin) continue;
    const Range range = estimate(name, variable);
    const std::uint32_t place = writer_.declare(
        name,
        is_word(name, variable) ? CellShape{true, range.low, range.high}
                                : kBitCell,
        AstDeclaration::Kind::Memory, variable.where);
    ast_.declarations[place].initial = variable.initial;
    ast_.declarations[place].initialised = true;
  }
}

// --- pins --------------------------------------------------------------------

std::optional<std::int64_t> Machine::pin_number(std::string_view name) const {
  if (!sketch_.no_pin_defs) {
    for (const NamedPin& pin : named_pins(reading_.thesis)) {
      if (pin.name == name) return pin.number;
    }
  }
  const std::int64_t first = reading_.thesis ? 54 : 14;
  if (name.size() == 2 && name[0] == 'A' && name[1] >= '0' && name[1] <= '7') {
    return first + (name[1] - '0');
  }
  return std::nullopt;
}

Machine::Pin* Machine::pin_at(std::int64_t number, std::string_view name,
                              SourceRange where) {
  if (number < 0 || number > kLastPin) {
    fail("RP058", where,
         std::to_string(number) +
             " is an `int`, so it is the number of a "
             "pin, and there is no such pin");
    return nullptr;
  }
  const auto [place, is_new] = pins_.try_emplace(number);
  Pin& pin = place->second;
  if (is_new) {
    pin.name =
        name.empty() ? writer_.keep_text("pin" + std::to_string(number)) : name;
    pin.where = where;
    pin_order_.push_back(number);
  } else if (!name.empty() && pin.name != name) {
    fail("RP057", where,
         quoted_excerpt(name) + " and " + quoted_excerpt(pin.name) +
             " are the same pin: only one name is supported");
    return nullptr;
  }
  return &pin;
}

Machine::Pin::Mode Machine::mode_of(const Pin& pin) const {
  if (pin.mode != Pin::Mode::Unknown || !modes_unknown_) {
    return pin.mode == Pin::Mode::Output ? Pin::Mode::Output : Pin::Mode::Input;
  }
  return estimates_.written_pins.contains(std::string(pin.name))
             ? Pin::Mode::Output
             : Pin::Mode::Input;
}

Value Machine::input_cell(std::string_view name, CellShape shape,
                          SourceRange where) {
  writer_.declare(name, shape, AstDeclaration::Kind::Input, where);
  return Arithmetic::cell(name, shape.word, {shape.low, shape.high}, CType::Int,
                          where);
}

/// What reading the pin gives at this moment.
Value Machine::sample(Pin& pin, bool analog, SourceRange where) {
  pin.used = true;
  if (mode_of(pin) == Pin::Mode::Output) {
    if (analog || pin.pulse_width) {
      fail("RP055", where,
           "reading " + quoted_excerpt(pin.name) +
               " gives what its wire has, not a bit that was written: that "
               "is not supported");
    }
    return Arithmetic::cell(pin.name, false, {0, 1}, CType::Int, where);
  }
  (analog ? pin.analog : pin.digital) = true;
  if (pin.analog && pin.digital) {
    fail("RP055", where,
         quoted_excerpt(pin.name) +
             " is read as a bit and as an analogue value: that is not "
             "supported");
  }
  const CellShape shape = analog ? CellShape{true, 0, 1023} : kBitCell;
  const Range range = {shape.low, shape.high};
  ++pin.reads;
  if (pin.reads == 1) return input_cell(pin.name, shape, where);
  if (reading_.stable_inputs) {
    return Arithmetic::cell(pin.name, shape.word, range, CType::Int, where);
  }
  Value value = input_cell(writer_.keep_text(std::string(pin.name) + "." +
                                             std::to_string(pin.reads)),
                           shape, where);
  ast_.declarations.back().made = true;
  return value;
}

void Machine::write_pin(Pin& pin, Value value, bool pulse_width,
                        SourceRange where) {
  if (estimates_.written_pins.insert(std::string(pin.name)).second &&
      modes_unknown_) {
    estimates_.grown = true;
  }
  if (mode_of(pin) != Pin::Mode::Output && !modes_unknown_) {
    fail("RP058", where,
         quoted_excerpt(pin.name) +
             " is written, but setup() makes it no "
             "output");
    return;
  }
  pin.used = true;
  (pulse_width ? pin.pulse_width : pin.digital) = true;
  if (pin.pulse_width && pin.digital) {
    fail("RP055", where,
         quoted_excerpt(pin.name) +
             " is written as a bit and as a pulse width: that is not "
             "supported");
    return;
  }
  write(pin.name, pulse_width, std::move(value), where);
}

// --- cells -------------------------------------------------------------------

void Machine::write(std::string_view name, bool word, Value value,
                    SourceRange where) {
  protect(name);
  value = word ? arithmetic_.word(std::move(value))
               : arithmetic_.truth(std::move(value));
  writer_.assign(name, word, where, value.nodes, where);
}

/// A bit that belongs to an object of the library.
void Machine::write_memory(std::string_view name, Value bit,
                           SourceRange where) {
  write(name, false, std::move(bit), where);
}

void Machine::assign(std::string_view name, Value value, SourceRange where) {
  const auto found = variables_.find(name);
  if (found == variables_.end()) {
    return fail("RP058", where, "this is no variable that can be written");
  }
  Variable& variable = found->second;
  if (variable.timer || variable.constant || variable.pin) {
    return fail("RP058", where,
                quoted_excerpt(name) +
                    (variable.timer ? " holds the start of a timer"
                     : variable.pin ? " is the number of a pin"
                                    : " is a constant") +
                    ": it cannot be assigned");
  }
  std::optional<Value> converted =
      arithmetic_.converted(std::move(value), variable.type);
  if (!converted) return fail("RP055", where, arithmetic_.why());
  note(name, converted->range, variable.type);
  if (in_setup_) {
    if (const auto constant = converted->constant()) {
      variable.initial = *constant;
      return;
    }
    return fail("RP055", where,
                "a value that is not constant in setup() is not supported");
  }
  estimates_.assigned.insert(name);
  write(name, is_word(name, variable), std::move(*converted), where);
}

/// The accumulator keeps its value when `name` is written.
void Machine::protect(std::string_view name) {
  for (const AstNode& node : acc_.nodes) {
    if (node.op != AstOp::Name || node.text != name) continue;
    const CellShape shape = {acc_.word, acc_.word ? acc_.range.low : 0,
                             acc_.word ? acc_.range.high : 1};
    const std::string_view kept =
        writer_.keep(kScanValue, shape, acc_.nodes, acc_.where);
    acc_ = Arithmetic::cell(kept, acc_.word, acc_.range, acc_.type, acc_.where);
    return;
  }
  shorten();
}

void Machine::shorten() {
  if (acc_.nodes.size() > kLongAccumulator) keep_accumulator();
}

void Machine::keep_accumulator() {
  acc_ = arithmetic_.kept(std::move(acc_), kScanValue);
}

/// The accumulator's value goes to its cell, where a task, a condition's end or
/// the next scan finds it.
void Machine::flush() {
  note(kScanValue, acc_.range, CType::Int);
  const Range range = estimates_.ranges[kScanValue];
  const bool word = !range.is_bit();
  const bool there =
      acc_.nodes.size() == 1 && acc_.nodes.front().text == kScanValue;
  if (!there) {
    const Value value = word ? arithmetic_.word(acc_) : arithmetic_.truth(acc_);
    writer_.assign(kScanValue, word, acc_.where, value.nodes, acc_.where);
  }
  acc_ = Arithmetic::cell(kScanValue, word, range, CType::Int, acc_.where);
}

bool Machine::accumulator_is_bit(const Call& call) {
  if (acc_.is_bit()) return true;
  fail("RP055", call.where,
       quoted_excerpt(call.name) +
           " of a `scanValue` that may be another "
           "number than 0 and 1 is not supported");
  return false;
}

/// The call of an element is made here, once, and not where its value is used.
Value Machine::kept_call(std::string_view operation, std::string_view prefix,
                         const Expression& operands, std::uint32_t index,
                         std::optional<std::int64_t> preset,
                         SourceRange where) {
  Expression nodes;
  if (!writer_.guard().empty()) {
    push_leaf(nodes, AstOp::Name, writer_.guard(), where);
  }
  push_all(nodes, writer_.call(operation, operands, index, preset, where));
  if (!writer_.guard().empty()) push_binary(nodes, AstOp::And, where);
  const std::string_view name = writer_.keep(prefix, kBitCell, nodes, where);
  return Arithmetic::cell(name, false, {0, 1}, CType::Int, where);
}

}  // namespace rung::plclib
