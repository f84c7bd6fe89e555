#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/error_limit.h"
#include "frontend/iec/blocks.h"
#include "frontend/iec/project.h"
#include "frontend/iec/types.h"
#include "frontend/statements.h"

namespace rung::iec {

struct Frame;

/// What a name stands for at one place of the expanded program.
struct Symbol {
  enum class Kind : std::uint8_t {
    Cell,
    Constant,
    Preset,       // PT of a standard block: no cell, its value must be known
    Block,        // an instance of a standard block
    Instance,     // an instance of a function block of the project
    Unsupported,  // a variable of a type that is not supported
  };
  Kind kind = Kind::Cell;
  std::string_view name;  // the cell's, or the path of an instance
  const Type* type = &kBool;
  Role role = Role::Local;
  std::string_view type_name = {};  // of Unsupported
  const Block* block = nullptr;
  std::uint32_t element = 0;      // index of a Block's element
  const Frame* owner = nullptr;   // where it is declared
  Frame* frame = nullptr;         // the names of a Block or an Instance
  std::int64_t value = 0;         // of Constant; a cell's initial one
  std::uint32_t declaration = 0;  // of Cell, in Ast::declarations
  bool sampled = false;           // an input of the program
  bool by_use = false;
  bool written = false;
  bool locked = false;             // the control variable of a FOR
  bool called_without_en = false;  // Block, Instance
  /// The value that statements above have left, where that is a constant.
  std::optional<std::int64_t> known;
  std::uint32_t known_level = 0;
  SourceRange where;
};

/// The names of one program, instance, or call of a function.
struct Frame {
  const Pou* pou = nullptr;       // null: a standard block
  std::string path;               // `inst.`, empty for the program itself
  const Frame* parent = nullptr;  // of an instance: where it is declared
  std::uint32_t depth = 0;
  std::unordered_map<std::string, Symbol*> names;  // in capitals
  std::vector<Symbol*> order;
};

/// Where statements have an effect.
struct Context {
  std::string_view guard;
  std::uint32_t level = 0;
  std::string_view gone = {};  // where a RETURN was executed (Scope)
};

/// The state of an expansion: what all its scopes share.
class Expansion {
 public:
  Expansion(const Project& project, const ExpandOptions& options, Ast& ast,
            ErrorLimit& errors);

  void run(const Pou& main);

  // --- for Scope -------------------------------------------------------------

  StatementWriter& writer() { return writer_; }
  ErrorLimit& errors() { return *errors_; }
  const Project& project() const { return *project_; }

  /// Says an error once, however often its place is expanded.
  void fail(std::string_view code, SourceRange where, std::string message,
            std::vector<Label> labels = {});
  bool has_failed() const { return !said_.empty(); }
  /// Counts a statement, a call or a pass; false: there were too many.
  bool step(SourceRange where);

  const Pou* find_pou(std::string_view name) const;
  bool mentions(std::string_view pin) const {
    return project_->mentioned.contains(pin);
  }

  /// Outputs but the first have a cell only where the texts mention them.
  bool has_cell(const Block& block, const Pin& pin) const {
    return find_pin(block.outputs.subspan(1), pin.name) == nullptr ||
           mentions(pin.name);
  }

  Frame& new_frame(const Pou* pou, std::string path, const Frame* parent);
  /// Of a call of a function, which has variables of its own each time.
  Frame& function_frame(const Pou& pou, SourceRange where);
  /// Declares the variables of a frame, and those of the instances in it.
  void declare_all(Frame& frame, bool is_program);
  Symbol& add_cell(Frame& frame, std::string_view name, const Type& type,
                   Role role, SourceRange where);
  /// The cell of a standard block's pin; made where it is new.
  Symbol& pin(const Symbol& block, const Pin& pin, SourceRange where);
  /// EN or ENO of an instance: a bit that is true at first.
  Symbol& enable_pin(Frame& frame, std::string_view name, SourceRange where);
  /// A block that no variable stands for; made where it is new.
  Symbol& hidden_block(Frame& frame, const std::string& key, const Block& block,
                       SourceRange where);
  /// An address that is used without a declaration; null: it is refused.
  Symbol* at_address(std::string_view text, SourceRange where);
  /// Of a list whose names are bits by their use.
  Symbol& add_by_use(Frame& frame, std::string_view name, SourceRange where);

  Context context() const { return {writer_.guard(), level_, {}}; }
  void enter(std::string_view bit) { writer_.set_guard(bit), ++level_; }
  void restore(const Context& context);
  void set_known(Symbol& symbol, std::optional<std::int64_t> value);
  /// The initial value of a cell that nothing may write: finish() checks it.
  std::int64_t assume_unwritten(Symbol& symbol, SourceRange where);

  /// Runs a body in its own context; false where it calls itself.
  bool execute(Frame& frame, SourceRange where);
  /// What starts anew in each execution gets its initial value.
  void reset(Frame& frame, SourceRange where);
  /// The assignment of a cell that only this execution sees.
  void set(Symbol& cell, const Expression& value, SourceRange where);

 private:
  void declare(Frame& frame, const Variable& variable, bool is_program);
  void declare_typed(Frame& frame, const Variable& variable, const Type& type,
                     bool is_program);
  void declare_instance(Frame& frame, const Variable& variable);
  void declare_block(Frame& frame, const Variable& variable,
                     const Block& block);
  Symbol& add_block(Frame& frame, const std::string& key, std::string_view name,
                    const Block& block, SourceRange where);
  void declare_external(Frame& frame, const Variable& variable);
  void declare_implicit(Frame& frame, bool is_program);
  bool is_new(const Frame& frame, const Variable& variable);
  bool take_address(const Variable& variable, const Type& type, Role& role,
                    const std::string& key);
  bool check_overlap(const std::string& address, SourceRange where);
  Symbol& add_symbol(Frame& frame, const std::string& key, Symbol symbol);
  void finish();
  static bool is_within_itself(const Frame& frame);

  const Project* project_;
  ExpandOptions options_;
  Ast* ast_;
  ErrorLimit* errors_;
  StatementWriter writer_;
  std::unordered_map<std::string, const Pou*> pous_;
  std::deque<Frame> frames_;
  std::deque<Symbol> symbols_;
  Frame* globals_ = nullptr;
  std::vector<Frame*> undeclared_;  // instances whose variables are to come
  std::unordered_map<std::string, Symbol*> addresses_;
  std::set<std::pair<char, char>> areas_;  // of the addresses: I and X
  std::vector<const Pou*> active_;
  std::set<const Pou*> failed_;
  std::uint32_t calls_ = 0;
  std::set<std::pair<std::uint32_t, std::string>> said_;
  std::vector<std::pair<Symbol*, std::uint32_t>> known_;  // by level
  std::uint32_t level_ = 0;
  std::vector<std::pair<Symbol*, SourceRange>> assumed_;
  std::uint64_t steps_ = 0;
  bool exhausted_ = false;
};

}  // namespace rung::iec
