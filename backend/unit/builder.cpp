#include "backend/unit/builder.h"

#include <algorithm>
#include <utility>

#include "analysis/node_operands.h"
#include "backend/unit/elements_common.h"

namespace rung::backend {
namespace {

constexpr Bounds k16Bits = {-32'768, 32'767};
constexpr Bounds k32Bits = {-2'147'483'648, 2'147'483'647};

/// Operators under which arithmetic modulo 2^16 is that of the integers.
bool is_ring(NodeOp op) {
  return op == NodeOp::Add || op == NodeOp::Subtract ||
         op == NodeOp::Multiply || op == NodeOp::Negate;
}

bool contains_call(const Terms& terms) {
  return std::any_of(terms.begin(), terms.end(),
                     [](const Term& term) { return term.op == NodeOp::Call; });
}

/// `guard AND value OR NOT guard AND cell`: how readers write a statement
/// behind a condition. The place of its value in `terms`.
struct Conditional {
  CellId guard;
  std::size_t begin = 0;
  std::size_t end = 0;
};
std::optional<Conditional> conditional_of(const Terms& terms, CellId cell) {
  // g, value, And, g, Not, cell, And, Or
  const std::size_t n = terms.size();
  if (n < 8) return std::nullopt;
  const Term* const tail = &terms[n - 6];
  const bool fits = tail[0].op == NodeOp::And && tail[1].op == NodeOp::Read &&
                    tail[2].op == NodeOp::Not && tail[3].op == NodeOp::Read &&
                    tail[3].cell == cell && tail[4].op == NodeOp::And &&
                    tail[5].op == NodeOp::Or && tail[4].size == 4 &&
                    tail[0].size == n - 5 && terms.front().op == NodeOp::Read &&
                    terms.front().cell == tail[1].cell &&
                    terms[n - 7].size == n - 7;
  if (!fits) return std::nullopt;
  return Conditional{terms.front().cell, 1, n - 6};
}

}  // namespace

UnitBuilder::UnitBuilder(const Program& program, const Profile& profile,
                         DiagnosticSink& sink)
    : program_(program),
      profile_(profile),
      sink_(sink),
      names_(*profile.names),
      bounds_(find_bounds(program)),
      unused_(find_unused(program)),
      variable_of_(program.cells.size()) {}

void UnitBuilder::fail(SourceRange where, std::string message) {
  failed_ = true;
  if (!where.has_value()) where = {program_.file, 0, 0};
  sink_.report({.code = "RP084",
                .severity = Severity::Error,
                .where = where,
                .message = std::move(message)});
}

std::optional<Unit> UnitBuilder::build(Elements& elements,
                                       std::string_view name) {
  elements_ = &elements;
  unit_.name = names_.add(name);
  check_words();
  elements.declare(*this);
  declare_cells();
  relate_constants();
  for (const RungId id : ids_of(program_.rungs)) {
    if (!unused_.rungs[id.index()]) lower_rung(id);
  }
  if (!program_.plant.statements.empty()) {
    sink_.report({.code = "RP085",
                  .severity = Severity::Note,
                  .where = {program_.file, 0, 0},
                  .message = "the plant (`//Sim`) is left out: it is no part "
                             "of a controller's program"});
  }
  if (failed_) return std::nullopt;
  unit_.names = std::move(names_);
  return std::move(unit_);
}

// --- cells and words ---------------------------------------------------------

/// What no rung writes stays as it is.
void UnitBuilder::relate_constants() {
  std::vector<bool> written(program_.cells.size(), false);
  for (const Rung& rung : program_.rungs) written[rung.target.index()] = true;
  for (const CellId id : ids_of(program_.cells)) {
    const Cell& cell = program_.cells[id];
    if (written[id.index()] || cell.role == CellRole::Input ||
        cell.type == Type::Word) {
      continue;
    }
    unit_.relations.push_back(
        {cell.initial != 0 ? "c" : "!c", {{"c", cell.name}}});
  }
}

// Cells that the text names come first: they keep their names.
void UnitBuilder::declare_cells() {
  for (const bool made : {false, true}) {
    for (const CellId id : ids_of(program_.cells)) {
      const Cell& cell = program_.cells[id];
      if (cell.made != made || variable_of_[id.index()].has_value()) continue;
      if (unused_.cells[id.index()]) continue;
      const bool input = cell.role == CellRole::Input;
      const Bounds range = bounds_.cells[id.index()];
      if (cell.type == Type::Word && !profile_.words) {
        fail(cell.where, "`" + cell.name + "` is a word: " +
                             std::string(profile_.name) + " have bits only");
      } else if (cell.type == Type::Word && !fits(range)) {
        fail(cell.where, "`" + cell.name + "` may leave " + word_range());
      }
      if (!input && cell.initial != 0 && !profile_.first_values) {
        fail(cell.where, "`" + cell.name + "` begins with " +
                             std::to_string(cell.initial) + ": cells of " +
                             std::string(profile_.name) + " begin with 0");
      }
      const bool bit = cell.type == Type::Bit;
      if (!bit && !input) {
        // So the wrapping of the target's words changes nothing.
        unit_.relations.push_back({"w >= " + std::to_string(range.low) +
                                       " && w <= " + std::to_string(range.high),
                                   {{"w", cell.name}}});
      }
      bind(id, unit_.variables.add({.name = names_.add(cell.name),
                                    .source = cell.name,
                                    .type = cell.type,
                                    .role = cell.role,
                                    .initial = input ? 0 : cell.initial,
                                    .low = cell.low,
                                    .high = cell.high}));
    }
  }
}

bool UnitBuilder::fits(Bounds bounds) const {
  const Bounds all = profile_.wraps ? k16Bits : k32Bits;
  return bounds.within(all.low, all.high);
}

std::string UnitBuilder::word_range() const {
  return (profile_.wraps ? "-32768..32767, the 16 bits of a word of "
                         : "the 32 bits of a word of ") +
         std::string(profile_.name);
}

void UnitBuilder::check_words() {
  std::vector<bool> wraps(program_.nodes.size(), false);
  for (const RungId id : ids_of(program_.rungs)) {
    if (!unused_.rungs[id.index()]) check_rung_words(program_.rungs[id], wraps);
  }
}

/// A target computes with 16 bits: what leaves them must not be looked at
/// before it is wrapped.
void UnitBuilder::check_rung_words(const Rung& rung, std::vector<bool>& wraps) {
  for (std::uint32_t at = rung.end; at-- > rung.begin;) {
    const Node& node = program_.nodes[at];
    if (node.op == NodeOp::Wrap16 && !profile_.wraps) {
      if (!bounds_.nodes[node.a].within(k16Bits.low, k16Bits.high)) {
        fail(node.where, "this wraps at 16 bits: words of " +
                             std::string(profile_.name) + " do not");
      }
      continue;
    }
    const bool through =
        node.op == NodeOp::Wrap16 || (wraps[at] && is_ring(node.op));
    if (through) {
      wraps[node.a] = true;
      if (operand_count(node.op) == 2) wraps[node.b] = true;
    }
    if (node.op == NodeOp::Wrap) {
      fail(node.where, "a word of another width than 16 bits");
      continue;
    }
    if (node.type == Type::Bit || node.op == NodeOp::Read) continue;
    if (node.op == NodeOp::Divide && profile_.short_circuits) {
      fail(node.where, "a division: that of " + std::string(profile_.name) +
                           " gives fractions");
    }
    if (!profile_.words) {
      fail(node.where,
           "a number: " + std::string(profile_.name) + " have bits only");
      continue;
    }
    const bool constant = node.op == NodeOp::Constant;
    if (fits(bounds_.nodes[at])) continue;
    if (wraps[at] && !constant) continue;
    fail(node.where, constant ? "the constant " + std::to_string(node.value) +
                                    " is outside of " + word_range()
                              : "this may leave " + word_range());
  }
}

namespace {

/// "T_0" for "T(0)".
std::string plain_name(std::string name) {
  std::erase(name, ')');
  std::replace(name.begin(), name.end(), '(', '_');
  return name;
}

}  // namespace

BlockId UnitBuilder::add_block(std::string_view type,
                               const Instance& instance) {
  return unit_.blocks.add({.name = names_.add(plain_name(instance.name)),
                           .type = type,
                           .source = instance.name});
}

CellId UnitBuilder::add_pin(BlockId block, std::string_view pin, Type type) {
  return unit_.variables.add(
      {.name = unit_.blocks[block].name + "." + std::string(pin),
       .type = type,
       .block = block,
       .pin = pin});
}

CellId UnitBuilder::add_state(const Instance& instance, std::string_view state,
                              Type type) {
  return unit_.variables.add(
      {.name = names_.add(plain_name(instance.name) + "_" + std::string(state)),
       .type = type});
}

// --- rungs -------------------------------------------------------------------

void UnitBuilder::lower_rung(RungId id) {
  const Rung& rung = program_.rungs[id];
  rung_ = id;
  terms_.clear();
  starts_.clear();
  open_.clear();
  calls_left_.clear();
  for (std::uint32_t at = rung.begin; at < rung.end; ++at) {
    const Node& node = program_.nodes[at];
    if (node.op != NodeOp::Call) continue;
    ++calls_left_[program_.calls[node.call].instance];
  }
  for (std::uint32_t at = rung.begin; at < rung.end; ++at) lower_node(at);
  finish_rung(rung);
}

void UnitBuilder::finish_rung(const Rung& rung) {
  const CellId target = variable_of_[rung.target.index()];
  Terms value = take(1);
  const bool self = value.size() == 1 && value[0].op == NodeOp::Read &&
                    value[0].cell == target;
  // The pin that a call has written.
  if (self && unit_.variables[target].block.has_value()) return;
  if (profile_.conditions && !profile_.inline_calls) {
    if (const auto found = conditional_of(value, target)) {
      const Terms guard = read_term(found->guard, Type::Bit);
      const auto begin = value.begin();
      Terms inner(begin + static_cast<std::ptrdiff_t>(found->begin),
                  begin + static_cast<std::ptrdiff_t>(found->end));
      const bool same = inner.size() == 1 && inner[0].op == NodeOp::Read &&
                        inner[0].cell == target;
      if (!same) pure(target, std::move(inner), guard);
      return;
    }
  }
  pure(target, std::move(value));
}

void UnitBuilder::lower_node(std::uint32_t at) {
  const Node& node = program_.nodes[at];
  switch (node.op) {
    case NodeOp::Constant:
      return push(constant_term(node.type, node.value));
    case NodeOp::Read:
      return push(read_term(variable_of_[node.cell.index()], node.type));
    case NodeOp::Call:
      return lower_call(at);
    case NodeOp::Branch:
      return lower_branch(at);
    case NodeOp::Wrap16:
      return;  // so do the target's words
    case NodeOp::ToWord:
      if (!profile_.inline_calls) return bit_to_word();
      break;
    case NodeOp::Xor:
      if (profile_.ladder) return expand_xor();
      break;
    case NodeOp::ToBit: {
      Terms word = take(1);
      return push(joined(NodeOp::NotEqual, Type::Bit, std::move(word),
                         constant_term(Type::Word, 0)));
    }
    default:
      break;
  }
  const std::uint32_t count = operand_count(node.op);
  push_operator(terms_, node.op, node.type, count);
  starts_.resize(starts_.size() - count + 1);
  if (!open_.empty() && open_.back().join == at) open_.pop_back();
}

Terms UnitBuilder::take(std::size_t operands) {
  const std::size_t first = starts_[starts_.size() - operands];
  const auto begin = terms_.begin() + static_cast<std::ptrdiff_t>(first);
  Terms taken(begin, terms_.end());
  terms_.erase(begin, terms_.end());
  starts_.resize(starts_.size() - operands);
  return taken;
}

void UnitBuilder::push(const Terms& terms) {
  starts_.push_back(static_cast<std::uint32_t>(terms_.size()));
  terms_.insert(terms_.end(), terms.begin(), terms.end());
}

void UnitBuilder::lower_call(std::uint32_t at) {
  const ElementCall& call = program_.calls[program_.nodes[at].call];
  std::vector<Terms> arguments(call.arguments.size());
  for (std::size_t i = arguments.size(); i-- > 0;) arguments[i] = take(1);
  --calls_left_[call.instance];
  Terms result = elements_->call(*this, call, std::move(arguments));
  // Where the source always executes it, it must not stand behind `&&`.
  const bool skipped =
      profile_.short_circuits && program_.evaluation == Evaluation::Strict &&
      contains_call(result) && at != program_.rungs[rung_].root();
  if (skipped) result = read_term(kept_cell(std::move(result)), Type::Bit);
  push(result);
}

Terms UnitBuilder::inline_call(std::string head,
                               const std::vector<Terms>& operands) {
  Terms terms;
  for (const Terms& operand : operands) {
    terms.insert(terms.end(), operand.begin(), operand.end());
  }
  const auto count = static_cast<std::uint32_t>(operands.size());
  push_operator(terms, NodeOp::Call, Type::Bit, count);
  terms.back().call = static_cast<std::uint32_t>(unit_.calls.size());
  unit_.calls.push_back({std::move(head), count});
  return terms;
}

/// From here to the And or Or, statements stand behind a condition.
void UnitBuilder::lower_branch(std::uint32_t at) {
  const Node& marker = program_.nodes[at];
  if (!profile_.conditions) {
    fail(marker.where,
         "a timer, counter or edge that is not executed in every scan: " +
             std::string(profile_.name) + " have no condition for that");
  }
  if (elements_->inline_only()) return;
  const Terms left = kept(take(1));
  push(left);
  Terms on = marker.skip_when ? negated(left) : left;
  if (!open_.empty()) {
    on = kept(both(open_.back().guard, on));
  }
  open_.push_back({marker.target, std::move(on)});
}

/// As contacts: each operand is needed twice.
void UnitBuilder::expand_xor() {
  const Terms right = kept(take(1));
  const Terms left = kept(take(1));
  push(either(both(left, negated(right)), both(negated(left), right)));
}

/// A bit as 0 or 1.
void UnitBuilder::bit_to_word() {
  const Terms bit = take(1);
  if (bit.size() == 1 && bit[0].op == NodeOp::Constant) {
    return push(constant_term(Type::Word, bit[0].value));
  }
  const CellId word = make(Type::Word);
  if (!profile_.conditions) {
    fail(program_.rungs[rung_].where,
         "a bit as a number: " + std::string(profile_.name) + " have none");
  }
  pure(word, constant_term(Type::Word, 0));
  pure(word, constant_term(Type::Word, 1), bit);
  push(read_term(word, Type::Word));
}

CellId UnitBuilder::make(Type type) {
  const CellId target = variable_of_[program_.rungs[rung_].target.index()];
  return unit_.variables.add(
      {.name = names_.make(unit_.variables[target].name), .type = type});
}

// --- for elements ------------------------------------------------------------

Terms UnitBuilder::kept(Terms value, Type type) {
  if (is_contact(value)) return value;
  return read_term(kept_cell(std::move(value), type), type);
}

CellId UnitBuilder::kept_cell(Terms value, Type type) {
  const CellId cell = make(type);
  const bool executes = contains_call(value) && !open_.empty();
  pure(cell, std::move(value), executes ? open_.back().guard : Terms());
  return cell;
}

Terms UnitBuilder::result_of(const ElementCall& call, Terms result) {
  const auto left = calls_left_.find(call.instance);
  if (left == calls_left_.end() || left->second == 0) return result;
  if (result.size() == 1 && result[0].op == NodeOp::Constant) return result;
  const Type type = result.back().type;
  return read_term(kept_cell(std::move(result), type), type);
}

void UnitBuilder::pure(CellId target, Terms value, Terms guard) {
  add({.guard = std::move(guard), .target = target, .value = std::move(value)});
}

void UnitBuilder::assign(CellId target, Terms value) {
  Terms guard = open_.empty() ? Terms() : open_.back().guard;
  pure(target, std::move(value), std::move(guard));
}

void UnitBuilder::assign_when(const Terms& condition, CellId target,
                              Terms value) {
  Terms guard = open_.empty() ? condition
                              : joined(NodeOp::And, Type::Bit,
                                       open_.back().guard, condition);
  pure(target, std::move(value), std::move(guard));
}

void UnitBuilder::call(BlockId block, std::vector<Argument> arguments,
                       std::optional<std::int64_t> preset) {
  add({.guard = open_.empty() ? Terms() : open_.back().guard,
       .block = block,
       .arguments = std::move(arguments),
       .preset = preset});
}

void UnitBuilder::add(Statement statement) {
  statement.rung = rung_;
  unit_.statements.push_back(std::move(statement));
}

}  // namespace rung::backend
