#pragma once

// What every reader owes: errors with a code, words and a place in the file,
// and a program of the shape that everything behind relies on.

#include <cstddef>
#include <cstdint>
#include <string>

#include "analysis/program.h"
#include "frontend/recognise.h"

inline void check(bool holds) {
  if (!holds) __builtin_trap();
}

inline void check_diagnostics(const rung::SourceSet& sources,
                              const rung::DiagnosticList& list) {
  for (const rung::Diagnostic& item : list.items()) {
    check(item.code.size() == 5 && item.code.substr(0, 3) == "RP0");
    check(!item.message.empty());
    check(item.where.has_value() && item.where.begin <= item.where.end);
    check(item.where.end <= sources[item.where.file].text().size());
  }
}

/// The shape that everything behind relies on; see analysis/program.h.
inline void check_program(const rung::Program& program) {
  for (const rung::Rung& rung : program.rungs) {
    check(rung.begin < rung.end && rung.end <= program.nodes.size());
    check(program.nodes[rung.root()].type == program.cells[rung.target].type);
    check(program.nodes[rung.root()].op != rung::NodeOp::Branch);
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      const rung::Node& node = program.nodes[i];
      if (node.op == rung::NodeOp::Branch) {
        check(node.target > i && node.target < rung.end);
        check(program.nodes[node.target].a == node.a);
      } else if (node.op == rung::NodeOp::Read) {
        check(program.cells[node.cell].type == node.type);
      }
      check(node.a < i || (i == 0 && node.a == 0));
      check(node.b < i || (i == 0 && node.b == 0));
    }
  }
  for (const rung::Cell& cell : program.cells) {
    check(cell.low <= cell.initial && cell.initial <= cell.high);
  }
}

/// A reader of a language that declares its cells, and the builder behind it:
/// what the reader accepts the builder accepts.
inline void check_declared_reader(decltype(rung::Language::read) read,
                                  const std::uint8_t* data, std::size_t size) {
  rung::SourceSet sources;
  const rung::FileId file = sources.add("fuzz", std::string(data, data + size));
  rung::recognise(sources[file].text());
  rung::DiagnosticList list;
  const rung::Ast ast = read(sources, file, {}, list);
  check_diagnostics(sources, list);
  if (list.has_errors()) return;
  const rung::Program program = rung::build_program(ast, {}, list);
  check(!list.has_errors());
  check(program.rungs.size() == ast.rungs.size());
  check_program(program);
}
