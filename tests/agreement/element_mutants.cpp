#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/element.h"
#include "mutant.h"

namespace rung {
namespace {

/// An element kind that can be changed; the tables themselves are constants.
struct KindCopy {
  explicit KindCopy(const ElementKind& original)
      : source(&original),
        kind(original),
        states(original.states.begin(), original.states.end()),
        operations(original.operations.begin(), original.operations.end()) {
    kind.states = states;
    kind.operations = operations;
    for (ElementOperation& operation : operations) {
      updates.emplace_back(operation.updates.begin(), operation.updates.end());
      operation.updates = updates.back();
    }
  }
  KindCopy(const KindCopy&) = delete;
  KindCopy& operator=(const KindCopy&) = delete;

  const ElementKind* source;
  ElementKind kind;
  std::vector<ElementState> states;
  std::vector<ElementOperation> operations;
  std::deque<std::vector<ElementUpdate>> updates;  // by operation
  std::string text;                                // the changed formula
};

/// A formula of a kind: where it stands, and its name in the table.
struct Site {
  std::string name;
  std::string_view* text = nullptr;
  const ElementOperation* operation = nullptr;  // of the source, if of one
  std::string unchanged;  // of an update: the value without it
};

std::vector<Site> sites_of(KindCopy& copy) {
  std::vector<Site> sites;
  for (ElementState& state : copy.states) {
    sites.push_back(
        {std::string(state.name) + " runs while", &state.running, nullptr, {}});
  }
  for (std::size_t i = 0; i < copy.operations.size(); ++i) {
    const ElementOperation& source = copy.source->operations[i];
    const std::string name(source.name);
    int number = 0;
    for (ElementUpdate& update : copy.updates[i]) {
      const std::string state(update.state);
      const bool is_state =
          std::any_of(copy.states.begin(), copy.states.end(),
                      [&](const ElementState& it) { return it.name == state; });
      sites.push_back(
          {name + ", update " + std::to_string(++number) + ": " + state,
           &update.value, &source, is_state ? state + "'" : "false"});
    }
    sites.push_back({name + " is", &copy.operations[i].result, &source, {}});
  }
  sites.push_back({".q is", &copy.kind.done, nullptr, {}});
  sites.push_back({"its value is", &copy.kind.value, nullptr, {}});
  std::erase_if(sites, [](const Site& site) { return site.text->empty(); });
  return sites;
}

std::vector<std::string_view> bit_names(const ElementKind& kind,
                                        const ElementOperation* operation) {
  std::vector<std::string_view> names = {"q"};
  for (const ElementState& state : kind.states) {
    if (state.type == StateType::Bit) names.push_back(state.name);
  }
  if (operation == nullptr) return names;
  for (const ElementParameter& parameter : operation->parameters) {
    if (parameter.kind == ParameterKind::Bit) names.push_back(parameter.name);
  }
  return names;
}

std::optional<Encoding> encode(const KindCopy& copy,
                               const ElementOperation* operation,
                               const Program& program) {
  Encoding result{program, {}};
  bool concerned = false;
  for (const InstanceId id : ids_of(program.instances)) {
    if (program.instances[id].kind != copy.source) continue;
    result.program.instances[id].kind = &copy.kind;
    concerned = concerned || operation == nullptr;
  }
  for (const CallId id : ids_of(program.calls)) {
    const ElementOperation* const called = program.calls[id].operation;
    for (std::size_t i = 0; i < copy.operations.size(); ++i) {
      if (called != &copy.source->operations[i]) continue;
      result.program.calls[id].operation = &copy.operations[i];
      concerned = concerned || called == operation;
    }
  }
  if (!concerned) return std::nullopt;
  result.ts = build_transition_system(result.program);
  return result;
}

Mutant mutant_of(const ElementKind& kind, std::size_t site,
                 const std::string& text) {
  const auto copy = std::make_shared<KindCopy>(kind);
  const Site changed = sites_of(*copy)[site];
  copy->text = text;
  *changed.text = copy->text;
  return {std::string(kind.id) + ", " + changed.name + " `" + text + "`",
          [copy, operation = changed.operation](const Program& program) {
            return encode(*copy, operation, program);
          }};
}

}  // namespace

std::vector<Mutant> element_mutants() {
  std::vector<Mutant> result;
  for (const ElementKind& kind : element_kinds()) {
    KindCopy copy(kind);
    const std::vector<Site> sites = sites_of(copy);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      std::vector<std::string> texts =
          mutated_formulas(*sites[i].text, bit_names(kind, sites[i].operation));
      if (!sites[i].unchanged.empty()) texts.push_back(sites[i].unchanged);
      for (const std::string& text : texts) {
        result.push_back(mutant_of(kind, i, text));
      }
    }
  }
  return result;
}

}  // namespace rung
