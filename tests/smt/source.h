#pragma once

#include <gtest/gtest.h>

#include <string>

#include "analysis/property.h"
#include "frontend/script/reader.h"

namespace rung {

/// A script without errors, and its properties.
struct Source {
  SourceSet sources;
  Program program;
  PropertySet properties;

  explicit Source(const std::string& text) {
    DiagnosticList sink;
    const FileId file = sources.add("test.rung", text);
    program = build_program(read_script(sources, file, "", sink), {}, sink);
    properties = read_properties(program, {}, sources, sink);
    for (const Diagnostic& d : sink.items()) {
      EXPECT_NE(d.severity, Severity::Error) << d.message;
    }
  }
};

}  // namespace rung
