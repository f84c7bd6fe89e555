// Scope: calls of function blocks and of the project's functions.

#include <algorithm>
#include <utility>

#include "frontend/iec/scope.h"
#include "frontend/iec/token.h"

namespace rung::iec {
namespace {

using SymbolKind = Symbol::Kind;

struct Parameter {
  std::string_view name;
  Role role = Role::Input;
  const Pin* pin = nullptr;  // of a standard block
};

std::vector<Parameter> parameters_of(const Symbol& instance) {
  std::vector<Parameter> list;
  for (const Pin& pin : instance.block->inputs) {
    list.push_back({pin.name, Role::Input, &pin});
  }
  for (const Pin& pin : instance.block->outputs) {
    list.push_back({pin.name, Role::Output, &pin});
  }
  return list;
}

std::vector<Parameter> parameters_of(const Pou& pou) {
  std::vector<Parameter> list;
  for (const Variable& variable : pou.variables) {
    const bool outside = variable.role == Role::Input ||
                         variable.role == Role::Output ||
                         variable.role == Role::InOut;
    if (outside) list.push_back({variable.name, variable.role, nullptr});
  }
  return list;
}

}  // namespace

/// One call: what is called, its parameters, and the argument of each.
struct Scope::Call {
  Symbol* instance = nullptr;  // null: a function
  Frame* frame = nullptr;
  SourceRange where;
  std::string_view name;  // of the block or the function
  std::vector<Parameter> parameters;
  std::vector<std::pair<std::size_t, Argument>> inputs;  // with IN_OUT
  std::vector<std::pair<std::size_t, Argument>> outputs;
  std::optional<Value> enable;
  Argument* enabled = nullptr;  // ENO =>
  std::vector<Argument> rest;   // EN and ENO
};

void Scope::no_such_parameter(const Call& call, const Argument& argument) {
  std::string names;
  for (const Parameter& it : call.parameters) {
    names += (names.empty() ? "" : " ") + std::string(it.name);
  }
  fail("RP049", argument.where,
       argument.name.empty()
           ? "a " + std::string(call.name) + " has no more inputs: it has " +
                 names
           : "a " + std::string(call.name) + " has no " +
                 (argument.output ? "output " : "input ") +
                 quoted_excerpt(argument.name) + ": it has " + names);
}

bool Scope::match(Call& call, std::vector<Argument>& arguments) {
  std::vector<bool> given(call.parameters.size(), false);
  std::size_t place = 0;
  call.rest.reserve(arguments.size());
  for (Argument& argument : arguments) {
    const SourceRange where = argument.where;
    if (argument.name == "EN" && !argument.output) {
      call.enable = convert(std::move(argument.value), kBool, where);
      if (!call.enable) return false;
      continue;
    }
    if (argument.name == "ENO" && argument.output) {
      call.rest.push_back(std::move(argument));
      call.enabled = &call.rest.back();
      continue;
    }
    std::size_t index = place;
    if (argument.name.empty()) {
      ++place;
    } else {
      index = 0;
      while (index < call.parameters.size() &&
             upper(call.parameters[index].name) != argument.name) {
        ++index;
      }
    }
    const bool known = index < call.parameters.size();
    const bool is_output = known && call.parameters[index].role == Role::Output;
    if (known && argument.name.empty()) argument.output = is_output;
    if (!known || is_output != argument.output) {
      no_such_parameter(call, argument);
      return false;
    }
    if (given[index]) {
      fail("RP049", where,
           quoted_excerpt(call.parameters[index].name) +
               " is given a second time");
      return false;
    }
    given[index] = true;
    (is_output ? call.outputs : call.inputs)
        .emplace_back(index, std::move(argument));
  }
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i] || call.parameters[i].role != Role::InOut) continue;
    fail("RP049", call.where,
         quoted_excerpt(call.parameters[i].name) +
             " is VAR_IN_OUT: each call names a variable for it");
    return false;
  }
  return true;
}

Symbol* Scope::parameter_symbol(Call& call, std::size_t index,
                                SourceRange where) {
  const Parameter& parameter = call.parameters[index];
  if (parameter.pin != nullptr) {
    return &expansion_->pin(*call.instance, *parameter.pin, where);
  }
  const auto found = call.frame->names.find(upper(parameter.name));
  if (found != call.frame->names.end()) return found->second;
  fail("RP041", where,
       quoted_excerpt(parameter.name) + " has a declaration with an error");
  return nullptr;
}

