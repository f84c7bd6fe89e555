#include "backend/script/elements.h"

#include <string>
#include <utility>

#include "backend/unit/elements_common.h"

namespace rung::backend {
namespace {

/// Milliseconds as seconds: "0.5".
std::string seconds(std::int64_t milliseconds) {
  std::string text = std::to_string(milliseconds / 1000);
  std::string rest = std::to_string(1000 + milliseconds % 1000).substr(1);
  while (!rest.empty() && rest.back() == '0') rest.pop_back();
  return rest.empty() ? text : text + "." + rest;
}

class ScriptElements : public MappedElements {
 public:
  explicit ScriptElements(bool yun) : yun_(yun) {}

  Terms call(UnitBuilder& builder, const ElementCall& call,
             std::vector<Terms> arguments) override {
    const Instance& instance = builder.program().instances[call.instance];
    Use& use = use_of(call);
    const std::string_view kind = instance.kind->id;
    if (is_native(instance)) return native(builder, call, arguments);
    if (call.operation->reads) {
      builder.fail(call.where, "`" + instance.name + "`: scripts have no `" +
                                   std::string(call.operation->name) + "`");
      return constant_term(Type::Bit, 0);
    }
    if (kind == "ton" || kind == "tof") {
      // Without a delay the output is the input.
      if (call.parameter == 0) return std::move(arguments[0]);
      return builder.inline_call(head(kind == "ton" ? "T" : "TOF", use.index) +
                                     seconds(call.parameter) + ", ",
                                 arguments);
    }
    if (kind == "sr" || kind == "rs") {
      return builder.result_of(
          call, latch_as_bit(builder, use, kind == "sr", arguments));
    }
    return edge_as_bit(builder, call, use, arguments[0]);
  }

  bool inline_only() const override { return !hoists_; }

 private:
  bool is_native(const Instance& instance) const {
    return instance.kind->dialect == (yun_ ? "yun" : "sim");
  }

  void declare_instance(UnitBuilder& builder, const Instance& instance,
                        Use& use) override {
    const std::string_view kind = instance.kind->id;
    if (is_native(instance)) {
      relate_native(builder, instance);
      return;
    }
    const bool edges = kind == "edge" || kind == "r-trig" || kind == "f-trig";
    const bool latches = kind == "sr" || kind == "rs";
    const bool timers = kind == "ton" || kind == "tof";
    const bool one = use.presets.size() <= 1;
    if (yun_ || !(edges || latches || (timers && one))) {
      return builder.fail(instance.where,
                          "a script of the dialect " +
                              std::string(yun_ ? "yun" : "sim") +
                              " has nothing for `" + instance.name + "`, a " +
                              std::string(kind) +
                              (timers && !one ? " with several presets" : ""));
    }
    if (!timers) {
      hoists_ = true;
      return add_state(builder, instance, use, "last");
    }
    if (use.presets.empty() || *use.presets.begin() == 0) return;
    use.index = next_index_++;
    const bool off_delay = kind == "tof";
    builder.unit().blocks.add(
        {.name = (off_delay ? "TOF(" : "T(") + std::to_string(use.index) + ")",
         .source = instance.name});
    relate_timer(builder, instance.name, off_delay, false,
                 *use.presets.begin());
  }

  static std::string head(std::string_view name, std::int64_t index) {
    return std::string(name) + "(" + std::to_string(index) + ", ";
  }

  static void relate_native(UnitBuilder& builder, const Instance& instance) {
    for (const ElementState& state : instance.kind->states) {
      const std::string name = instance.name + "." + std::string(state.name);
      const bool bit = state.type == StateType::Bit;
      builder.unit().relations.push_back(
          {bit ? "x <-> y" : "x == y", {{"x", name}, {"y", name, true}}});
    }
  }

  Terms native(UnitBuilder& builder, const ElementCall& call,
               const std::vector<Terms>& arguments) {
    const Instance& instance = builder.program().instances[call.instance];
    std::string text = head(call.operation->name, instance.index);
    for (const ElementParameter& parameter : call.operation->parameters) {
      if (parameter.kind == ParameterKind::Seconds) {
        text += seconds(call.parameter) + ", ";
      } else if (parameter.kind == ParameterKind::Count) {
        text += std::to_string(call.parameter) + ", ";
      }
    }
    return builder.inline_call(std::move(text), arguments);
  }

  bool yun_;
  bool hoists_ = false;
  std::int64_t next_index_ = 0;
};

}  // namespace

std::unique_ptr<Elements> script_elements(bool yun) {
  return std::make_unique<ScriptElements>(yun);
}

}  // namespace rung::backend
