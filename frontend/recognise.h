#pragma once

#include <span>
#include <string_view>

#include "base/diagnostic.h"
#include "frontend/ast.h"
#include "frontend/semantics.h"

namespace rung {

/// What the user says about how a text is to be read.
struct ReadOptions {
  std::string_view dialect;              // of scripts; empty: the text decides
  const Semantics* semantics = nullptr;  // null: the language's own default
  /// Inputs do not change in a scan, also where the preset samples each read.
  bool stable_inputs = false;
  std::string_view pou = {};  // the unit that is the program; empty: the file's
};

/// An input language: its name for --language, how its texts look, and its
/// reader.
struct Language {
  std::string_view name;  // static storage
  /// Names of semantics_presets() that fit. Where the text itself does not
  /// decide, the first is the default.
  std::span<const std::string_view> presets;
  bool (*looks_so)(std::string_view text) = nullptr;
  /// Errors go to the sink; then the result must not be used. Null: the
  /// language is known by its looks, and its texts, `plural`, are not read.
  Ast (*read)(const SourceSet& sources, FileId file, const ReadOptions& options,
              DiagnosticSink& sink) = nullptr;
  std::string_view plural = {};

  bool supported() const { return read != nullptr; }
  bool has_preset(std::string_view preset) const;
};

/// All languages, in the order in which recognise() asks them.
std::span<const Language> languages();

/// By name; null when there is none.
const Language* find_language(std::string_view name);

/// The language that a `//@ language NAME` line (`(*@` in IEC texts) names, as
/// it is written there; empty when there is no such line.
std::string_view declared_language(std::string_view text);

/// The language of a text, from its content alone; the last of languages(),
/// the script, is whatever looks like no other. Linear in the text.
const Language& recognise(std::string_view text);

}  // namespace rung
