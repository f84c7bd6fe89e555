#include "frontend/rockwell/writer.h"

#include <string>
#include <utility>

#include "frontend/token_list.h"

namespace rung::rockwell {

using ladder::name_of;
using ladder::power_of;
using ladder::truth;

namespace {

constexpr std::string_view kRoutineEnd;  // the label of RET and TND
constexpr std::uint64_t kMostExecuted = 2'000'000;

}  // namespace

// --- routines and rungs ------------------------------------------------------

void Writer::run() {
  if (project_.routines.empty()) return;
  const Routine& main = project_.routines[project_.main];
  for (const Routine& one : project_.routines) {
    routines_.emplace(one.name, &one);
  }
  active_.insert(main.name);
  frames_.emplace_back(main, out_);
  if (!main.texts.rungs.empty()) begin_rung(frames_.back());
  while (!frames_.empty()) advance();
}

void Writer::begin_rung(Frame& frame) {
  const RungText& rung = frame.routine->texts.rungs[frame.rung];
  frame.step = 0;
  frame.flow.begin(frame.zone ? frame.power : std::string_view{}, rung.where);
}

// A step of the innermost routine.
void Writer::advance() {
  Frame& frame = frames_.back();
  const std::vector<RungText>& rungs = frame.routine->texts.rungs;
  if (frame.rung == rungs.size()) return end_routine();
  const RungText& rung = rungs[frame.rung];
  if (frame.step < rung.steps.size()) {
    flow_ = &frame.flow;
    return step(frame, rung.steps[frame.step++]);
  }
  frame.flow.finish(rung.where);
  if (++frame.rung < rungs.size()) begin_rung(frame);
}

void Writer::end_routine() {
  Frame& frame = frames_.back();
  if (frame.zone) {
    errors_.error("RP088", frame.zone_where,
                  "the zone of this MCR does not end in its routine");
  }
  frame.jumps.arrive(kRoutineEnd, frame.routine->where);
  out_.set_guard(frame.guard);
  active_.erase(frame.routine->name);
  frames_.pop_back();
}

void Writer::step(Frame& frame, const Step& step) {
  switch (step.kind) {
    case Step::Kind::Open:
      return flow_->open(step);
    case Step::Kind::Next:
      return flow_->next(step);
    case Step::Kind::Close:
      return flow_->close(step);
    case Step::Kind::Instruction:
      break;
  }
  if (++executed_ == kMostExecuted) {
    errors_.error("RP088", step.where,
                  "routines are called so often that the program is too "
                  "large");
  }
  if (executed_ >= kMostExecuted) {
    frames_.clear();
    return;
  }
  instruction(frame, frame.routine->texts.instructions[step.instruction], step);
}

void Writer::instruction(Frame& frame, const Instruction& it,
                         const Step& step) {
  switch (it.kind->op) {
    case Op::Examine: {
      const Operand& name = it.operands[0];
      Expression condition =
          name_of(tags_.place(name, Place::Kind::Bit).name, name.where);
      if (it.kind->operation == AstOp::Not) {
        push_unary(condition, AstOp::Not, it.where);
      }
      return flow_->contact(condition, it.where);
    }
    case Op::Energize:
      return energize(it, step);
    case Op::Latch:
    case Op::Unlatch:
      return latch(it, it.kind->op == Op::Latch);
    case Op::OneShot:
    case Op::OneShotRising:
    case Op::OneShotFalling:
      return one_shot(it);
    case Op::Timer:
      return timer(it);
    case Op::Counter:
      return counter(it);
    case Op::Reset:
      return reset(it);
    case Op::Compare:
      return compare(it);
    case Op::Limit:
      return limit(it);
    case Op::Move:
    case Op::Clear:
      return move(it);
    case Op::Arithmetic:
      return arithmetic(it);
    case Op::Jump:
      return jump(frame, it);
    case Op::Label:
      return frame.jumps.arrive(it.operands[0].text, it.where);
    case Op::MasterControl:
      return master_control(frame, it);
    case Op::AlwaysFalse:
      return flow_->contact(truth(false, it.where), it.where);
    case Op::NoOperation:
    case Op::Subroutine:
      return;
    case Op::End:
    case Op::Return:
      return frame.jumps.jump(
          kRoutineEnd, power_of(flow_->hold(it.where), it.where), it.where);
    case Op::Call:
      return call(frame, it);
  }
}

// In the called routine everything is behind the power of the call.
void Writer::call(Frame& frame, const Instruction& it) {
  const Operand& name = it.operands[0];
  const auto routine = routines_.find(name.text);
  // `JSR(name,0)` says that there are no parameters.
  if (it.operands.size() > 2 ||
      (it.operands.size() == 2 && number_of(it.operands[1].text) != 0)) {
    errors_.error("RP087", it.where,
                  "parameters of a routine are not supported");
  } else if (routine == routines_.end() || routine->second->type != "RLL") {
    errors_.error("RP087", name.where,
                  "there is no ladder routine " + quoted_excerpt(name.text));
  } else if (!active_.insert(name.text).second) {
    errors_.error("RP088", name.where,
                  "the routine " + quoted_excerpt(name.text) + " calls itself");
  } else {
    flow_ = &frame.flow;
    enter(it.where);
    const std::string_view inside = out_.guard();
    leave();
    Frame& called = frames_.emplace_back(*routine->second, out_);
    out_.set_guard(inside);
    if (!called.routine->texts.rungs.empty()) begin_rung(called);
  }
}

void Writer::jump(Frame& frame, const Instruction& it) {
  const Operand& name = it.operands[0];
  const auto label = frame.routine->labels.find(name.text);
  if (label == frame.routine->labels.end() || label->second <= frame.rung) {
    errors_.error("RP089", name.where,
                  "there is no label " + quoted_excerpt(name.text) +
                      " further down in this routine");
    return;
  }
  frame.jumps.jump(name.text, power_of(flow_->hold(it.where), it.where),
                   it.where);
}

void Writer::master_control(Frame& frame, const Instruction& it) {
  frame.power = frame.zone ? std::string_view{} : flow_->hold(it.where);
  frame.zone = !frame.zone;
  frame.zone_where = it.where;
}

}  // namespace rung::rockwell
