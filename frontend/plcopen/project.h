#pragma once

#include <string_view>

#include "frontend/ast.h"
#include "frontend/iec/project.h"
#include "frontend/plcopen/xml.h"
#include "frontend/semantics.h"

namespace rung::plcopen {

/// The units, variables and programs of a file, ready to be expanded. Texts
/// that are made go to Ast::made_names.
/// Errors: RP094 for what is not supported, by name; RP095 for what is missing;
///         those of the bodies.
iec::Project read_project(const Xml& xml, const Semantics& semantics, Ast& ast);

/// Property lines and comments: of XML, and those that are drawn.
void read_comments(const Xml& xml, Ast& ast);

}  // namespace rung::plcopen
