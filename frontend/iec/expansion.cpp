#include "frontend/iec/expansion.h"

#include <algorithm>

#include "frontend/iec/scope.h"
#include "frontend/iec/token.h"

namespace rung::iec {
namespace {

constexpr std::uint64_t kMaxSteps = 250'000;
constexpr std::size_t kMaxNodes = 8'000'000;
constexpr std::size_t kMaxDepth = 50;

}  // namespace

const Pou* main_pou(const Project& project, const ExpandOptions& options,
                    ErrorLimit& errors, SourceRange nowhere) {
  const auto fail = [&](SourceRange where, const std::string& message) {
    errors.error("RP041", where, message);
    return nullptr;
  };
  const auto find = [&](std::string_view name) -> const Pou* {
    for (const Pou& pou : project.pous) {
      if (upper(pou.name) == upper(name)) return &pou;
    }
    return nullptr;
  };
  std::string names;
  std::vector<const Pou*> programs;
  for (const Pou& pou : project.pous) {
    names += (names.empty() ? "`" : ", `") + std::string(pou.name) + "`";
    if (pou.kind == PouKind::Program) programs.push_back(&pou);
  }
  if (!options.pou.empty()) {
    if (const Pou* const pou = find(options.pou)) return pou;
    return fail(nowhere, "there is no unit " + quoted_excerpt(options.pou) +
                             ": there are " + names);
  }
  if (project.instances.size() == 1) {
    const ProgramInstance& instance = project.instances.front();
    if (const Pou* const pou = find(instance.type)) return pou;
    return fail(instance.where,
                "there is no program " + quoted_excerpt(instance.type));
  }
  if (project.instances.size() > 1) {
    return fail(project.instances[1].where,
                "the configuration has " +
                    std::to_string(project.instances.size()) +
                    " programs: name one of the units " + names +
                    " as the program (--pou NAME)");
  }
  if (programs.size() == 1) return programs.front();
  if (project.pous.size() == 1) return &project.pous.front();
  if (project.pous.empty()) {
    return fail(nowhere, "there is no PROGRAM here, and no FUNCTION_BLOCK");
  }
  return fail(project.pous[1].where,
              "which of the units is the program? Name one of " + names +
                  " (--pou NAME)");
}

void expand(const Project& project, const Pou& main,
            const ExpandOptions& options, Ast& ast, ErrorLimit& errors) {
  Expansion(project, options, ast, errors).run(main);
}

Expansion::Expansion(const Project& project, const ExpandOptions& options,
                     Ast& ast, ErrorLimit& errors)
    : project_(&project),
      options_(options),
      ast_(&ast),
      errors_(&errors),
      writer_(ast) {
  for (const Pou& pou : project.pous) {
    const auto [entry, is_new] = pous_.emplace(upper(pou.name), &pou);
    if (is_new) continue;
    fail("RP042", pou.where, "there are two units " + quoted_excerpt(pou.name),
         {{entry->second->where, "it is defined here"}});
  }
}

void Expansion::run(const Pou& main) {
  globals_ = &new_frame(nullptr, {}, nullptr);
  for (const Variable& variable : project_->globals) {
    declare(*globals_, variable, true);
  }
  Frame& frame = new_frame(&main, {}, nullptr);
  declare_all(frame, true);
  if (!exhausted_) {
    if (main.kind != PouKind::Program && mentions("ENO")) {
      Expression on;
      push_leaf(on, AstOp::Bool, "true", main.where);
      set(enable_pin(frame, "ENO", main.where), on, main.where);
    }
    reset(frame, main.where);
    execute(frame, main.where);
  }
  finish();
}

void Expansion::fail(std::string_view code, SourceRange where,
                     std::string message, std::vector<Label> labels) {
  if (!said_.emplace(where.begin, message).second) return;
  errors_->error(code, where, std::move(message), std::move(labels));
}

bool Expansion::step(SourceRange where) {
  if (exhausted_) return false;
  if (++steps_ <= kMaxSteps && ast_->nodes.size() <= kMaxNodes) return true;
  exhausted_ = true;
  fail("RP050", where,
       "the program is too large when function blocks, functions and loops "
       "are put in where they are called");
  return false;
}

const Pou* Expansion::find_pou(std::string_view name) const {
  const auto found = pous_.find(upper(name));
  return found == pous_.end() ? nullptr : found->second;
}

Frame& Expansion::new_frame(const Pou* pou, std::string path,
                            const Frame* parent) {
  frames_.push_back({pou,
                     std::move(path),
                     parent,
                     parent == nullptr ? 0 : parent->depth + 1,
                     {},
                     {}});
  return frames_.back();
}

Frame& Expansion::function_frame(const Pou& pou, SourceRange where) {
  Frame& frame = new_frame(
      &pou, std::string(pou.name) + "." + std::to_string(++calls_) + ".",
      nullptr);
  declare_all(frame, false);
  reset(frame, where);
  return frame;
}

void Expansion::restore(const Context& context) {
  writer_.set_guard(context.guard);
  level_ = context.level;
  while (!known_.empty() && known_.back().second > level_) {
    known_.back().first->known.reset();
    known_.back().first->known_level = 0;
    known_.pop_back();
  }
}

void Expansion::set_known(Symbol& symbol, std::optional<std::int64_t> value) {
  symbol.known = value;
  if (level_ <= symbol.known_level) return;
  // Behind a condition: it is forgotten where that ends.
  symbol.known_level = level_;
  known_.emplace_back(&symbol, level_);
}

std::int64_t Expansion::assume_unwritten(Symbol& symbol, SourceRange where) {
  assumed_.emplace_back(&symbol, where);
  return symbol.value;
}

bool Expansion::execute(Frame& frame, SourceRange where) {
  const Pou& pou = *frame.pou;
  if (!step(where) || failed_.contains(&pou)) return false;
  if (std::find(active_.begin(), active_.end(), &pou) != active_.end()) {
    fail("RP050", where, quoted_excerpt(pou.name) + " calls itself");
    return false;
  }
  if (active_.size() >= kMaxDepth) {
    fail("RP050", where, "calls that nest more than 50 deep");
    return false;
  }
  const Context outer = context();
  const std::size_t said = said_.size();
  active_.push_back(&pou);
  Scope scope(*this, frame);
  pou.body(scope);
  active_.pop_back();
  restore(outer);
  if (said_.size() != said) failed_.insert(&pou);
  return true;
}

void Expansion::set(Symbol& cell, const Expression& value, SourceRange where) {
  const std::string_view guard = writer_.guard();
  writer_.set_guard({});
  writer_.assign(cell.name, cell.type->kind != Kind::Bool, where, value, where);
  writer_.set_guard(guard);
}

void Expansion::reset(Frame& frame, SourceRange where) {
  for (Symbol* const symbol : frame.order) {
    const bool anew = frame.pou->kind == PouKind::Function
                          ? !symbol->sampled
                          : symbol->role == Role::Temp;
    if (!anew || symbol->kind != Symbol::Kind::Cell) continue;
    if (symbol->role == Role::Global) continue;
    Expression value;
    const bool bit = symbol->type->kind == Kind::Bool;
    const std::string_view text =
        bit ? (symbol->value != 0 ? "true" : "false")
            : writer_.keep_text(std::to_string(symbol->value));
    push_leaf(value, bit ? AstOp::Bool : AstOp::Number, text, where);
    set(*symbol, value, where);
    symbol->written = true;
    set_known(*symbol, symbol->value);
  }
}

void Expansion::finish() {
  for (const auto& [symbol, where] : assumed_) {
    if (!symbol->written) continue;
    fail("RP045", where,
         "PT must be constant, and " + quoted_excerpt(symbol->name) +
             " is written elsewhere");
  }
  for (const Symbol& symbol : symbols_) {
    if (!symbol.by_use) continue;
    ast_->declarations[symbol.declaration].kind =
        symbol.written ? AstDeclaration::Kind::Output
                       : AstDeclaration::Kind::Input;
  }
}

}  // namespace rung::iec
