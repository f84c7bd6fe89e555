#pragma once

#include <string>
#include <string_view>

#include "analysis/program.h"
#include "frontend/recognise.h"

namespace rung::test {

/// A text of a language that declares its cells, read and built.
struct DeclaredText {
  DeclaredText(std::string_view language, std::string text,
               const ReadOptions& options = {});

  /// "q=(&& a b) | m=...": assignments in scan order.
  std::string rungs() const;
  /// "RP050 3:1 the message": one line each.
  std::string problems() const;
  /// Scans with inputs as given; the value of a cell afterwards.
  std::string run(std::string_view stimulus, std::string_view watch) const;

  SourceSet sources;
  DiagnosticList list;
  FileId file;
  Ast ast;
  Program program;
};

}  // namespace rung::test
