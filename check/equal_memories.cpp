#include "check/equal_memories.h"

#include <map>
#include <random>
#include <set>

namespace rung::check {
namespace {

constexpr int kScans = 96;

std::vector<std::int64_t> random_inputs(const Model& model,
                                        std::mt19937_64& random) {
  std::vector<std::int64_t> inputs;
  for (const InputVariable& input : model.inputs) {
    const auto count = static_cast<std::uint64_t>(input.high - input.low) + 1;
    const std::uint64_t offset = count == 0 ? 0 : random() % count;
    inputs.push_back(input.low + static_cast<std::int64_t>(offset));
  }
  return inputs;
}

/// By state, its value at the end of each scan.
std::vector<std::vector<std::int64_t>> random_run(const Model& model) {
  std::mt19937_64 random(1);  // the same in every run of the program
  std::vector<std::int64_t> states;
  for (const StateVariable& state : model.states) {
    states.push_back(state.initial);
  }
  std::vector<std::vector<std::int64_t>> seen(states.size());
  for (int scan = 0; scan < kScans; ++scan) {
    const std::vector<std::int64_t> values =
        evaluate(model.terms(), states, random_inputs(model, random));
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i] = values[model.states[i].next.id];
      seen[i].push_back(states[i]);
    }
  }
  return seen;
}

}  // namespace

std::vector<Claim> guess_equal_memories(const Model& model,
                                        std::uint32_t first) {
  std::vector<Claim> claims;
  if (model.states.size() < std::size_t{first} + 2) return claims;
  const auto seen = random_run(model);
  std::map<std::vector<std::int64_t>, std::uint32_t> like;
  for (std::uint32_t i = first; i < model.states.size(); ++i) {
    const StateVariable& state = model.states[i];
    // What never changed there says nothing.
    if (std::set(seen[i].begin(), seen[i].end()).size() < 2) continue;
    const auto [at, is_new] = like.try_emplace(seen[i], i);
    const StateVariable& other = model.states[at->second];
    const bool word = model.terms()[state.now.id].word;
    if (is_new || word != model.terms()[other.now.id].word) continue;
    claims.push_back(
        {state.now == other.now, state.name + " == " + other.name});
  }
  return claims;
}

}  // namespace rung::check
