#include "backend/plcopen/write.h"

#include <algorithm>
#include <array>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "backend/plcopen/page.h"
#include "backend/plcopen/rungs.h"
#include "backend/plcopen/sheet.h"
#include "backend/unit/builder.h"
#include "backend/unit/comments.h"
#include "backend/unit/elements_iec.h"
#include "backend/unit/iec_text.h"
#include "backend/unit/lower_iec.h"

namespace rung {
namespace backend {
namespace {

using pugi::xml_node;

/// A scan of the editors' own new projects.
constexpr std::int64_t kUsualScan = 20;

xml_node add(
    xml_node parent, const char* name,
    const std::vector<std::pair<const char*, std::string>>& attributes = {}) {
  xml_node node = parent.append_child(name);
  for (const auto& [attribute, value] : attributes) {
    node.append_attribute(attribute) = value.c_str();
  }
  return node;
}

/// A comment that would be read as a property line, or be no XML.
std::string harmless(std::string line) {
  if (line.starts_with("//@") || line.starts_with("(*@")) line.insert(2, " ");
  for (const char* const no_character : {"\xef\xbf\xbe", "\xef\xbf\xbf"}) {
    for (std::size_t at; (at = line.find(no_character)) != std::string::npos;) {
      line.replace(at, 3, "?");
    }
  }
  return line;
}

void add_headers(xml_node project, const std::string& name) {
  // Nothing that changes from one writing to the next.
  const std::string time = "2000-01-01T00:00:00";
  add(project, "fileHeader",
      {{"companyName", "Unknown"},
       {"productName", name},
       {"productVersion", "1"},
       {"creationDateTime", time}});
  xml_node header = add(project, "contentHeader",
                        {{"name", name}, {"modificationDateTime", time}});
  xml_node info = add(header, "coordinateInfo");
  for (const char* const language : {"fbd", "ld", "sfc"}) {
    add(add(info, language), "scaling", {{"x", "10"}, {"y", "10"}});
  }
}

void add_variable(xml_node section, const std::string& name,
                  const std::string& source, bool derived,
                  const std::string& type, std::int64_t initial) {
  xml_node node = add(section, "variable", {{"name", name}});
  if (derived) {
    add(add(node, "type"), "derived", {{"name", type}});
  } else {
    add(add(node, "type"), type.c_str());
  }
  if (initial != 0) {
    const std::string value = type == "BOOL" ? "TRUE" : std::to_string(initial);
    add(add(node, "initialValue"), "simpleValue", {{"value", value}});
  }
  const bool renamed = !source.empty() && source != name;
  if (renamed) plcopen::put_note(node, "documentation", source);
}

void add_interface(xml_node pou, const Unit& unit) {
  xml_node interface = add(pou, "interface");
  constexpr std::array<std::pair<CellRole, const char*>, 3> kSections = {
      {{CellRole::Input, "inputVars"},
       {CellRole::Output, "outputVars"},
       {CellRole::Memory, "localVars"}}};
  for (const auto& [role, name] : kSections) {
    xml_node section = add(interface, name);
    for (const Variable& variable : unit.variables) {
      if (variable.role != role || variable.block.has_value()) continue;
      add_variable(section, variable.name, variable.source, false,
                   variable.type == Type::Bit ? "BOOL" : "INT",
                   variable.initial);
    }
    for (const Block& block : unit.blocks) {
      if (role != CellRole::Memory) break;
      add_variable(section, block.name, block.source, true,
                   std::string(block.type), 0);
    }
    if (!section.first_child()) interface.remove_child(section);
  }
}

void add_instances(xml_node project, const std::string& pou,
                   const Program& program) {
  const std::int64_t scan = std::clamp<std::int64_t>(
      kUsualScan, program.scan.min_ms, program.scan.max_ms);
  xml_node configurations = add(add(project, "instances"), "configurations");
  xml_node resource =
      add(add(configurations, "configuration", {{"name", "Config0"}}),
          "resource", {{"name", "Res0"}});
  xml_node task =
      add(resource, "task",
          {{"name", "task0"}, {"priority", "0"}, {"interval", iec_time(scan)}});
  add(task, "pouInstance", {{"name", "instance0"}, {"typeName", pou}});
}

std::string write_project(const Program& program, const Unit& unit,
                          const std::vector<plcopen::Rung>& rungs,
                          RungComments comments,
                          const PropertyLines& properties) {
  for (auto& lines : comments.before) {
    for (std::string& line : lines) line = harmless(std::move(line));
  }
  for (std::string& line : comments.at_end) line = harmless(std::move(line));
  std::vector<std::string> at_top;
  for (const std::string& line : properties.comments) {
    at_top.push_back(harmless("of the source: " + line));
  }
  pugi::xml_document document;
  xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "utf-8";
  xml_node project = add(document, "project",
                         {{"xmlns", "http://www.plcopen.org/xml/tc6_0201"},
                          {"xmlns:xhtml", "http://www.w3.org/1999/xhtml"}});
  add_headers(project, unit.name);
  xml_node types = add(project, "types");
  add(types, "dataTypes");
  xml_node pou = add(add(types, "pous"), "pou",
                     {{"name", unit.name}, {"pouType", "program"}});
  add_interface(pou, unit);
  plcopen::draw_rungs(add(add(pou, "body"), "LD"), unit, rungs, comments,
                      at_top);
  std::string lines;
  for (const std::string& line : properties.lines) {
    lines += "//@ " + line + '\n';
  }
  if (!lines.empty()) plcopen::put_note(pou, "documentation", lines);
  add_instances(project, unit.name, program);
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

}  // namespace
}  // namespace backend

std::optional<backend::Written> lower_to_plcopen(const Program& program,
                                                 const SourceSet& sources,
                                                 DiagnosticSink& sink) {
  const backend::Profile profile = {.name = "ladder diagrams",
                                    .names = &backend::iec_names(),
                                    .ladder = true};
  const auto elements = backend::iec_elements("matiec");
  std::optional<backend::Unit> unit =
      backend::UnitBuilder(program, profile, sink)
          .build(*elements, backend::program_name(program, sources));
  if (!unit) return std::nullopt;
  if (unit->statements.empty()) {
    sink.report({.code = "RP084",
                 .severity = Severity::Error,
                 .where = {program.file, 0, 0},
                 .message = "nothing is written here: a ladder diagram has a "
                            "coil at least"});
    return std::nullopt;
  }
  backend::merge_pins(*unit);
  const std::vector<backend::plcopen::Rung> rungs =
      backend::plcopen::make_rungs(*unit);
  backend::Written written = backend::finish_written(*unit, {});
  written.text = backend::write_project(
      program, *unit, rungs, backend::place_comments(program, sources),
      backend::carry_properties(program, written.signals));
  return written;
}

}  // namespace rung
