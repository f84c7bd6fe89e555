#include <utility>

#include "frontend/plclib/machine.h"

namespace rung::plclib {
namespace {

constexpr std::size_t kDeepest = 200;
constexpr std::size_t kMostTurns = 256;
constexpr std::size_t kMostSteps = 20'000;
constexpr std::size_t kMostNodes = 2'000'000;
constexpr std::size_t kMostTokens = 4'000'000;

}  // namespace

bool Machine::expect(std::string_view symbol) {
  if (cursor_.accept(symbol)) return true;
  fail("RP056", cursor_.here(),
       "expected " + quoted_excerpt(symbol) + " and found " + cursor_.shown());
  return false;
}

// --- frames ------------------------------------------------------------------

void Machine::enter(const Function& function, Frame::Kind kind) {
  for (const Frame& frame : frames_) {
    if (frame.function != &function) continue;
    fail("RP055", cursor_.here(),
         quoted_excerpt(function.name) +
             " is called while it is executed: that is not supported");
    stopped_ = true;
    return;
  }
  executed_.insert(&function);
  frames_.push_back({.kind = kind,
                     .outer = writer_.guard(),
                     .position = cursor_.position(),
                     .function = &function,
                     .task = level_,
                     .where = cursor_.here()});
  cursor_.go_to(function.begin);
}

void Machine::execute(const Function& function) {
  frames_.clear();
  stopped_ = false;
  level_ = 0;
  enter(function, Frame::Kind::Function);
  while (!frames_.empty() && !stopped_) step();
}

void Machine::step() {
  if (too_large()) return;
  Frame& top = frames_.back();
  if (top.kind == Frame::Kind::Point) return run_point();
  if (top.braced && cursor_.at("}")) {
    const bool last = frames_.size() == 1 && needs_point();
    if (last)
      return frames_.push_back({.kind = Frame::Kind::Point, .task = level_});
    if (finish_frame()) finish_statement();
    return;
  }
  if (cursor_.at_end()) {
    stopped_ = true;  // read_sketch() said that a brace is missing
    return;
  }
  statement();
}

bool Machine::too_large() {
  ++steps_;
  // Every statement that goes on after an error gives another one.
  stopped_ = stopped_ || errors_.is_full();
  if (stopped_) return true;
  const bool large = steps_ > kMostSteps || ast_.nodes.size() > kMostNodes ||
                     cursor_.taken() > kMostTokens;
  const bool deep = frames_.size() > kDeepest;
  if (!large && !deep) return false;
  fail("RP059", cursor_.here(),
       deep ? "blocks and calls are nested more than " +
                  std::to_string(kDeepest) + " deep here"
            : "this sketch is too large when loops are unrolled and tasks "
              "are put in wherever they may run");
  stopped_ = true;
  return true;
}

bool Machine::needs_point() const {
  return !in_setup_ && !point_done_ && level_ < sketch_.tasks.size();
}

/// Each task of a shorter period may run here, or not. A longer one comes
/// first: the copies of the shorter ones in it are those that go before it.
void Machine::run_point() {
  Frame& point = frames_.back();
  if (point.task >= sketch_.tasks.size()) {
    frames_.pop_back();
    point_done_ = true;
    return;
  }
  const std::size_t number = point.task++;
  const Task& task = sketch_.tasks[number];
  const std::string_view name = task.function->name;
  flush();
  const SourceRange where = task.function->where;
  const std::string choice =
      std::string(name) + "." + std::to_string(++task_runs_[number]);
  const Value chosen =
      input_cell(writer_.keep_text(choice), kBitCell, cursor_.here());
  ast_.declarations.back().made = true;
  const Value runs = kept_call("runs", "runs", chosen.nodes,
                               task_elements_[number], task.period_ms, where);
  enter(*task.function, Frame::Kind::Task);
  if (stopped_) return;
  level_ = number + 1;
  writer_.set_guard(runs.nodes.front().text);
}

void Machine::leave(const Frame& frame) {
  if (!in_setup_) flush();
  writer_.set_guard(frame.outer);
}

/// At the `}` of a frame, or behind the statement that is one without braces.
/// True: a statement of the frame around it has ended.
bool Machine::finish_frame() {
  const Frame frame = frames_.back();
  frames_.pop_back();
  if (frame.braced) cursor_.take();
  switch (frame.kind) {
    case Frame::Kind::Block:
      return true;
    case Frame::Kind::Then:
      leave(frame);
      if (cursor_.at_keyword("else")) {
        cursor_.take();
        Expression no;
        push_leaf(no, AstOp::Name, frame.condition, frame.where);
        writer_.set_guard(
            inner_guard(Arithmetic::negation(Arithmetic::bit(no, frame.where)),
                        frame.where));
        const bool braced = cursor_.accept("{");
        frames_.push_back({.kind = Frame::Kind::Else,
                           .braced = braced,
                           .outer = frame.outer,
                           .where = frame.where});
        return false;
      }
      return true;
    case Frame::Kind::Else:
      leave(frame);
      return true;
    case Frame::Kind::Loop: {
      const std::size_t next = frame.turn + 1;
      if (next < frame.values.size()) {
        frames_.push_back(frame);
        frames_.back().turn = next;
        Value& counter = counters_.at(frame.counter);
        counter =
            arithmetic_.number(frame.values[next], counter.type, frame.where);
        cursor_.go_to(frame.position);
        return false;
      }
      counters_.erase(frame.counter);
      return true;
    }
    case Frame::Kind::Function:
      cursor_.go_to(frame.position);
      // The call of setup() or loop() is no statement.
      return !frames_.empty();
    case Frame::Kind::Task:
      leave(frame);
      level_ = frame.task;
      cursor_.go_to(frame.position);
      return false;
    case Frame::Kind::Point:
      return false;
  }
  return false;
}

void Machine::finish_statement() {
  bool ended = true;
  while (ended) {
    point_done_ = false;
    ended = !frames_.empty() && !frames_.back().braced && finish_frame();
  }
}

// --- statements --------------------------------------------------------------

void Machine::statement() {
  if (cursor_.accept(";")) return finish_statement();
  if (cursor_.at("{")) {
    cursor_.take();
    frames_.push_back({.kind = Frame::Kind::Block, .where = cursor_.here()});
    return;
  }
  if (cursor_.at_keyword("for")) return for_statement();
  if (cursor_.at_keyword("return")) return return_statement();
  for (const char* const word : {"while", "do", "switch", "goto", "break",
                                 "continue", "static", "extern", "case"}) {
    if (!cursor_.at_keyword(word)) continue;
    fail("RP055", cursor_.here(),
         cursor_.shown() + " is not supported in a function");
    cursor_.skip_statement();
    return finish_statement();
  }
  const bool call = cursor_.at_word() && cursor_.at("(", 1);
  const Function* const function =
      call ? sketch_.find(cursor_.text()) : nullptr;
  if (function != nullptr) {
    const SourceRange where = cursor_.here();
    return call_function(*function, where);
  }
  if (needs_point()) {
    return frames_.push_back({.kind = Frame::Kind::Point, .task = level_});
  }
  if (cursor_.at_keyword("if")) return if_statement();
  simple_statement();
  finish_statement();
}

void Machine::call_function(const Function& function, SourceRange where) {
  cursor_.take();
  cursor_.take();
  if (!expect(")") || !expect(";")) {
    cursor_.skip_statement();
    return finish_statement();
  }
  if (function.name == "setup" || function.name == "loop") {
    fail("RP055", where,
         quoted_excerpt(function.name) + " is called: that is not supported");
    return finish_statement();
  }
  enter(function, Frame::Kind::Function);
}

/// The guard where `condition` is true, too; it is written once.
std::string_view Machine::inner_guard(Value condition, SourceRange where) {
  condition = arithmetic_.truth(std::move(condition));
  if (!writer_.guard().empty()) {
    Expression outer;
    push_leaf(outer, AstOp::Name, writer_.guard(), where);
    condition =
        Arithmetic::conjunction(Arithmetic::bit(outer, where), condition);
  }
  return writer_.keep("if", kBitCell, condition.nodes, where);
}

void Machine::if_statement() {
  const SourceRange where = cursor_.here();
  cursor_.take();
  std::optional<Value> condition;
  if (expect("(")) condition = rvalue();
  if (condition) {
    condition = arithmetic_.settled(std::move(*condition));
    if (!condition) fail("RP055", where, arithmetic_.why());
  }
  if (in_setup_) {
    fail("RP055", where, "`if` in setup() is not supported");
    condition.reset();
  }
  if (!condition || !expect(")")) {
    cursor_.skip_statement();
    if (cursor_.at_keyword("else")) cursor_.skip_statement();
    return finish_statement();
  }
  flush();
  const std::string_view outer = writer_.guard();
  const std::string_view guard = inner_guard(std::move(*condition), where);
  const bool braced = cursor_.accept("{");
  writer_.set_guard(guard);
  point_done_ = false;  // a task may run between the condition and what follows
  frames_.push_back({.kind = Frame::Kind::Then,
                     .braced = braced,
                     .outer = outer,
                     .condition = guard,
                     .where = where});
}

/// `for (int i = 0; i < 4; i++)`: the turns are known.
bool Machine::for_header(Frame& frame) {
  if (!expect("(")) return false;
  bool constant = false;
  const CType type = take_type(cursor_, constant).value_or(CType::Void);
  frame.counter = cursor_.text();
  if (type == CType::Void || !cursor_.at_word() ||
      variables_.contains(frame.counter) || counters_.contains(frame.counter)) {
    fail("RP055", cursor_.here(),
         "a `for` that does not declare a counter of its own is not "
         "supported");
    return false;
  }
  cursor_.take();
  if (!expect("=")) return false;
  const auto first = constant_expression("the first value of a `for`");
  if (!first || !expect(";")) return false;
  const bool named = cursor_.at_keyword(frame.counter);
  if (named) cursor_.take();
  const std::string_view relation = cursor_.text();
  if (named) cursor_.take();
  const auto last = constant_expression("the last value of a `for`");
  if (!last || !expect(";")) return false;
  const bool up = relation == "<" || relation == "<=";
  const bool down = relation == ">" || relation == ">=";
  const bool prefix = cursor_.accept(up ? "++" : "--");
  const bool steps = cursor_.at_keyword(frame.counter);
  if (steps) cursor_.take();
  const bool postfix = !prefix && cursor_.accept(up ? "++" : "--");
  if (!named || (!up && !down) || !steps || (!prefix && !postfix)) {
    fail("RP055", frame.where,
         "a `for` that does not count up or down to a limit by 1 is not "
         "supported");
    return false;
  }
  if (!expect(")")) return false;
  const std::int64_t end = relation.size() == 2 ? *last + (up ? 1 : -1) : *last;
  const std::int64_t turns = up ? end - *first : *first - end;
  if (turns > static_cast<std::int64_t>(kMostTurns)) {
    fail("RP059", frame.where,
         "this `for` makes " + std::to_string(turns) + " turns: more than " +
             std::to_string(kMostTurns) + " are not supported");
    return false;
  }
  if (turns <= 0) {
    fail("RP055", frame.where, "a `for` that makes no turn is not supported");
    return false;
  }
  for (std::int64_t i = 0; i < turns; ++i) {
    frame.values.push_back(up ? *first + i : *first - i);
  }
  counters_[frame.counter] = arithmetic_.number(*first, type, frame.where);
  return true;
}

void Machine::for_statement() {
  Frame frame{.kind = Frame::Kind::Loop, .where = cursor_.here()};
  cursor_.take();
  if (!for_header(frame)) {
    cursor_.skip_statement();
    return finish_statement();
  }

  frame.braced = cursor_.accept("{");
  frame.position = cursor_.position();
  frames_.push_back(std::move(frame));
}

/// At the end of a function `return` says nothing.
void Machine::return_statement() {
  const SourceRange where = cursor_.here();
  cursor_.take();
  const bool plain = cursor_.accept(";");
  const Frame& top = frames_.back();
  const bool last = plain && top.function != nullptr && cursor_.at("}") &&
                    cursor_.position() == top.function->end;
  if (!last) {
    fail("RP055", where,
         "`return` before the end of a function, or of a value, is not "
         "supported");
    if (!plain) cursor_.skip_statement();
  }
  finish_statement();
}

void Machine::simple_statement() {
  const std::size_t begin = cursor_.position();
  const SourceRange where = cursor_.here();
  bool constant = false;
  Cursor ahead = cursor_;
  if (take_type(ahead, constant)) {
    local_variable();
  } else if (!cursor_.at_word() && !cursor_.at("++") && !cursor_.at("--")) {
    fail("RP056", where, "expected a statement and found " + cursor_.shown());
  } else if (no_effect()) {
    return;
  } else if (cursor_.at_word() && (cursor_.at("(", 1) || cursor_.at(".", 1))) {
    if (call(false)) {
      if (!cursor_.accept(";")) {
        fail("RP056", cursor_.here(),
             "expected `;` and found " + cursor_.shown());
        cursor_.skip_statement();
      }
      return;
    }
  } else {
    assignment();
    return;
  }
  if (constant || cursor_.position() == begin) cursor_.skip_statement();
  // Never the same statement again.
  if (cursor_.position() == begin) cursor_.take();
}

/// `int level = x + 1;`: a variable that is written before it is read.
void Machine::local_variable() {
  bool constant = false;
  const std::size_t declared_at = cursor_.position();
  const CType type = take_type(cursor_, constant).value_or(CType::Void);
  const SourceRange where = cursor_.here();
  const std::string_view name = cursor_.text();
  if (!cursor_.at_word() || !cursor_.at("=", 1) || type == CType::Void) {
    fail("RP055", where,
         "a local variable without an initial value is not supported");
    return cursor_.skip_statement();
  }
  const auto found = variables_.find(name);
  const bool known = found != variables_.end() || counters_.contains(name) ||
                     sketch_.find(name) != nullptr;
  if (known &&
      (found == variables_.end() || found->second.declared_at != declared_at)) {
    fail("RP057", where,
         quoted_excerpt(name) + " hides another name: that is not supported");
    return cursor_.skip_statement();
  }
  cursor_.take();
  cursor_.take();
  std::optional<Value> value = rvalue();
  if (value && !known) {
    variables_.emplace(
        name,
        Variable{.type = type, .declared_at = declared_at, .where = where});
    order_.push_back(name);
    note(name, {0, 0}, type);
  }
  if (value) assign(name, std::move(*value), where);
  if (!value || !expect(";")) cursor_.skip_statement();
}

void Machine::assignment() {
  const SourceRange start = cursor_.here();
  const bool prefix = cursor_.accept("++");
  const bool minus = !prefix && cursor_.accept("--");
  const std::string_view name = cursor_.text();
  const SourceRange where = cursor_.here();
  const bool accumulator = name == "scanValue";
  if (!cursor_.at_word() || (!accumulator && !variables_.contains(name))) {
    fail(cursor_.at_word() ? "RP057" : "RP056", where,
         cursor_.shown() + " is no variable that can be assigned");
    return cursor_.skip_statement();
  }
  const std::size_t target = cursor_.position();
  cursor_.take();
  std::string_view op = cursor_.text();
  if (prefix || minus) {
    op = prefix ? "++" : "--";
  } else {
    cursor_.take();
  }
  const bool one = op == "++" || op == "--";
  const bool compound =
      !one && op.size() == 2 && op.ends_with('=') &&
      std::string_view("+-*/%&|^").find(op[0]) != std::string_view::npos;
  if (!one && !compound && op != "=") {
    fail("RP056", where,
         "expected an assignment and found " + quoted_excerpt(op));
    return cursor_.skip_statement();
  }
  std::optional<Value> value =
      one ? arithmetic_.number(1, CType::Int, where) : rvalue();
  if (value && op != "=") {
    const std::size_t here = cursor_.position();
    cursor_.go_to(target);
    std::optional<Value> old = name_value();
    cursor_.go_to(here);
    if (old) {
      value = arithmetic_.binary(op.substr(0, 1), std::move(*old),
                                 std::move(*value), start);
      if (!value) fail("RP055", start, arithmetic_.why());
    } else {
      value.reset();
    }
  }
  if (!value) return cursor_.skip_statement();
  if (!accumulator) {
    assign(name, std::move(*value), where);
  } else if (in_setup_) {
    fail("RP055", where, "`scanValue` in setup() is not supported");
  } else {
    value = arithmetic_.converted(std::move(*value), CType::Int);
    if (value) acc_ = std::move(*value);
    if (!value) fail("RP055", where, arithmetic_.why());
  }
  if (!expect(";")) cursor_.skip_statement();
}

}  // namespace rung::plclib
