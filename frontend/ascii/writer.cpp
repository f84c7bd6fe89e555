#include "frontend/ascii/writer.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/text.h"
#include "frontend/token_list.h"

namespace rung::ascii {
namespace {

constexpr std::size_t kShort = 32;  // nodes of an expression that is copied

}  // namespace

Writer::Writer(const Drawing& drawing, const Wires& wires, Cells& cells,
               StatementWriter& out, ErrorLimit& errors)
    : drawing_(drawing),
      wires_(wires),
      cells_(cells),
      out_(out),
      errors_(errors),
      jumps_(out),
      powers_(wires.runs.size() + wires.links.size()),
      joined_(wires.links.size()) {
  for (const Run& run : wires.runs) done_.push_back(run.begin);
  for (const Link& link : wires.links) awaited_.push_back(link.incoming);
}

SourceRange Writer::range_of(Place place) const {
  return drawing_.range(place.row, place.column, place.column + 1);
}

void Writer::run() {
  for (std::uint32_t i = 0; i < wires_.links.size(); ++i) {
    if (wires_.links[i].rail) start(i, range_of(wires_.links[i].place));
  }
  while (!events_.empty()) {
    const std::uint32_t run = events_.top().second;
    events_.pop();
    execute(run);
  }
  reach_labels(drawing_.rows());
}

// --- the order ---------------------------------------------------------------

void Writer::announce(std::uint32_t run) {
  const Run& it = wires_.runs[run];
  const bool more = done_[run] != it.end;
  events_.emplace(more ? wires_.elements[done_[run]].place : it.place, run);
}

// A link has all its power.
void Writer::start(std::uint32_t link, SourceRange where) {
  const std::vector<std::uint32_t>& outgoing = wires_.links[link].outgoing;
  Power& power = powers_[wires_.runs.size() + link];
  if (outgoing.size() > 1) keep(power, where);
  Power shared = std::exchange(power, {});
  shared.listed = false;
  // Only what is kept in a bit is copied: that is short.
  for (std::size_t i = 1; i < outgoing.size(); ++i) {
    powers_[outgoing[i]] = shared;
  }
  if (!outgoing.empty()) powers_[outgoing.front()] = std::move(shared);
  for (const std::uint32_t run : outgoing) {
    note(run);
    announce(run);
  }
}

void Writer::execute(std::uint32_t run) {
  const Run& it = wires_.runs[run];
  if (done_[run] == it.end) return finish(run);
  const Element& element = wires_.elements[done_[run]++];
  const bool last = done_[run] == it.end;
  const bool needed = !last || it.to != kNoLink;
  reach_labels(element.place.row);
  switch (element.symbol) {
    case Symbol::Contact:
    case Symbol::NegatedContact:
    case Symbol::Greater:
    case Symbol::Less:
      contact(element, powers_[run]);
      note(run);
      break;
    case Symbol::Coil:
    case Symbol::NegatedCoil:
    case Symbol::Set:
    case Symbol::Reset:
      coil(element, powers_[run], needed);
      break;
    case Symbol::Jump:
      jump(element, powers_[run]);
      break;
    case Symbol::Timer:
      timer(element, powers_[run]);
      break;
  }
  if (last) return finish(run);
  announce(run);
}

void Writer::finish(std::uint32_t run) {
  const std::uint32_t to = wires_.runs[run].to;
  if (to != kNoLink && !wires_.links[to].rail) {
    const SourceRange where = range_of(wires_.runs[run].place);
    join(to, std::move(powers_[run]), where);
    if (--awaited_[to] == 0) start(to, where);
  }
  powers_[run] = {};
}

void Writer::join(std::uint32_t link, Power power, SourceRange where) {
  const auto wire = static_cast<std::uint32_t>(wires_.runs.size()) + link;
  Power& sum = powers_[wire];
  if (!joined_[link]) {
    joined_[link] = true;
    sum = std::move(power);
    sum.listed = false;
  } else if (sum.always || power.always) {
    sum = {};
  } else {
    if (power.nodes.size() > kShort) keep(power, where);
    push_all(sum.nodes, power.nodes);
    push_binary(sum.nodes, AstOp::Or, where);
    sum.held = {};
  }
  note(wire);
}

// --- power -------------------------------------------------------------------

void Writer::note(std::uint32_t wire) {
  Power& power = powers_[wire];
  if (power.always || !power.held.empty() || power.listed) return;
  power.listed = true;
  pending_.push_back(wire);
}

void Writer::keep(Power& power, SourceRange where) {
  if (power.always || !power.held.empty()) return;
  power.held = out_.keep("power", kBitCell, power.nodes, where);
  power.nodes.clear();
  push_leaf(power.nodes, AstOp::Name, power.held, where);
}

void Writer::keep_all(const Power* but, SourceRange where) {
  for (const std::uint32_t wire : pending_) {
    Power& power = powers_[wire];
    power.listed = false;
    if (&power != but) keep(power, where);
  }
  pending_.clear();
}

Expression Writer::expression_of(const Power& power, SourceRange where) const {
  if (!power.always) return power.nodes;
  Expression nodes;
  push_leaf(nodes, AstOp::Bool, "true", where);
  return nodes;
}

// --- elements ----------------------------------------------------------------

void Writer::contact(const Element& it, Power& power) {
  const bool compares =
      it.symbol == Symbol::Greater || it.symbol == Symbol::Less;
  Expression condition;
  if (compares) {
    condition = cells_.operand(it.operand, it.operand_where);
    push_all(condition, cells_.operand(it.second, it.second_where));
    push_binary(condition,
                it.symbol == Symbol::Less ? AstOp::Less : AstOp::Greater,
                it.where);
  } else {
    push_leaf(condition, AstOp::Name, it.operand, it.operand_where);
    if (it.symbol == Symbol::NegatedContact) {
      push_unary(condition, AstOp::Not, it.where);
    }
  }
  push_all(power.nodes, condition);
  if (!power.always) push_binary(power.nodes, AstOp::And, it.where);
  power.always = false;
  power.held = {};
}

void Writer::coil(const Element& it, Power& power, bool needed) {
  if (needed) keep(power, it.where);
  keep_all(&power, it.where);
  Expression value = expression_of(power, it.where);
  const SourceRange name = it.operand_where;
  if (it.symbol == Symbol::NegatedCoil || it.symbol == Symbol::Reset) {
    push_unary(value, AstOp::Not, it.where);
  }
  if (it.symbol == Symbol::Set || it.symbol == Symbol::Reset) {
    push_leaf(value, AstOp::Name, it.operand, name);
    push_binary(value, it.symbol == Symbol::Set ? AstOp::Or : AstOp::And,
                it.where);
  }
  out_.assign(it.operand, false, name, value, it.where);
}

// It is executed here, and not at all where a jump leads over it.
void Writer::timer(const Element& it, Power& power) {
  keep(power, it.where);
  const std::string_view kind = it.second == "TON"   ? "ton"
                                : it.second == "TOF" ? "tof"
                                                     : "tp";
  const std::uint32_t index = out_.element(kind, it.operand, it.operand_where);
  const std::string_view q = out_.make("timer", kBitCell, it.where);
  out_.assign(q, false, it.where,
              out_.call(it.second, expression_of(power, it.where), index,
                        it.preset_ms, it.where),
              it.where);
  power.always = false;
  power.nodes.clear();
  push_leaf(power.nodes, AstOp::Name, q, it.where);
  power.held = q;
}

void Writer::jump(const Element& it, Power& power) {
  const std::vector<Label>& labels = drawing_.labels();
  const bool ahead = std::any_of(
      labels.begin() + static_cast<std::ptrdiff_t>(next_label_), labels.end(),
      [&](const Label& label) { return label.name == it.operand; });
  if (!ahead) {
    std::vector<std::string_view> known;
    known.reserve(labels.size());
    for (const Label& label : labels) known.push_back(label.name);
    errors_.error("RP089", it.operand_where,
                  "there is no label " + quoted_excerpt(it.operand) +
                      " further down" + did_you_mean(it.operand, known));
    return;
  }
  jumps_.jump(it.operand, expression_of(power, it.where), it.where);
}

void Writer::reach_labels(std::uint32_t row) {
  const std::vector<Label>& labels = drawing_.labels();
  for (; next_label_ < labels.size() && labels[next_label_].row < row;
       ++next_label_) {
    const Label& label = labels[next_label_];
    jumps_.arrive(label.name, range_of({label.row, 0}));
  }
}

}  // namespace rung::ascii
