#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/error_limit.h"
#include "frontend/token_list.h"

namespace rung::stl {

/// Text without blanks and in capitals, and where it stands.
struct Operand {
  std::string text;
  SourceRange where;
};

/// `label: OPERATOR operand, operand`.
struct Statement {
  std::string label;  // empty: none
  std::string name;   // the operator, in capitals; empty: a label alone
  std::vector<Operand> operands;
  SourceRange where;
};

enum class BlockKind : std::uint8_t { Organization, Function };

struct Block {
  BlockKind kind = BlockKind::Organization;
  std::uint32_t number = 1;
  SourceRange where;
  std::vector<Statement> body;
};

/// A text: its blocks, or a list without any, which is OB 1.
struct Source {
  std::vector<Block> blocks;
  std::vector<AstComment> comments;
  std::vector<AstAnnotation> annotations;
};

/// Splits a text into blocks and statements. Statements end at `;` or at the
/// line's end, comments begin with `//`; those with `@` behind it are property
/// lines. Titles, versions and the declarations of VAR_TEMP have no meaning.
/// Errors: blocks of other kinds, parameters: RP041. Linear.
Source split(std::string_view text, FileId file, ErrorLimit& errors);

/// In capitals, without blanks.
std::string squeezed(std::string_view text);

}  // namespace rung::stl
