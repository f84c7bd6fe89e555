#include "frontend/iec/scope.h"

#include <algorithm>

#include "base/text.h"
#include "frontend/iec/functions.h"
#include "frontend/iec/token.h"

namespace rung::iec {

using SymbolKind = Symbol::Kind;

Symbol* Scope::find(std::string_view name) {
  const std::string key = upper(name);
  const auto found = frame_->names.find(key);
  if (found != frame_->names.end()) return found->second;
  const Pou* const pou = frame_->pou;
  const bool enable = key == "EN" || key == "ENO";
  if (enable && pou->kind != PouKind::Program && !pou->by_use) {
    return &expansion_->enable_pin(*frame_, key, pou->where);
  }
  return nullptr;
}

Symbol* Scope::get(std::string_view name, SourceRange where) {
  if (name.starts_with("%")) return expansion_->at_address(name, where);
  if (Symbol* const symbol = find(name)) return symbol;
  if (frame_->pou->by_use) {
    return &expansion_->add_by_use(*frame_, name, where);
  }
  fail("RP041", where,
       quoted_excerpt(name) + " is not declared" + suggestion(name));
  return nullptr;
}

std::string Scope::suggestion(std::string_view name) const {
  if (expansion_->errors().is_full()) return {};
  std::vector<std::string_view> known;
  for (const Symbol* const symbol : frame_->order) {
    // The last part: names of instances are paths.
    const std::size_t dot = symbol->name.rfind('.');
    known.push_back(dot == std::string_view::npos
                        ? symbol->name
                        : symbol->name.substr(dot + 1));
  }
  return did_you_mean(name, known);
}

Symbol* Scope::member(Symbol& instance, std::string_view name,
                      SourceRange where) {
  const std::string key = upper(name);
  const bool enable = key == "EN" || key == "ENO";
  if (instance.kind == SymbolKind::Block) {
    const Block& block = *instance.block;
    const Pin* found = find_pin(block.outputs, key);
    if (found == nullptr) found = find_pin(block.inputs, key);
    if (found != nullptr && expansion_->has_cell(block, *found)) {
      return &expansion_->pin(instance, *found, where);
    }
    if (enable) return &expansion_->enable_pin(*instance.frame, key, where);
    fail("RP049", where,
         "a " + std::string(block.name) + " has no " + quoted_excerpt(name) +
             ": it has " + pin_list(block));
    return nullptr;
  }
  if (instance.kind != SymbolKind::Instance) {
    if (instance.kind == SymbolKind::Unsupported) {
      read(instance, where);  // says what is not supported
    } else {
      fail("RP049", where,
           quoted_excerpt(instance.name) + " is no function block");
    }
    return nullptr;
  }
  const auto found = instance.frame->names.find(key);
  if (found != instance.frame->names.end()) {
    const Role role = found->second->role;
    const bool nested = found->second->kind == SymbolKind::Instance ||
                        found->second->kind == SymbolKind::Block;
    if (role == Role::Input || role == Role::Output || nested) {
      return found->second;
    }
    fail("RP049", where,
         quoted_excerpt(name) + " is no input and no output of " +
             quoted_excerpt(instance.name));
    return nullptr;
  }
  if (enable) return &expansion_->enable_pin(*instance.frame, key, where);
  fail("RP049", where,
       quoted_excerpt(instance.frame->pou->name) + " has no " +
           quoted_excerpt(name));
  return nullptr;
}

Symbol* Scope::resolve(std::string_view path, SourceRange where) {
  if (path.starts_with("%")) return get(path, where);
  std::size_t dot = path.find('.');
  Symbol* symbol = get(path.substr(0, dot), where);
  while (symbol != nullptr && dot != std::string_view::npos) {
    path.remove_prefix(dot + 1);
    dot = path.find('.');
    symbol = member(*symbol, path.substr(0, dot), where);
  }
  return symbol;
}

std::optional<Value> Scope::read(Symbol& symbol, SourceRange where) {
  switch (symbol.kind) {
    case SymbolKind::Constant:
      return number(symbol.value, *symbol.type, where);
    case SymbolKind::Cell: {
      Value value{{}, symbol.type, {}, where};
      push_leaf(value.nodes, AstOp::Name, symbol.name, where);
      value.symbol = &symbol;
      return value;
    }
    case SymbolKind::Preset:
      fail("RP049", where, "PT of a timer cannot be read: it is a constant");
      return std::nullopt;
    case SymbolKind::Block:
    case SymbolKind::Instance:
      fail("RP049", where,
           quoted_excerpt(symbol.name) +
               " is a function block: name an output of it");
      return std::nullopt;
    case SymbolKind::Unsupported: {
      if (symbol.written) return std::nullopt;  // said before
      symbol.written = true;
      std::vector<std::string_view> known = type_names();
      for (const std::string_view name : block_names()) known.push_back(name);
      fail("RP041", where,
           "the type " + quoted_excerpt(symbol.type_name) + " of this " +
               "variable is not supported" +
               did_you_mean(upper(symbol.type_name), known));
      return std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<Value> Scope::read(std::string_view path, SourceRange where) {
  Symbol* const symbol = resolve(path, where);
  return symbol == nullptr ? std::nullopt : read(*symbol, where);
}

/// Not one that a VAR_IN_OUT of this unit stands for.
bool Scope::is_output_of_other(const Symbol& symbol) const {
  if (symbol.role != Role::Output || symbol.owner == frame_ ||
      symbol.owner->path.empty()) {
    return false;
  }
  return std::none_of(frame_->names.begin(), frame_->names.end(),
                      [&](const auto& name) { return name.second == &symbol; });
}

bool Scope::check_writable(Symbol& symbol, SourceRange where) {
  if (symbol.kind == SymbolKind::Unsupported ||
      symbol.kind == SymbolKind::Block || symbol.kind == SymbolKind::Instance) {
    read(symbol, where);  // says why not
    return false;
  }
  if (is_output_of_other(symbol)) {
    fail("RP049", where,
         quoted_excerpt(symbol.name) +
             " is an output: only the block writes it");
    return false;
  }
  const bool constant = symbol.kind == SymbolKind::Constant;
  if (!constant && !symbol.sampled && !symbol.locked) return true;
  fail("RP044", where,
       quoted_excerpt(symbol.name) +
           (constant         ? " is a constant"
            : symbol.sampled ? " is an input"
                             : " is the variable of a FOR") +
           ": no statement can write it");
  return false;
}

bool Scope::set_preset(Symbol& preset, const Value& value, SourceRange where) {
  std::optional<std::int64_t> time = value.constant;
  if (value.type == &kTime && !time && value.nodes.size() == 1) {
    Symbol* const variable = variable_of(value);
    if (variable != nullptr && variable->known) time = variable->known;
    if (variable != nullptr && !time && !variable->sampled &&
        !variable->written) {
      time = expansion_->assume_unwritten(*variable, where);
    }
  }
  if (value.type != &kTime || !time) {
    fail("RP045", where,
         "PT must be a TIME literal or a constant: no other preset is "
         "supported");
    return false;
  }
  expansion_->set_known(preset, *time);
  return true;
}

void Scope::assign(Symbol& target, const Expression& value,
                   SourceRange target_where, SourceRange where) {
  target.written = true;
  writer().assign(target.name, target.type->kind != Kind::Bool, target_where,
                  value, where);
}

bool Scope::write(Symbol& target, Value value, SourceRange target_where,
                  SourceRange where) {
  if (target.kind == SymbolKind::Preset) {
    return set_preset(target, value, where);
  }
  if (!check_writable(target, target_where)) return false;
  const std::optional<Value> fitting =
      convert(std::move(value), *target.type, where);
  if (!fitting) return false;
  std::optional<std::int64_t> known = fitting->constant;
  if (!known) {
    if (const Symbol* const source = variable_of(*fitting)) {
      known = source->known;
    }
  }
  assign(target, fitting->nodes, target_where, where);
  expansion_->set_known(target, known);
  return true;
}

bool Scope::write(std::string_view path, Value value, SourceRange target_where,
                  SourceRange where) {
  Symbol* const symbol = resolve(path, target_where);
  return symbol != nullptr &&
         write(*symbol, std::move(value), target_where, where);
}

Symbol* Scope::variable_of(const Value& value) {
  const bool leaf = value.nodes.size() == 1 && value.nodes[0].op == AstOp::Name;
  const bool same = leaf && value.symbol != nullptr &&
                    value.symbol->name == value.nodes[0].text;
  return same ? value.symbol : nullptr;
}

std::optional<Value> Scope::literal(std::string_view text, SourceRange where) {
  if (const auto literal = read_literal(text)) {
    return number(literal->value, *literal->type, where);
  }
  const std::string word = upper(text);
  const bool time = word.starts_with("T#") || word.starts_with("TIME#");
  fail("RP043", where,
       quoted_excerpt(text) +
           (time ? " is no time: T#1h2m3s4ms, in whole milliseconds, up to 24 "
                   "days"
                 : " is no literal of a type that is supported: TRUE, 12, "
                   "16#ff, INT#5, up to 32 bits, or T#1s"));
  return std::nullopt;
}

// --- conditions --------------------------------------------------------------

std::string_view Scope::keep_condition(const Expression& condition,
                                       SourceRange where) {
  const std::string_view guard = writer().guard();
  if (guard.empty()) return writer().keep("run", kBitCell, condition, where);
  Expression on;
  push_leaf(on, AstOp::Name, guard, where);
  push_all(on, condition);
  push_binary(on, AstOp::And, where);
  return writer().keep("run", kBitCell, on, where);
}

Context Scope::here() const {
  Context context = expansion_->context();
  context.gone = gone_;
  return context;
}

Context Scope::enter(const Value& condition, SourceRange where) {
  const Context outer = here();
  expansion_->enter(keep_condition(condition.nodes, where));
  return outer;
}

void Scope::leave(const Context& outer, SourceRange where) {
  expansion_->restore(outer);
  if (gone_ == outer.gone) return;
  // A RETURN in there goes on to hold.
  Expression on;
  push_leaf(on, AstOp::Name, gone_, where);
  push_unary(on, AstOp::Not, where);
  expansion_->enter(keep_condition(on, where));
}

void Scope::leave_body(SourceRange where) {
  Expression gone;
  const std::string_view guard = writer().guard();
  if (guard.empty()) {
    push_leaf(gone, AstOp::Bool, "true", where);
  } else {
    push_leaf(gone, AstOp::Name, guard, where);
  }
  if (!gone_.empty()) {
    push_leaf(gone, AstOp::Name, gone_, where);
    push_binary(gone, AstOp::Or, where);
  }
  gone_ = writer().keep("gone", kBitCell, gone, where);
  Expression on;
  push_leaf(on, AstOp::Bool, "false", where);
  expansion_->enter(writer().keep("run", kBitCell, on, where));
}

}  // namespace rung::iec
