#include <utility>

#include "frontend/plclib/machine.h"

namespace rung::plclib {
namespace {

constexpr std::size_t kWidth = 16;  // of a Shift
constexpr std::size_t kStackDepth = 32;

// Cells of a Counter, a Shift (behind its bits) and a Pulse, by place.
constexpr std::array<std::string_view, 4> kCounterCells = {"upperQ", "lowerQ",
                                                           "up", "down"};
constexpr std::size_t kUpper = 0;
constexpr std::size_t kLower = 1;
constexpr std::size_t kUp = 2;
constexpr std::size_t kDown = 3;
constexpr std::size_t kCount = 4;
constexpr std::array<std::string_view, 3> kShiftCells = {"input", "left",
                                                         "right"};
constexpr std::size_t kInputBit = kWidth;
constexpr std::size_t kLeft = kWidth + 1;
constexpr std::size_t kRight = kWidth + 2;
constexpr std::array<std::string_view, 3> kPulseCells = {"clock", "rising",
                                                         "falling"};

}  // namespace

const Machine::Method* Machine::find_method(ObjectKind kind,
                                            std::string_view name) {
  using enum ObjectKind;
  static constexpr std::array<Method, 17> kMethods = {{
      {Counter, "countUp", false, &Machine::counter_up},
      {Counter, "countDown", false, &Machine::counter_down},
      {Counter, "preset", false, &Machine::counter_preset},
      {Counter, "clear", false, &Machine::counter_clear},
      {Counter, "upperQ", true, &Machine::counter_upper},
      {Counter, "lowerQ", true, &Machine::counter_lower},
      {Shift, "inputBit", false, &Machine::shift_input},
      {Shift, "shiftLeft", false, &Machine::shift_left},
      {Shift, "shiftRight", false, &Machine::shift_right},
      {Shift, "bitValue", true, &Machine::shift_bit},
      {Shift, "reset", false, &Machine::shift_reset},
      {Stack, "push", false, &Machine::stack_push},
      {Stack, "pop", false, &Machine::stack_pop},
      {Stack, "orBlock", false, &Machine::stack_or},
      {Stack, "andBlock", false, &Machine::stack_and},
      {Pulse, "inClock", false, &Machine::pulse_clock},
      {Pulse, "rising", false, &Machine::pulse_rising},
  }};
  static constexpr Method kFalling = {Pulse, "falling", false,
                                      &Machine::pulse_falling};
  for (const Method& method : kMethods) {
    if (method.kind == kind && method.name == name) return &method;
  }
  return kind == Pulse && name == kFalling.name ? &kFalling : nullptr;
}

void Machine::declare_object(const Global& global) {
  if (reading_.thesis) {
    return fail("RP058", global.where,
                quoted_excerpt(global.name) +
                    " is an object of the other library of this name: the "
                    "semantics are those of `plclib`");
  }
  std::vector<std::int64_t> given;
  if (global.initialiser != 0) {
    cursor_.go_to(global.initialiser);
    do {
      const auto value = constant_expression("the argument of an object");
      if (!value) return;
      given.push_back(*value);
    } while (cursor_.accept(","));
    if (!expect(")")) return;
  }
  Object object;
  object.kind = *global.object;
  object.where = global.where;
  const bool counter = object.kind == ObjectKind::Counter;
  const bool shift = object.kind == ObjectKind::Shift;
  const std::size_t most = counter ? 2 : shift ? 1 : 0;
  if (given.size() > most || (counter && given.empty())) {
    return fail("RP058", global.where,
                quoted_excerpt(global.name) +
                    " has a wrong number of "
                    "arguments");
  }
  object.preset = given.empty() ? 0 : given[0];
  if (object.preset < 0 || object.preset > 65'535) {
    return fail("RP058", global.where,
                "this number does not fit `unsigned int`");
  }
  declare_cells(object, global.name, given.size() == 2 && given[1] != 0);
  objects_.emplace(global.name, std::move(object));
}

/// `full`: a counter that begins at its upper end.
void Machine::declare_cells(Object& object, std::string_view name, bool full) {
  const auto add = [&](std::string_view suffix, CellShape shape,
                       std::int64_t initial) {
    object.cells.push_back(
        writer_.keep_text(std::string(name) + "." + std::string(suffix)));
    if (object.kind == ObjectKind::Shift && !is_used(object.cells.back())) {
      return;
    }
    const std::uint32_t place = writer_.declare(
        object.cells.back(), shape, AstDeclaration::Kind::Memory, object.where);
    ast_.declarations[place].initial = initial;
    ast_.declarations[place].initialised = true;
    ast_.declarations[place].made = true;
  };
  if (object.kind == ObjectKind::Counter) {
    for (const std::string_view cell : kCounterCells) {
      add(cell, kBitCell, cell == (full ? "upperQ" : "lowerQ") ? 1 : 0);
    }
    add("count", {true, 0, std::max<std::int64_t>(object.preset, 1)},
        full ? object.preset : 0);
  } else if (object.kind == ObjectKind::Shift) {
    for (std::size_t bit = 0; bit < kWidth; ++bit) {
      add("b" + std::to_string(bit), kBitCell, (object.preset >> bit) & 1);
    }
    for (const std::string_view cell : kShiftCells) add(cell, kBitCell, 0);
  } else if (object.kind == ObjectKind::Pulse) {
    for (const std::string_view cell : kPulseCells) add(cell, kBitCell, 0);
  }
}

std::optional<Value> Machine::method_call(bool wanted) {
  const SourceRange where = cursor_.here();
  const std::string_view name = cursor_.text();
  const auto found = objects_.find(name);
  const Method* const method =
      found == objects_.end()
          ? nullptr
          : find_method(found->second.kind, cursor_.text(2));
  if (method == nullptr || in_setup_) {
    fail("RP055", where,
         "the call of " +
             quoted_excerpt(std::string(name) + "." +
                            std::string(cursor_.text(2))) +
             " is not supported" + (in_setup_ ? " in setup()" : ""));
    return std::nullopt;
  }
  for (int i = 0; i < 3; ++i) cursor_.take();
  if (!expect("(")) return std::nullopt;
  auto given = arguments();
  if (!given) return std::nullopt;
  const std::size_t arity = method->run == &Machine::shift_bit ? 1 : 0;
  if (given->size() != arity) {
    fail("RP056", where,
         quoted_excerpt(method->name) + " has " + std::to_string(arity) +
             (arity == 1 ? " argument" : " arguments"));
    return std::nullopt;
  }
  const Call call{method->name, std::move(*given), where};
  (this->*method->run)(found->second, call);
  Value value;
  value.type = CType::Void;
  if (!method->result || !wanted) return value;
  keep_accumulator();
  value = acc_;
  value.type = CType::Unsigned;
  return value;
}

/// A bit in a cell of its own, whatever is written after it.
Value Machine::fresh(const Value& bit, std::string_view prefix) {
  const std::string_view name =
      writer_.keep(prefix, kBitCell, bit.nodes, bit.where);
  return Arithmetic::cell(name, false, {0, 1}, CType::Unsigned, bit.where);
}

Value Machine::bit_of(const Object& object, std::size_t cell,
                      SourceRange where) {
  return Arithmetic::cell(object.cells[cell], false, {0, 1}, CType::Unsigned,
                          where);
}

// --- Counter -----------------------------------------------------------------

Value Machine::count_of(const Object& object, SourceRange where) {
  return Arithmetic::cell(object.cells[kCount], true, {0, object.preset},
                          CType::Unsigned, where);
}

/// At the end of its range a counter does not look at the clock: the edge
/// memory stays as it was.
void Machine::step_counter(Object& object, const Call& call, bool up) {
  const SourceRange where = call.where;
  if (object.preset == 0) return;  // the range has one value
  keep_accumulator();
  const std::size_t edge_cell = up ? kUp : kDown;
  const std::int64_t end = up ? object.preset : 0;
  const auto at_end = [&] {
    return *arithmetic_.binary("==", count_of(object, where),
                               arithmetic_.number(end, CType::Unsigned, where),
                               where);
  };
  const Value live = arithmetic_.kept(Arithmetic::negation(at_end()), "live");
  const Value clock = arithmetic_.kept(arithmetic_.truth(acc_), "clock");
  const Value memory = bit_of(object, edge_cell, where);
  const Value counts = arithmetic_.kept(
      Arithmetic::conjunction(
          live, Arithmetic::conjunction(clock, Arithmetic::negation(memory))),
      "counts");
  write_memory(object.cells[edge_cell],
               Arithmetic::disjunction(
                   Arithmetic::conjunction(live, clock),
                   Arithmetic::conjunction(Arithmetic::negation(live), memory)),
               where);
  Value next = *arithmetic_.binary(up ? "+" : "-", count_of(object, where),
                                   counts, where);
  write(object.cells[kCount], true, std::move(next), where);
  const auto after = [&](std::size_t cell, bool reaches) {
    const Value stays = Arithmetic::conjunction(Arithmetic::negation(counts),
                                                bit_of(object, cell, where));
    write_memory(object.cells[cell],
                 reaches ? Arithmetic::disjunction(
                               Arithmetic::conjunction(counts, at_end()), stays)
                         : stays,
                 where);
  };
  after(kUpper, up);
  after(kLower, !up);
}

void Machine::load_counter(Object& object, const Call& call, bool full) {
  const SourceRange where = call.where;
  keep_accumulator();
  const Value loads = fresh(arithmetic_.is_one(acc_), "loads");
  write(object.cells[kCount], true,
        arithmetic_.choose(loads,
                           arithmetic_.number(full ? object.preset : 0,
                                              CType::Unsigned, where),
                           count_of(object, where), where),
        where);
  const auto load = [&](std::size_t cell, bool value) {
    const Value old = bit_of(object, cell, where);
    write_memory(
        object.cells[cell],
        value ? Arithmetic::disjunction(loads, old)
              : Arithmetic::conjunction(Arithmetic::negation(loads), old),
        where);
  };
  load(kUpper, full);
  load(kLower, !full);
  load(kUp, false);
  load(kDown, false);
}

void Machine::counter_upper(Object& object, const Call& call) {
  acc_ = bit_of(object, kUpper, call.where);
}

void Machine::counter_lower(Object& object, const Call& call) {
  acc_ = bit_of(object, kLower, call.where);
}

// --- Shift -------------------------------------------------------------------

void Machine::shift_input(Object& object, const Call& call) {
  keep_accumulator();
  write_memory(object.cells[kInputBit], arithmetic_.truth(acc_), call.where);
}

/// The cells of a Shift are its bits and the edge memories that calls use.
bool Machine::is_used(std::string_view cell) const {
  return !(cell.ends_with(".left") || cell.ends_with(".right")) ||
         estimates_.shifts.contains(std::string(cell));
}

/// A right shift puts the input bit into bit 15, a left one into bit 0.
void Machine::shift(Object& object, const Call& call, bool left) {
  const SourceRange where = call.where;
  keep_accumulator();
  const Value clock = arithmetic_.kept(arithmetic_.truth(acc_), "clock");
  const std::size_t edge_cell = left ? kLeft : kRight;
  if (estimates_.shifts.insert(std::string(object.cells[edge_cell])).second) {
    estimates_.grown = true;
  }
  const Value shifts = arithmetic_.kept(
      Arithmetic::conjunction(
          clock, Arithmetic::negation(bit_of(object, edge_cell, where))),
      "shifts");
  write_memory(object.cells[edge_cell], clock, where);
  for (std::size_t i = 0; i < kWidth; ++i) {
    const std::size_t bit = left ? kWidth - 1 - i : i;
    const bool last = i + 1 == kWidth;
    const std::size_t from = last ? kInputBit : left ? bit - 1 : bit + 1;
    write_memory(
        object.cells[bit],
        Arithmetic::disjunction(
            Arithmetic::conjunction(shifts, bit_of(object, from, where)),
            Arithmetic::conjunction(Arithmetic::negation(shifts),
                                    bit_of(object, bit, where))),
        where);
  }
}

void Machine::shift_bit(Object& object, const Call& call) {
  const auto given = argument_value(call.arguments[0]);
  const auto bit = given ? given->constant() : std::nullopt;
  if (!bit || *bit < 0 || *bit >= static_cast<std::int64_t>(kWidth)) {
    return fail("RP058", call.arguments[0].where,
                "the number of a bit must be constant, from 0 to 15");
  }
  acc_ = bit_of(object, static_cast<std::size_t>(*bit), call.where);
}

void Machine::shift_reset(Object& object, const Call& call) {
  keep_accumulator();
  const Value stays =
      arithmetic_.kept(Arithmetic::negation(arithmetic_.is_one(acc_)), "stays");
  for (std::size_t cell = 0; cell < object.cells.size(); ++cell) {
    if (cell == kInputBit || !is_used(object.cells[cell])) continue;
    write_memory(
        object.cells[cell],
        Arithmetic::conjunction(stays, bit_of(object, cell, call.where)),
        call.where);
  }
}

// --- Stack -------------------------------------------------------------------

// What stands on a stack is known where it is used, as long as the statements
// between a push and its end are always executed together.
void Machine::stack_push(Object& object, const Call& call) {
  if (!writer_.guard().empty()) {
    return fail("RP055", call.where,
                "a stack under a condition or in a task is not supported");
  }
  if (object.pushed.size() >= kStackDepth) {
    return fail("RP058", call.where,
                "the stack has 32 levels: the oldest value is lost here");
  }
  object.pushed.push_back(fresh(arithmetic_.is_one(acc_), "stack"));
}

void Machine::stack_join(Object& object, const Call& call,
                         std::string_view op) {
  if (object.pushed.empty() || !writer_.guard().empty()) {
    return fail(
        "RP058", call.where,
        object.pushed.empty()
            ? "nothing was pushed in this scan"
            : "a stack under a condition or in a task is not supported");
  }
  Value top = std::move(object.pushed.back());
  object.pushed.pop_back();
  std::optional<Value> value =
      op.empty()
          ? std::optional(std::move(top))
          : arithmetic_.binary(op, std::move(acc_), std::move(top), call.where);
  if (!value) {
    fail("RP055", call.where, arithmetic_.why());
    value = arithmetic_.number(0, CType::Int, call.where);
  }
  acc_ = std::move(*value);
}

// --- Pulse -------------------------------------------------------------------

void Machine::pulse_clock(Object& object, const Call& call) {
  if (!accumulator_is_bit(call)) return;
  const SourceRange where = call.where;
  keep_accumulator();
  const Value now = fresh(arithmetic_.truth(acc_), "clock");
  const Value was = bit_of(object, 0, where);
  write_memory(object.cells[1],
               Arithmetic::conjunction(now, Arithmetic::negation(was)), where);
  write_memory(object.cells[2],
               Arithmetic::conjunction(Arithmetic::negation(now), was), where);
  write_memory(object.cells[0], now, where);
}

void Machine::pulse_rising(Object& object, const Call& call) {
  acc_ = bit_of(object, 1, call.where);
}

void Machine::pulse_falling(Object& object, const Call& call) {
  acc_ = bit_of(object, 2, call.where);
}

}  // namespace rung::plclib