bool Scope::give_input(Call& call, std::size_t index) {
  auto& [place, argument] = call.inputs[index];
  const Parameter& parameter = call.parameters[place];
  const SourceRange where = argument.where;
  if (parameter.role != Role::InOut) {
    Symbol* const symbol = parameter_symbol(call, place, where);
    return symbol != nullptr &&
           write(*symbol, std::move(argument.value), where, where);
  }
  Symbol* const variable = variable_of(argument.value);
  if (variable == nullptr) {
    fail(
        "RP049", where,
        quoted_excerpt(parameter.name) + " is VAR_IN_OUT and takes a variable");
    return false;
  }
  const std::string key = upper(parameter.name);
  for (const Variable& it : call.frame->pou->variables) {
    if (upper(it.name) != key || upper(it.type) == variable->type->name) {
      continue;
    }
    fail("RP049", where,
         quoted_excerpt(parameter.name) + " is a " + std::string(it.type) +
             ", and " + quoted_excerpt(variable->name) + " is a " +
             std::string(variable->type->name));
    return false;
  }
  call.frame->names.insert_or_assign(key, variable);
  return true;
}

bool Scope::give_inputs(Call& call) {
  for (std::size_t i = 0; i < call.inputs.size(); ++i) {
    if (!give_input(call, i)) return false;
  }
  return true;
}

/// EN keeps what it was given: a call that does not give it goes on to obey.
bool Scope::give_enable(Call& call) {
  Symbol& instance = *call.instance;
  const bool has_cell = call.frame->names.contains("EN");
  const bool always = !call.enable || call.enable->constant == 1;
  if (!call.enable && !has_cell) instance.called_without_en = true;
  if (call.enable && !has_cell && always) {
    call.enable.reset();
  } else if (call.enable || has_cell) {
    if (instance.called_without_en && !has_cell) {
      fail("RP049", call.where,
           "EN is given here and not in a call above: that is not supported");
      return false;
    }
    Symbol& cell = expansion_->enable_pin(*call.frame, "EN", call.where);
    if (call.enable &&
        !write(cell, std::move(*call.enable), call.where, call.where)) {
      return false;
    }
    call.enable = read(cell, call.where);
  }
  if (!expansion_->mentions("ENO")) return true;
  Symbol& cell = expansion_->enable_pin(*call.frame, "ENO", call.where);
  const Value on = call.enable ? *call.enable : bit(true, call.where);
  assign(cell, on.nodes, call.where, call.where);
  expansion_->set_known(cell, on.constant);
  return true;
}

bool Scope::run_block(const Symbol& instance, SourceRange where) {
  const Block& block = *instance.block;
  std::optional<std::int64_t> preset;
  Expression operands;
  for (const Pin& pin : block.inputs) {
    const Symbol& symbol = expansion_->pin(instance, pin, where);
    if (symbol.kind == SymbolKind::Preset) {
      preset = symbol.known;
    } else {
      push_leaf(operands, AstOp::Name, symbol.name, where);
    }
  }
  if (block.is_timer() && !preset) {
    fail("RP045", where,
         quoted_excerpt(instance.name) +
             " has no PT here: give it in the call, or above it and behind no "
             "condition");
    return false;
  }
  for (const Pin& pin : block.outputs) {
    const bool first = pin.name == block.outputs.front().name;
    if (!expansion_->has_cell(block, pin)) continue;
    const std::string_view operation =
        first ? block.name
              : writer().keep_text(std::string(block.name) + "." +
                                   std::string(pin.name));
    const bool timed = block.is_timer();
    Symbol& output = expansion_->pin(instance, pin, where);
    assign(output,
           writer().call(operation, first ? operands : Expression(),
                         instance.element,
                         timed ? preset : std::optional<std::int64_t>(), where),
           where, where);
    expansion_->set_known(output, std::nullopt);
  }
  return true;
}

