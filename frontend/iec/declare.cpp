// Expansion: the cells and elements of variables.

#include <algorithm>

#include "base/text.h"
#include "frontend/iec/expansion.h"
#include "frontend/iec/token.h"

namespace rung::iec {
namespace {

using SymbolKind = Symbol::Kind;

constexpr std::uint32_t kMaxDepth = 50;

AstDeclaration::Kind kind_of(Role role) {
  if (role == Role::Input) return AstDeclaration::Kind::Input;
  if (role == Role::Output) return AstDeclaration::Kind::Output;
  return AstDeclaration::Kind::Memory;
}

Role role_of_area(char area) {
  if (area == 'I') return Role::Input;
  return area == 'Q' ? Role::Output : Role::Local;
}

}  // namespace

Symbol& Expansion::add_symbol(Frame& frame, const std::string& key,
                              Symbol symbol) {
  symbol.owner = &frame;
  symbols_.push_back(symbol);
  frame.names.emplace(key, &symbols_.back());
  frame.order.push_back(&symbols_.back());
  return symbols_.back();
}

Symbol& Expansion::add_cell(Frame& frame, std::string_view name,
                            const Type& type, Role role, SourceRange where) {
  Symbol symbol;
  symbol.type = &type;
  symbol.role = role;
  symbol.where = where;
  const bool inside = !frame.path.empty();
  symbol.name =
      inside ? writer_.keep_text(frame.path + std::string(name)) : name;
  const auto kind = inside ? AstDeclaration::Kind::Memory : kind_of(role);
  symbol.sampled = kind == AstDeclaration::Kind::Input;
  symbol.declaration = writer_.declare(symbol.name, type.shape(), kind, where);
  ast_->declarations[symbol.declaration].made = inside;
  return add_symbol(frame, upper(name), symbol);
}

bool Expansion::is_within_itself(const Frame& frame) {
  for (const Frame* at = frame.parent; at != nullptr; at = at->parent) {
    if (at->pou == frame.pou) return true;
  }
  return false;
}

void Expansion::declare_all(Frame& frame, bool is_program) {
  undeclared_.push_back(&frame);
  while (!undeclared_.empty()) {
    Frame& next = *undeclared_.back();
    undeclared_.pop_back();
    for (const Variable& variable : next.pou->variables) {
      if (!step(variable.where)) return;
      declare(next, variable, is_program && &next == &frame);
    }
    if (next.pou->kind == PouKind::Function) declare_implicit(next, is_program);
  }
}

/// A function's result is a variable that has its name.
void Expansion::declare_implicit(Frame& frame, bool is_program) {
  const Variable result = {.name = frame.pou->name,
                           .role = Role::Output,
                           .type = frame.pou->result,
                           .where = frame.pou->where,
                           .type_where = frame.pou->where};
  declare(frame, result, is_program);
}

bool Expansion::is_new(const Frame& frame, const Variable& variable) {
  const std::string key = upper(variable.name);
  const auto found = frame.names.find(key);
  if (found != frame.names.end()) {
    fail("RP042", variable.where,
         quoted_excerpt(variable.name) + " is declared a second time",
         {{found->second->where, "it is declared here"}});
    return false;
  }
  if (key == "TRUE" || key == "FALSE") {
    fail("RP042", variable.where,
         quoted_excerpt(variable.name) + " is a reserved word");
    return false;
  }
  const bool hides = frame.path.empty() && &frame != globals_ &&
                     variable.role != Role::External &&
                     globals_->names.contains(key);
  if (hides) {
    fail("RP042", variable.where,
         quoted_excerpt(variable.name) +
             " hides a global variable: that is not supported");
  }
  return !hides;
}

void Expansion::declare(Frame& frame, const Variable& variable,
                        bool is_program) {
  if (!is_new(frame, variable)) return;
  if (variable.retain) {
    return fail("RP041", variable.where,
                quoted_excerpt(variable.name) +
                    " is RETAIN, which is not supported: values start anew "
                    "at power-up");
  }
  if (variable.role == Role::External) {
    return declare_external(frame, variable);
  }
  if (variable.role == Role::InOut) {
    if (!is_program) return;  // each call says what it stands for
    return fail("RP041", variable.where,
                "VAR_IN_OUT of the program itself is not supported");
  }
  const std::string type_name = upper(variable.type);
  if (const Type* const type = find_type(type_name)) {
    return declare_typed(frame, variable, *type, is_program);
  }
  // A unit of the project goes before the standard's.
  const Pou* const pou = find_pou(type_name);
  if (pou != nullptr && pou->kind == PouKind::FunctionBlock) {
    return declare_instance(frame, variable);
  }
  if (const Block* const block = find_block(type_name)) {
    return declare_block(frame, variable, *block);
  }
  Symbol symbol;
  symbol.kind = SymbolKind::Unsupported;
  symbol.type_name = variable.type;
  symbol.where = variable.where;
  add_symbol(frame, upper(variable.name), symbol);
}

void Expansion::declare_external(Frame& frame, const Variable& variable) {
  if (frame.pou != nullptr && frame.pou->kind == PouKind::Function) {
    return fail("RP041", variable.where,
                "VAR_EXTERNAL inside of a function is not supported");
  }
  const std::string key = upper(variable.name);
  const auto global = globals_->names.find(key);
  if (global != globals_->names.end()) {
    frame.names.emplace(key, global->second);
    return;
  }
  Symbol symbol;
  symbol.kind = SymbolKind::Unsupported;
  symbol.type_name = "VAR_EXTERNAL";
  symbol.where = variable.where;
  add_symbol(frame, key, symbol);
}

void Expansion::declare_typed(Frame& frame, const Variable& variable,
                              const Type& type, bool is_program) {
  std::int64_t initial = 0;
  if (!variable.initial.empty()) {
    const auto value = read_initial(variable.initial, type);
    if (!value) {
      return fail("RP043", variable.where,
                  quoted_excerpt(variable.initial) +
                      " is no initial value of type " + std::string(type.name) +
                      ": a literal of its range is expected");
    }
    initial = *value;
  }
  Role role = is_program ? variable.role : Role::Local;
  if (!is_program && variable.role == Role::Temp) role = Role::Temp;
  const std::string key = address_key(variable.address);
  if (!variable.address.empty()) {
    if (!is_program) {
      return fail("RP044", variable.where,
                  "an address inside of a function block or a function is not "
                  "supported");
    }
    if (!take_address(variable, type, role, key)) return;
  }
  if (role == Role::Input && initial != 0) {
    return fail("RP043", variable.where,
                "an input has no initial value: every scan samples it");
  }
  Symbol& symbol = add_cell(frame, variable.name, type, role, variable.where);
  symbol.role = is_program ? role : variable.role;
  symbol.value = initial;
  AstDeclaration& declaration = ast_->declarations[symbol.declaration];
  declaration.initial = initial;
  declaration.initialised = !variable.initial.empty();
  if (variable.constant) symbol.kind = SymbolKind::Constant;
  if (!key.empty()) addresses_.emplace(key, &symbol);
}

bool Expansion::check_overlap(const std::string& address, SourceRange where) {
  const char area = address[1];
  const char size = address[2];
  areas_.emplace(area, size);
  if (options_.separate_sizes) return true;
  for (const char other : {'X', 'B', 'W', 'D'}) {
    if (other == size || !areas_.contains({area, other})) continue;
    fail("RP044", where,
         "bits and words of one area may overlap: that is not supported");
    return false;
  }
  return true;
}

bool Expansion::take_address(const Variable& variable, const Type& type,
                             Role& role, const std::string& key) {
  const std::string shown = quoted_excerpt(variable.address);
  if (key.empty() || !fits_address(type, key[2])) {
    fail("RP044", variable.where,
         shown + " is no address of a " + std::string(type.name) +
             ": %IX0.0 and the like for BOOL, %IW0 for words of 16 bits, %IB0 "
             "and %ID0 for those of 8 and 32");
    return false;
  }
  if (const auto found = addresses_.find(key); found != addresses_.end()) {
    fail("RP044", variable.where, shown + " has a variable already",
         {{found->second->where, "it is declared here"}});
    return false;
  }
  const Role by_area = role_of_area(key[1]);
  const bool plain = role == Role::Local || role == Role::Global;
  if (!plain && role != by_area) {
    fail("RP044", variable.where,
         shown + " does not fit the block of variables it is in");
    return false;
  }
  role = by_area;
  return check_overlap(key, variable.where);
}

void Expansion::declare_block(Frame& frame, const Variable& variable,
                              const Block& block) {
  const bool plain =
      variable.role == Role::Local || variable.role == Role::Global;
  if (!variable.initial.empty()) {
    return fail("RP041", variable.where,
                "initial values of a function block are not supported");
  }
  if (!plain || !variable.address.empty() || variable.constant) {
    return fail("RP041", variable.type_where,
                "a function block is declared in VAR, without an address");
  }
  if (frame.pou != nullptr && frame.pou->kind == PouKind::Function) {
    return fail("RP041", variable.type_where,
                "a function block inside of a function");
  }
  const std::string_view name =
      frame.path.empty()
          ? variable.name
          : writer_.keep_text(frame.path + std::string(variable.name));
  add_block(frame, upper(variable.name), name, block, variable.where);
}

Symbol& Expansion::add_block(Frame& frame, const std::string& key,
                             std::string_view name, const Block& block,
                             SourceRange where) {
  Symbol symbol;
  symbol.kind = SymbolKind::Block;
  symbol.block = &block;
  symbol.where = where;
  symbol.name = name;
  symbol.frame = &new_frame(nullptr, std::string(name) + ".", &frame);
  symbol.element = writer_.element(
      writer_.keep_text(block.element_id(options_.dialect)), name, where);
  return add_symbol(frame, key, symbol);
}

Symbol& Expansion::hidden_block(Frame& frame, const std::string& key,
                                const Block& block, SourceRange where) {
  const auto found = frame.names.find(key);
  if (found != frame.names.end()) return *found->second;
  // Names in the text have no number of their own, so this one is free.
  const std::string_view name =
      writer_.keep_text(frame.path + std::string(block.name) + key);
  return add_block(frame, key, name, block, where);
}

void Expansion::declare_instance(Frame& frame, const Variable& variable) {
  if (!variable.initial.empty()) {
    return fail("RP041", variable.where,
                "initial values of a function block are not supported");
  }
  if (variable.role == Role::Temp || !variable.address.empty() ||
      variable.role == Role::Input || variable.role == Role::Output) {
    return fail("RP041", variable.type_where,
                "a function block is declared in VAR, without an address");
  }
  if (frame.pou != nullptr && frame.pou->kind == PouKind::Function) {
    return fail("RP041", variable.type_where,
                "a function block inside of a function");
  }
  Symbol symbol;
  symbol.kind = SymbolKind::Instance;
  symbol.where = variable.where;
  symbol.name =
      frame.path.empty()
          ? variable.name
          : writer_.keep_text(frame.path + std::string(variable.name));
  Frame& own = new_frame(find_pou(variable.type),
                         std::string(symbol.name) + ".", &frame);
  symbol.frame = &own;
  add_symbol(frame, upper(variable.name), symbol);
  if (is_within_itself(own) || own.depth > kMaxDepth) {
    return fail("RP050", variable.where,
                own.depth > kMaxDepth
                    ? "function blocks that nest more than 50 deep"
                    : quoted_excerpt(variable.type) + " contains itself");
  }
  undeclared_.push_back(&own);
}

Symbol& Expansion::pin(const Symbol& block, const Pin& pin, SourceRange where) {
  Frame& frame = *block.frame;
  const std::string key(pin.name);
  const auto found = frame.names.find(key);
  if (found != frame.names.end()) return *found->second;
  if (key == "PT") {
    Symbol preset;
    preset.kind = SymbolKind::Preset;
    preset.type = &kTime;
    preset.name = writer_.keep_text(frame.path + key);
    preset.where = where;
    return add_symbol(frame, key, preset);
  }
  const bool input = find_pin(block.block->inputs, pin.name) != nullptr;
  Symbol& cell = add_cell(frame, pin.name, *pin.type,
                          input ? Role::Input : Role::Output, where);
  return cell;
}

Symbol& Expansion::enable_pin(Frame& frame, std::string_view name,
                              SourceRange where) {
  const auto found = frame.names.find(std::string(name));
  if (found != frame.names.end()) return *found->second;
  Symbol& cell = add_cell(frame, name, kBool,
                          name == "EN" ? Role::Input : Role::Output, where);
  cell.value = 1;
  ast_->declarations[cell.declaration].initial = 1;
  return cell;
}

Symbol* Expansion::at_address(std::string_view text, SourceRange where) {
  const std::string key = address_key(text);
  if (key.empty()) {
    fail("RP044", where,
         quoted_excerpt(text) +
             " is no address that is supported: bits are %IX0.0, %QX0.0 and "
             "%MX0.0, words %IW0, %QW0 and %MW0");
    return nullptr;
  }
  if (const auto found = addresses_.find(key); found != addresses_.end()) {
    return found->second;
  }
  if (!check_overlap(key, where)) return nullptr;
  Symbol& cell = add_cell(*globals_, writer_.keep_text(key),
                          address_type(key[2]), role_of_area(key[1]), where);
  addresses_.emplace(key, &cell);
  return &cell;
}

Symbol& Expansion::add_by_use(Frame& frame, std::string_view name,
                              SourceRange where) {
  Symbol& cell = add_cell(frame, name, kBool, Role::Local, where);
  cell.by_use = true;
  return cell;
}

}  // namespace rung::iec
