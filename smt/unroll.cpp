#include "smt/unroll.h"

namespace rung {

Unrolling::Unrolling(const Aig& step, const std::vector<StateBit>& bits,
                     Start start)
    : step_(&step), start_(start), bits_(bits) {
  for (std::uint32_t i = 0; i < bits_.size(); ++i) {
    const std::uint32_t node = aig_node(bits_[i].leaf);
    if (node >= bit_of_.size()) bit_of_.resize(node + 1, 0);
    bit_of_[node] = i + 1;
  }
}

AigLit Unrolling::known(std::uint32_t frame, AigLit of) const {
  if (frame >= copies_.size() || aig_node(of) >= copies_[frame].size()) {
    return kNone;
  }
  const AigLit copy = copies_[frame][aig_node(of)];
  return copy == kNone ? kNone : copy ^ (of & 1U);
}

void Unrolling::push(std::uint32_t frame, AigLit of) {
  stack_.push_back({frame, aig_node(of)});
}

bool Unrolling::copy(Place place) {
  const auto [frame, node] = place;
  AigLit result = kAigFalse;
  if (node == 0) {
    result = kAigFalse;
  } else if (step_->is_gate(node)) {
    const AigLit left = known(frame, step_->left(node));
    const AigLit right = known(frame, step_->right(node));
    if (left == kNone) push(frame, step_->left(node));
    if (right == kNone) push(frame, step_->right(node));
    if (left == kNone || right == kNone) return false;
    result = aig_.conjunction(left, right);
  } else if (node < bit_of_.size() && bit_of_[node] != 0) {
    const StateBit& bit = bits_[bit_of_[node] - 1];
    if (frame > 0) {
      result = known(frame - 1, bit.next);
      if (result == kNone) {
        push(frame - 1, bit.next);
        return false;
      }
    } else if (start_ == Start::Any) {
      result = aig_.input();
    } else {
      result = bit.init ? kAigTrue : kAigFalse;
    }
  } else {
    result = aig_.input();
  }
  copies_[frame][node] = result;
  return true;
}

AigLit Unrolling::at(std::uint32_t frame, AigLit of) {
  if (copies_.size() <= frame) copies_.resize(frame + 1);
  for (std::uint32_t i = 0; i <= frame; ++i) {
    if (copies_[i].size() < step_->size()) {
      copies_[i].resize(step_->size(), kNone);
    }
  }
  push(frame, of);
  while (!stack_.empty()) {
    const Place place = stack_.back();
    if (copies_[place.frame][place.node] != kNone || copy(place)) {
      // copy() pushes only when it returns false, so this is still the top.
      stack_.pop_back();
    }
  }
  return known(frame, of);
}

}  // namespace rung
