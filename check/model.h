#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "analysis/program.h"
#include "check/terms.h"

namespace rung::check {

/// A state variable: a cell, a state of an element, or what a property has to
/// remember; its value at a scan's end.
struct StateVariable {
  std::string name;
  Value now;  // before the scan
  Value next;
  std::int64_t initial = 0;  // before the first scan
  /// Claims that are proved with every certificate.
  std::optional<std::int64_t> low;
  std::optional<std::int64_t> high;
};

struct InputVariable {
  Value now;
  std::int64_t low = 0;
  std::int64_t high = 1;
};

/// What certificates call terms.
class Names {
 public:
  /// A name for two values is no name.
  void add(const std::string& text, Value value);
  /// No value: nothing is called so, or two things are.
  std::optional<Value> find(const std::string& text) const;
  /// The longest name that `text` begins with; 0: none.
  std::size_t longest(std::string_view text) const;

 private:
  std::unordered_map<std::string, Value> names_;
  std::unordered_set<std::string> ambiguous_;
  std::vector<std::size_t> lengths_;  // of names, each once, longest first
};

/// One scan as a relation between what is before it and what is after it.
///
/// `names` are what certificates may speak of, as terms over the states: their
/// text is the certificate's, their meaning is ours. So nothing rests on what
/// the engines meant: a lemma is what it says here, and is proved here.
class Model {
 public:
  Terms& terms() { return terms_; }
  const Terms& terms() const { return terms_; }

  Value add_input(const std::string& name, bool word, std::int64_t low,
                  std::int64_t high);
  /// Bounds of a word that is known to have them, else claims.
  std::uint32_t add_state(std::string name, bool word, std::int64_t initial);
  void claim(std::uint32_t state, std::optional<std::int64_t> low,
             std::optional<std::int64_t> high);

  /// What certificates call `value`, a term over the states before the scan.
  void name(const std::string& text, Value value);

  Names names;       // of terms over states
  Names scan_names;  // also of inputs and of dt
  std::vector<StateVariable> states;
  std::vector<InputVariable> inputs;
  std::vector<Value> assumptions;  // of every scan
  Value dt;
  std::string unknown_element;  // its name, when there is one

 private:
  Terms terms_;
};

/// The values of terms in one scan. `states` and `inputs` by index.
std::vector<std::int64_t> evaluate(const Terms& terms,
                                   const std::vector<std::int64_t>& states,
                                   const std::vector<std::int64_t>& inputs);

/// What properties may look at, at a scan's end.
struct ProgramValues {
  std::vector<Value> cells;                  // by CellId
  std::vector<std::vector<Value>> elements;  // by InstanceId
  std::vector<Value> fired;                  // by InstanceId
  std::vector<std::uint32_t> cell_state;     // by CellId; kNoState of inputs
  std::vector<std::vector<std::uint32_t>> element_state;  // by InstanceId
  static constexpr std::uint32_t kNoState = 0xffff'ffff;
};

/// One of two programs that run side by side.
struct Side {
  std::string prefix;  // of all that certificates name
  /// By an input's name here: the other side's that it is the same as.
  std::unordered_map<std::string, Value> inputs;
  /// By InstanceId: where its clocks are cut when certificates name them;
  /// empty: at Instance::clock_cap. Counts are not cut then.
  std::vector<std::int64_t> clock_caps;
};

/// Encodes `program`: one scan, assignment by assignment.
/// Limits: linear in the program.
ProgramValues encode_program(const Program& program, Model& model,
                             const Side& side = {});

}  // namespace rung::check
