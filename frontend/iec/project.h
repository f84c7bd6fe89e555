#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/ast.h"
#include "frontend/error_limit.h"

namespace rung::iec {

class Scope;

/// What a project in the languages of IEC 61131-3 consists of, whatever they
/// are. Names and texts are views that must outlive the Ast.

enum class Role : std::uint8_t {
  Input,
  Output,
  InOut,
  External,
  Global,
  Local,
  Temp,
};

struct Variable {
  std::string_view name;
  Role role = Role::Local;
  bool constant = false;
  bool retain = false;
  /// A type's or a function block's name. Of a type that is not named (ARRAY,
  /// STRING(20)) any text: such a variable may stand, but not be used.
  std::string_view type;
  std::string_view initial = {};  // a literal as it is written; empty: none
  std::string_view address = {};  // %IX0.0
  SourceRange where;
  SourceRange type_where;
};

enum class PouKind : std::uint8_t { Program, FunctionBlock, Function };

/// A program organisation unit. Its body writes statements; it is called once
/// for each call of the unit, so it must give the same each time. It is not
/// called for a unit that nothing executes.
struct Pou {
  PouKind kind = PouKind::Program;
  std::string_view name;
  std::string_view result = {};  // the type of a function's result
  std::vector<Variable> variables;
  std::function<void(Scope&)> body;
  /// Names that are not declared are bits: their use says whether they are
  /// inputs (an instruction list alone).
  bool by_use = false;
  SourceRange where;
};

/// `PROGRAM instance0 WITH task0 : type`, as a configuration has it.
struct ProgramInstance {
  std::string_view name;
  std::string_view type;
  std::optional<std::int64_t> interval_ms = {};  // of its task
  SourceRange where = {};
};

struct Project {
  std::deque<Pou> pous;
  std::vector<Variable> globals;
  std::vector<ProgramInstance> instances;
  /// Every name of a block's pin that the texts mention, in capitals: other
  /// outputs than the first have no cell unless they are among them, and EN
  /// and ENO mean nothing.
  std::set<std::string, std::less<>> mentioned;
};

struct ExpandOptions {
  std::string_view dialect = "iec";  // of the elements
  /// Bits, bytes and words of one area are memories of their own (OpenPLC);
  /// else they may overlap, and a text that mixes them is refused.
  bool separate_sizes = false;
  std::string_view pou = {};  // the program, where it is to be another one
};

/// The program: the one that the configuration instantiates, else the only
/// PROGRAM, else the only unit. Null with an error when that is not one.
const Pou* main_pou(const Project& project, const ExpandOptions& options,
                    ErrorLimit& errors, SourceRange nowhere);

/// Writes the program `main` into `ast`: its cells, its elements, and its
/// statements, with every function block and function put in where it is
/// called. A block's variables are cells `instance.variable`. What grows out
/// of all measure that way, and what calls itself, is an error (RP050).
void expand(const Project& project, const Pou& main,
            const ExpandOptions& options, Ast& ast, ErrorLimit& errors);

}  // namespace rung::iec
