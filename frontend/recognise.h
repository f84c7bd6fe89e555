#pragma once

#include <span>
#include <string_view>

namespace rung {

/// An input language: its name for --language, and how its texts look.
struct Language {
  std::string_view name;  // static storage
  bool supported = false;
  bool (*looks_so)(std::string_view text) = nullptr;
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
