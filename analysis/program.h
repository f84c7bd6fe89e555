#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/element.h"
#include "base/diagnostic.h"
#include "base/id.h"
#include "frontend/ast.h"

namespace rung {

using CellId = Id<struct CellTag>;
using InstanceId = Id<struct InstanceTag>;
using CallId = Id<struct CallTag>;
using RungId = Id<struct RungTag>;

enum class Type : std::uint8_t { Bit, Word };

enum class CellRole : std::uint8_t {
  Input,   // sampled once before the first rung of a scan; no rung writes it
  Output,  // written by a rung, visible outside
  Memory,  // written by a rung, internal
};

/// A named value. Bits hold 0 or 1.
///
/// Invariant: low <= initial <= high. For words written by rungs the range is
/// that of the type; a value outside it is a fault (see NodeOp::Wrap16).
struct Cell {
  std::string name;
  Type type = Type::Bit;
  CellRole role = CellRole::Memory;
  std::int64_t initial = 0;  // before the first scan
  std::int64_t low = 0;
  std::int64_t high = 1;
  SourceRange where;           // first mention
  bool plant_written = false;  // an input that the `//Sim` plant assigns
  bool initialised = false;    // the text says its initial value (`//Var`)
  bool declared = false;       // by an `//@ input` or `//@ output` line
  bool made = false;           // by the reader: the text does not name it
};

/// Operators of a rung's expression. Bit operators take and give bits, word
/// operators words; ToWord and ToBit convert.
enum class NodeOp : std::uint8_t {
  Constant,  // value
  Read,      // cell
  Not,
  And,
  Or,
  Xor,
  Equal,  // two words give a bit, as the next five
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Add,  // exact in the integers, as the next four
  Subtract,
  Multiply,
  Divide,  // truncates towards zero; the divisor is a non-zero constant
  Negate,
  Wrap16,  // a word to a 16-bit signed integer, two's complement
  Wrap,    // the same to `value` bits, signed where `value` is negative
  ToWord,  // bit to 0 or 1
  ToBit,   // word != 0
  Call,    // an element operation: Program::calls[call]
  Branch,  // short-circuit: see below
};

/// One node of a rung's expression, in postorder: operands stand before it.
///
/// Branch is a marker without a value. Invariant: its `a` is the left operand
/// of the And or Or at `target` (an index into Program::nodes), so it equals
/// that node's `a`, and the marker stands right after it. When the value of `a`
/// is `skip_when`, the nodes between the marker and `target` are not executed
/// and the And/Or has the value of `a`. Readers emit it for short-circuit
/// languages, and only where the right operand has an element call: no run can
/// tell else.
struct Node {
  NodeOp op = NodeOp::Constant;
  Type type = Type::Bit;
  bool skip_when = false;    // Branch
  std::uint32_t a = 0;       // operands: indices into Program::nodes
  std::uint32_t b = 0;       //
  std::uint32_t target = 0;  // Branch
  std::int64_t value = 0;    // Constant; Wrap: 8, 16, 32 or their negatives
  CellId cell;               // Read
  CallId call;               // Call
  SourceRange where;
};

/// One timer, counter or edge memory: a state of an element kind at an index.
/// All calls with the same kind and index share it.
struct Instance {
  const ElementKind* kind = nullptr;
  std::int64_t index = 0;
  std::string name;  // "T(0)"
  /// Elapsed times saturate at this many ms: above every preset of the
  /// instance and every constant that a property compares them with.
  std::int64_t clock_cap = 1;
  /// The largest preset (ms) or count of the instance's calls.
  std::int64_t largest_parameter = 0;
  SourceRange where;  // first call
};

/// One call of an element operation in a rung.
struct ElementCall {
  InstanceId instance;
  const ElementOperation* operation = nullptr;
  /// A time operand (ms) or a count operand, as an integer that makes the
  /// operation's own comparison exact; 0 when the operation has neither.
  std::int64_t parameter = 0;
  std::vector<std::uint32_t> arguments;  // bit operands, indices of nodes
  SourceRange where;
};

/// target = value. Nodes [begin, end) are the expression in execution order;
/// the last one is its value and has the type of the target.
struct Rung {
  CellId target;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  SourceRange target_where;
  SourceRange where;
  std::uint32_t root() const { return end - 1; }
};

/// The plant as the reader saw it: names resolved, doubles, run by the
/// simulator once a scan after the rungs. Its expressions are AstNodes.
struct PlantStatement {
  AstPlantStatement::Kind kind = AstPlantStatement::Kind::Assign;
  std::string target;  // a cell's name or a plant variable
  AstExpression value;
};
struct Plant {
  std::vector<AstNode> nodes;
  std::vector<PlantStatement> statements;
  std::vector<PlantStatement> initials;  // `//Var` values of plant variables
};

struct ScanInterval {
  std::int64_t min_ms = 1;
  std::int64_t max_ms = 100;
};

/// A program: rungs in scan order over typed cells. Built by build_program();
/// immutable afterwards, but for Instance::clock_cap.
struct Program {
  FileId file;
  std::string_view language;
  std::string_view dialect;
  Evaluation evaluation = Evaluation::Strict;
  ScanInterval scan;
  Arena<CellId, Cell> cells;
  Arena<InstanceId, Instance> instances;
  Arena<CallId, ElementCall> calls;
  std::vector<Node> nodes;
  Arena<RungId, Rung> rungs;
  Plant plant;
  std::vector<AstAnnotation> annotations;
  /// What annotations and comments point into, where that is not the file.
  std::vector<std::shared_ptr<const std::string>> texts;
  std::vector<AstComment> comments;
};

/// Looks a cell up by name; no value when there is none. Linear: build a map
/// for many look-ups.
CellId find_cell(const Program& program, std::string_view name);

struct BuildOptions {
  ScanInterval scan;
};

/// Resolves names, infers types, inputs and outputs, and checks element calls,
/// as the dialect of `ast` says (its `dialect` is set).
///
/// Errors: everything wrong in the file goes to `sink` (codes RP0xx), in one
///         run; when it has errors the result must not be used for a verdict.
/// Limits: linear in the size of `ast`.
Program build_program(const Ast& ast, const BuildOptions& options,
                      DiagnosticSink& sink);

}  // namespace rung
