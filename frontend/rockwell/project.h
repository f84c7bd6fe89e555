#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/plcopen/xml.h"
#include "frontend/rockwell/rung_text.h"

namespace rung::rockwell {

using plcopen::Text;

struct Member {
  std::string_view type;
  std::string_view target;  // of a BIT: the integer that it is a bit of
  std::uint32_t bit = 0;
};
using DataType = std::map<std::string_view, Member>;

struct Tag {
  std::string_view name;
  SourceRange where;
  std::string_view type;
  std::string_view dimensions;
  std::string_view alias;
  bool constant = false;
  pugi::xml_node node;  // its values
};

struct Routine {
  std::string_view name;
  SourceRange where;
  std::string_view type;  // RLL and others
  RungTexts texts;
  std::map<std::string_view, std::uint32_t> labels;  // by name: the rung
};

/// What an L5X file says, with one program.
struct Project {
  std::map<std::string_view, DataType> types;
  std::map<std::string_view, Tag> tags;  // those of the program hide others
  std::vector<Routine> routines;
  std::size_t main = 0;
  // Annotations of l5x2c in the comments of rungs.
  std::map<std::string_view, SourceRange> inputs;
  bool names_inputs = false;
};

/// Errors: RP051, RP052, RP054, RP087, RP088, RP089, RP093. Linear.
std::optional<Project> read_project(const plcopen::Xml& xml, Ast& ast,
                                    ErrorLimit& errors);

/// Collects the labels of a routine and what it calls.
void finish_routine(Routine& routine, ErrorLimit& errors);

/// The value of a leaf of a tag: its path below the tag, as in `.Faults[2].A`.
/// No value: it is not there.
std::optional<std::int64_t> value_of(const Tag& tag, std::string_view path);

/// 12, -3, 16#ff, 2#0101, 8#17
std::optional<std::int64_t> number_of(std::string_view text);

}  // namespace rung::rockwell
