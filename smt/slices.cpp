#include "smt/slices.h"

#include <algorithm>

#include "smt/bit_blast.h"
#include "smt/faults.h"

namespace rung {
namespace {

constexpr std::string_view kSchema = "rungproof.slice/1";

/// The property whose monitor a state is: the name up to one of its dots.
const Property* monitored(
    const std::string& name,
    const std::unordered_map<std::string_view, const Property*>& properties) {
  for (std::size_t dot = name.find('.'); dot != std::string::npos;
       dot = name.find('.', dot + 1)) {
    const auto found = properties.find(std::string_view(name).substr(0, dot));
    if (found != properties.end()) return found->second;
  }
  return nullptr;
}

void sort_unique(std::vector<Digest>& digests) {
  std::sort(digests.begin(), digests.end());
  digests.erase(std::unique(digests.begin(), digests.end()), digests.end());
}

}  // namespace

/// Strongly connected components, by Tarjan: terms that depend on each other
/// through the next scan. A component's digest is that of what its variables
/// are and of the components below it, which are finished before it.
class Slices::Components {
 public:
  explicit Components(Slices& slices)
      : slices_(slices), order_(slices.terms_.size(), 0) {}

  void visit(ExprId root) {
    if (order_[root.index()] != 0) return;
    open(root);
    while (!frames_.empty()) {
      Frame& frame = frames_.back();
      if (frame.next == frame.successors.size()) {
        close();
        continue;
      }
      const ExprId to = frame.successors[frame.next++];
      const std::uint32_t order = order_[to.index()];
      if (order == 0) {
        open(to);
      } else if (order != kDone) {
        frame.low = std::min(frame.low, order);
      }
    }
  }

 private:
  static constexpr std::uint32_t kDone = ~std::uint32_t{0};
  struct Frame {
    ExprId term;
    std::uint32_t low = 0;
    std::size_t next = 0;
    std::vector<ExprId> successors;
  };

  void open(ExprId term) {
    order_[term.index()] = ++count_;
    members_.push_back(term);
    frames_.push_back({term, count_, 0, slices_.successors(term)});
  }

  void close() {
    const Frame frame = std::move(frames_.back());
    frames_.pop_back();
    if (!frames_.empty()) {
      frames_.back().low = std::min(frames_.back().low, frame.low);
    }
    if (frame.low == order_[frame.term.index()]) finish(frame.term);
  }

  void finish(ExprId root) {
    const auto begin =
        std::find(members_.rbegin(), members_.rend(), root).base() - 1;
    const std::vector<ExprId> own(begin, members_.end());
    members_.erase(begin, members_.end());
    const Digest digest = digest_of(own);
    for (const ExprId member : own) {
      slices_.slices_[member.index()] = digest;
      order_[member.index()] = kDone;
    }
  }

  Digest digest_of(const std::vector<ExprId>& members) const {
    std::vector<Digest> own;
    std::vector<Digest> under;
    for (const ExprId member : members) {
      if (slices_.ts_.exprs[member].op == ExprOp::Variable) {
        own.push_back(slices_.definition(member));
      }
      const auto faults = slices_.faults_.find(member);
      if (faults != slices_.faults_.end()) {
        for (const ExprId fault : faults->second) {
          own.push_back(Hasher()
                            .add("fault")
                            .add(slices_.terms_[fault.index()])
                            .finish());
        }
      }
      for (const ExprId to : slices_.successors(member)) {
        const Digest& digest = slices_.slices_[to.index()];
        const bool is_below = order_[to.index()] == kDone;
        if (is_below && digest != Digest()) under.push_back(digest);
      }
    }
    sort_unique(own);
    sort_unique(under);
    if (own.empty() && under.empty()) return {};
    if (own.empty() && under.size() == 1) return under.front();
    Hasher hasher;
    hasher.add("component").add(static_cast<std::int64_t>(own.size()));
    for (const Digest& digest : own) hasher.add(digest);
    for (const Digest& digest : under) hasher.add(digest);
    return hasher.finish();
  }