bool Scope::execute(Call& call) {
  const Context outer = expansion_->context();
  if (call.enable) {
    expansion_->enter(keep_condition(call.enable->nodes, call.where));
  }
  const bool good =
      call.instance != nullptr && call.instance->kind == SymbolKind::Block
          ? run_block(*call.instance, call.where)
          : expansion_->execute(*call.frame, call.where);
  expansion_->restore(outer);
  return good;
}

bool Scope::take_outputs(Call& call) {
  for (auto& [place, argument] : call.outputs) {
    const SourceRange where = argument.where;
    Symbol* const source = parameter_symbol(call, place, where);
    if (source == nullptr) return false;
    std::optional<Value> value = read(*source, where);
    if (value && argument.negated) value = invert(std::move(*value), where);
    Symbol* const target = argument.variable != nullptr
                               ? argument.variable
                               : variable_of(argument.value);
    if (!value) return false;
    if (target == nullptr) {
      fail("RP049", where, "an output is given to a variable");
      return false;
    }
    if (!write(*target, std::move(*value), where, where)) return false;
  }
  if (call.enabled == nullptr) return true;
  const SourceRange where = call.enabled->where;
  Symbol& cell = expansion_->enable_pin(*call.frame, "ENO", where);
  std::optional<Value> value = read(cell, where);
  if (value && call.enabled->negated) value = invert(std::move(*value), where);
  return value && call.enabled->variable != nullptr &&
         write(*call.enabled->variable, std::move(*value), where, where);
}

bool Scope::call(Symbol& instance, std::vector<Argument> arguments,
                 SourceRange where) {
  if (!step(where)) return false;
  const bool standard = instance.kind == SymbolKind::Block;
  if (!standard && instance.kind != SymbolKind::Instance) {
    if (instance.kind == SymbolKind::Unsupported) {
      read(instance, where);  // says what is not supported
    } else {
      fail("RP049", where,
           quoted_excerpt(instance.name) + " is no function block");
    }
    return false;
  }
  Call call{.instance = &instance,
            .frame = instance.frame,
            .where = where,
            .name = standard ? instance.block->name : instance.frame->pou->name,
            .parameters = standard ? parameters_of(instance)
                                   : parameters_of(*instance.frame->pou)};
  if (!match(call, arguments) || !give_inputs(call) || !give_enable(call)) {
    return false;
  }
  const Pou* const pou = instance.frame->pou;
  if (pou != nullptr) expansion_->reset(*instance.frame, where);
  const bool good = execute(call) && take_outputs(call);
  for (const Parameter& parameter : call.parameters) {
    if (parameter.role == Role::InOut) {
      instance.frame->names.erase(upper(parameter.name));
    }
  }
  return good;
}

std::optional<Value> Scope::own_function(const Pou& pou,
                                         std::vector<Argument> arguments,
                                         SourceRange where) {
  if (!step(where)) return std::nullopt;
  Call call{.frame = &expansion_->function_frame(pou, where),
            .where = where,
            .name = pou.name,
            .parameters = parameters_of(pou)};
  if (!match(call, arguments) || !give_inputs(call)) return std::nullopt;
  if (call.enable && call.enable->constant == 1) call.enable.reset();
  if (call.enable) call.enable = once(std::move(*call.enable), where, "en");
  if (expansion_->mentions("ENO")) {
    const Value on = call.enable ? *call.enable : bit(true, where);
    expansion_->set(expansion_->enable_pin(*call.frame, "ENO", where), on.nodes,
                    where);
  }
  if (!execute(call) || !take_outputs(call)) return std::nullopt;
  const auto result = call.frame->names.find(upper(pou.name));
  if (result == call.frame->names.end()) return std::nullopt;
  return read(*result->second, where);
}

Value Scope::edge(bool rising, Value clk, std::string_view site,
                  SourceRange where) {
  const std::string key = "." + std::string(site);
  const Block& block = *find_block(rising ? "R_TRIG" : "F_TRIG");
  Symbol& trigger = expansion_->hidden_block(*frame_, key, block, where);
  std::vector<Argument> arguments(1);
  arguments[0].name = "CLK";
  arguments[0].value = std::move(clk);
  arguments[0].where = where;
  call(trigger, std::move(arguments), where);
  return *read(expansion_->pin(trigger, block.outputs.front(), where), where);
}

}  // namespace rung::iec
