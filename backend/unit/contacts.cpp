#include "backend/unit/contacts.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "backend/unit/elements_common.h"

namespace rung::backend {
namespace {

std::optional<Coil> keeping(CellId target, const Terms& value) {
  const NodeOp op = value.back().op;
  if (op != NodeOp::Or && op != NodeOp::And) return std::nullopt;
  const auto right = value.end() - 1 - value[value.size() - 2].size;
  const auto is_target = [&](Terms::const_iterator begin,
                             Terms::const_iterator end) {
    return end - begin == 1 && begin->op == NodeOp::Read &&
           begin->cell == target;
  };
  Terms condition;
  if (is_target(value.begin(), right)) {
    condition.assign(right, value.end() - 1);
  } else if (is_target(right, value.end() - 1)) {
    condition.assign(value.begin(), right);
  } else {
    return std::nullopt;
  }
  if (op == NodeOp::Or) return Coil{std::move(condition), Storage::Set};
  return Coil{negated(std::move(condition)), Storage::Reset};
}

}  // namespace

bool is_comparison(NodeOp op) {
  return op == NodeOp::Equal || op == NodeOp::NotEqual || op == NodeOp::Less ||
         op == NodeOp::LessEqual || op == NodeOp::Greater ||
         op == NodeOp::GreaterEqual;
}

Coil coil_for(CellId target, const Terms& value, const Terms& guard) {
  if (guard.empty()) {
    if (auto coil = keeping(target, value)) return std::move(*coil);
    return {value};
  }
  if (value.size() == 1 && value[0].op == NodeOp::Constant) {
    return {guard, value[0].value != 0 ? Storage::Set : Storage::Reset};
  }
  return {either(both(guard, value),
                 both(negated(guard), read_term(target, Type::Bit)))};
}

Terms without_comparisons(const Terms& terms,
                          const std::function<CellId(Terms)>& stand_in) {
  std::vector<Term> kept;  // from the end
  for (std::size_t at = terms.size(); at > 0;) {
    const Term& term = terms[at - 1];
    if (!is_comparison(term.op)) {
      kept.push_back(term);
      --at;
      continue;
    }
    const auto begin = static_cast<std::ptrdiff_t>(at - term.size);
    const auto end = static_cast<std::ptrdiff_t>(at);
    const CellId bit = stand_in({terms.begin() + begin, terms.begin() + end});
    kept.push_back(read_term(bit, Type::Bit)[0]);
    at -= term.size;
  }
  if (kept.size() == terms.size()) return terms;
  Terms result;  // with the sizes of its subtrees, anew
  for (auto term = kept.rbegin(); term != kept.rend(); ++term) {
    const bool leaf = term->op == NodeOp::Read || term->op == NodeOp::Constant;
    if (leaf) {
      result.push_back(*term);
    } else {
      push_operator(result, term->op, term->type,
                    term->op == NodeOp::Not ? 1 : 2);
    }
  }
  return result;
}

Network network_at(const Network& network, std::uint32_t part) {
  Network own = {network[part]};
  for (std::size_t i = 0; i < own.size(); ++i) {
    for (std::size_t at = 0; at < own[i].parts.size(); ++at) {
      Circuit inner = network[own[i].parts[at]];
      own[i].parts[at] = static_cast<std::uint32_t>(own.size());
      own.push_back(std::move(inner));
    }
  }
  return own;
}

}  // namespace rung::backend