  Slices& slices_;
  std::vector<std::uint32_t> order_;  // by ExprId; 0: not seen
  std::uint32_t count_ = 0;
  std::vector<ExprId> members_;
  std::vector<Frame> frames_;
};

Slices::Slices(const TransitionSystem& ts, const PropertySet& properties,
               const std::vector<Obligation>& obligations)
    : ts_(ts),
      reached_(ts.exprs.size(), false),
      terms_(ts.exprs.size()),
      slices_(ts.exprs.size()) {
  for (const Fault& fault : ts.faults) {
    for (const ExprId id : comparisons(ts, fault.condition)) {
      faults_[id].push_back(fault.condition);
    }
  }
  name_variables(properties);
  reach(obligations);
  digest_terms();
  Components components(*this);
  for (std::uint32_t i = 0; i < reached_.size(); ++i) {
    if (reached_[i]) components.visit(ExprId(i));
  }
}

void Slices::name_variables(const PropertySet& properties) {
  std::unordered_map<std::string_view, const Property*> by_name;
  for (const Property& property : properties.properties) {
    by_name.emplace(property.name, &property);
  }
  std::unordered_map<std::string, std::int64_t> used;
  for (const Variable& var : ts_.vars) {
    std::string name = var.name;
    const bool may_watch = var.role == VarRole::State && !var.cell.has_value();
    const Property* const property =
        may_watch ? monitored(name, by_name) : nullptr;
    if (property != nullptr) {
      name = "monitor" + name.substr(property->name.size()) + " of " +
             property->text;
    }
    const std::int64_t count = ++used[name];
    if (count > 1) name += " #" + std::to_string(count);
    names_.push_back(std::move(name));
  }
  for (std::uint32_t i = 0; i < names_.size(); ++i) {
    by_name_.emplace(names_[i], VarId(i));
  }
}

std::vector<ExprId> Slices::successors(ExprId id) const {
  const Expr& e = ts_.exprs[id];
  const Operands under = operands(e);
  std::vector<ExprId> found(under.ids, under.ids + under.count);
  if (e.op == ExprOp::Variable && ts_.vars[e.var].role == VarRole::State) {
    const State& state = ts_.states[ts_.vars[e.var].state];
    found.push_back(state.next);
    if (state.clock) found.push_back(state.running);
  }
  const auto faults = faults_.find(id);
  if (faults != faults_.end()) {
    found.insert(found.end(), faults->second.begin(), faults->second.end());
  }
  return found;
}

void Slices::reach(const std::vector<Obligation>& obligations) {
  std::vector<ExprId> stack = ts_.constraints;
  for (const Obligation& obligation : obligations) {
    stack.push_back(obligation.condition);
    if (obligation.trigger.has_value()) stack.push_back(obligation.trigger);
  }
  while (!stack.empty()) {
    const ExprId id = stack.back();
    stack.pop_back();
    if (reached_[id.index()]) continue;
    reached_[id.index()] = true;
    for (const ExprId to : successors(id)) stack.push_back(to);
  }
}

/// Operands have smaller ids than what uses them.
void Slices::digest_terms() {
  for (std::uint32_t i = 0; i < reached_.size(); ++i) {
    if (reached_[i]) terms_[i] = digest_term(ExprId(i));
  }
}

Digest Slices::digest_term(ExprId id) const {
  const Expr& e = ts_.exprs[id];
  Hasher hasher;
  hasher.add(static_cast<std::int64_t>(e.op));
  hasher.add(static_cast<std::int64_t>(e.type));
  if (e.op == ExprOp::Variable) {
    return hasher.add(names_[e.var.index()]).finish();
  }
  hasher.add(e.value).add(e.low).add(e.high);
  const Operands under = operands(e);
  for (std::uint32_t i = 0; i < under.count; ++i) {
    hasher.add(terms_[under.ids[i].index()]);
  }
  return hasher.finish();
}

Digest Slices::definition(ExprId variable) const {
  const VarId id = ts_.exprs[variable].var;
  const Variable& var = ts_.vars[id];
  Hasher hasher;
  hasher.add(names_[id.index()]).add(static_cast<std::int64_t>(var.role));
  hasher.add(static_cast<std::int64_t>(var.type)).add(var.low).add(var.high);
  if (var.role != VarRole::State) return hasher.finish();
  const State& state = ts_.states[var.state];
  hasher.add(state.init).add(terms_[state.next.index()]);
  if (state.clock) {
    hasher.add(terms_[state.running.index()]).add(state.cap);
  }
  return hasher.finish();
}

Digest Slices::below(ExprId id) const {
  return Hasher().add(terms_[id.index()]).add(slices_[id.index()]).finish();
}

Digest Slices::of(const Obligation& obligation) const {
  Hasher hasher;
  hasher.add(kSchema).add(ts_.scan.min_ms).add(ts_.scan.max_ms);
  hasher.add(static_cast<std::int64_t>(obligation.goal));
  hasher.add(obligation.kind).add(obligation.text);
  hasher.add(std::int64_t{obligation.part});
  hasher.add(below(obligation.condition));
  const bool has_trigger = obligation.trigger.has_value();
  hasher.add(std::int64_t{has_trigger ? 1 : 0});
  if (has_trigger) hasher.add(below(obligation.trigger));
  // Any of them may cut off any run.
  hasher.add(static_cast<std::int64_t>(ts_.constraints.size()));
  for (const ExprId constraint : ts_.constraints) hasher.add(below(constraint));
  return hasher.finish();
}

std::optional<Digest> Slices::of(VarId var) const {
  const ExprId id = ts_.of(var);
  if (!reached_[id.index()]) return std::nullopt;
  return below(id);
}

std::optional<VarId> Slices::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return std::nullopt;
  return found->second;
}

}  // namespace rung
