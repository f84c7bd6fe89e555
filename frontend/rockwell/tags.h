#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/rockwell/project.h"
#include "frontend/statements.h"

namespace rung::rockwell {

/// What an operand names.
struct Place {
  enum class Kind : std::uint8_t { None, Bit, Word, Timer, Counter };
  Kind kind = Kind::None;
  std::string_view name;     // as it is written; the cell's name
  std::uint32_t bits = 0;    // of a word
  std::string_view word;     // of a bit in a word: the word
  std::uint32_t bit = 0;     //
  const Tag* tag = nullptr;  // null where nothing is declared
  std::string_view path;     // below the tag
  std::string_view block;    // of a member: the timer or counter
};

/// Tags and their members, by what rungs do with them.
///
/// A tag that no rung writes and that is no constant is an input; where the
/// file itself names the inputs (l5x2c), only those are. A bit that a rung
/// writes is an output if it is a tag of its own.
///
/// The bits of an integer (`Word.3`, BIT members of a structure) are cells of
/// their own; where the integer is used, too, it is those bits.
class Tags {
 public:
  /// `declared`: every tag is; else use says what a name is.
  Tags(const Project& project, bool declared, Ast& ast, StatementWriter& out,
       ErrorLimit& errors)
      : project_(project),
        declared_(declared),
        ast_(ast),
        out_(out),
        errors_(errors) {
    note_properties();
  }

  /// Notes what an instruction does; for all of them, then declare().
  /// Errors: RP052, RP053, RP054, RP087 for operands.
  void survey(const Instruction& it);
  void declare();

  // --- after declare(), for operands without errors ---

  Place place(const Operand& operand, Place::Kind wanted);
  /// A timer or a counter that an instruction works on; else Kind::None.
  Place::Kind block_kind(std::string_view name) const;
  /// A number or an integer, as an expression.
  Expression word(const Operand& operand);
  /// The cells of a word whose bits are cells, the lowest first; else none.
  std::vector<std::string_view> bits_of(const Place& word) const;
  /// The cell `block.DN`; empty when nothing looks at it.
  std::string_view member(std::string_view block, std::string_view name) const;
  /// PRE of a timer or counter: its operand, or what its tag holds.
  std::int64_t preset(const Instruction& it);

 private:
  struct Use {
    Place place;
    SourceRange where;
    SourceRange write;     // where it is written
    bool cleared = false;  // by the prescan
    bool set = false;
  };

  Place fail(const Operand& operand, std::string_view code,
             const std::string& why) const;
  Place resolve(const Operand& operand, Place::Kind wanted) const;
  Place declared_place(const Operand& operand) const;
  Place undeclared_place(const Operand& operand, Place::Kind wanted) const;
  bool step(const Operand& operand, std::size_t& at, std::string_view& type,
            Place& place) const;
  bool member_step(const Operand& operand, std::string_view name,
                   std::size_t begin, std::string_view& type,
                   Place& place) const;
  Place of_type(const Operand& operand, std::string_view type,
                Place place) const;

  Use* note(const Operand& operand, Place::Kind wanted, bool write);
  void note_word(const Operand& operand);
  void note_block(const Instruction& it, Place::Kind kind);
  void note_properties();
  void need(const Place& block, std::string_view member, Place::Kind kind,
            SourceRange where);
  void declare_use(Use& use);
  void split_words();
  AstDeclaration::Kind role_of(const Use& use) const;
  std::int64_t initial_of(const Use& use) const;

  const Project& project_;
  bool declared_;
  Ast& ast_;
  StatementWriter& out_;
  ErrorLimit& errors_;
  std::map<std::string_view, Use> uses_;  // by the cell's name
  std::vector<std::string_view> order_;
  std::set<std::string_view> blocks_;  // timers and counters, by name
  std::set<std::string, std::less<>> mentioned_;  // in property lines
  std::map<std::string_view, std::map<std::uint32_t, std::string_view>> split_;
};

}  // namespace rung::rockwell
