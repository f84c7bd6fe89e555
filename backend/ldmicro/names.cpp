#include "backend/ldmicro/names.h"

#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace rung::backend::ldmicro {
namespace {

/// The letters of bits, timers, counters, and of pins for numbers.
constexpr std::string_view kTaken = "XYRTCAPIMHQ";

std::string with_letter(char letter, const std::string& name) {
  return name[0] == letter ? name : letter + name;
}

std::string wanted(const Variable& variable) {
  if (variable.type == Type::Word) {
    const bool plain = kTaken.find(variable.name[0]) == kTaken.npos;
    return plain ? variable.name : "N" + variable.name;
  }
  switch (variable.role) {
    case CellRole::Input:
      return with_letter('X', variable.name);
    case CellRole::Output:
      return with_letter('Y', variable.name);
    case CellRole::Memory:
      break;
  }
  return with_letter('R', variable.name);
}

}  // namespace

const NameRules& name_rules() {
  static constexpr NameRules kRules = {
      .ignores_case = false, .plain_underscores = true, .longest = 40};
  return kRules;
}

void assign_names(Unit& unit) {
  NameTable names(name_rules());
  std::unordered_map<std::string, std::string> now;
  const auto rename = [&](std::string& name, const std::string& to) {
    std::string before = std::exchange(name, names.add(to));
    now.emplace(std::move(before), name);
  };
  // Those of the source keep theirs, if they can.
  for (const bool made : {false, true}) {
    for (const CellId id : ids_of(unit.variables)) {
      Variable& variable = unit.variables[id];
      if (variable.source.empty() != made) continue;
      rename(variable.name, wanted(variable));
    }
  }
  for (const BlockId id : ids_of(unit.blocks)) {
    Block& block = unit.blocks[id];
    rename(block.name,
           with_letter(block.type == "CTU" ? 'C' : 'T', block.name));
  }
  for (StateRelation& relation : unit.relations) {
    for (StateRelation::Name& name : relation.names) {
      const auto found = now.find(name.state);
      if (name.second && found != now.end()) name.state = found->second;
    }
  }
  unit.names = std::move(names);
}

}  // namespace rung::backend::ldmicro
