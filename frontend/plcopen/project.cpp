#include "frontend/plcopen/project.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/iec/bodies.h"
#include "frontend/iec/scope.h"
#include "frontend/iec/text_reader.h"
#include "frontend/iec/token.h"
#include "frontend/plcopen/drawing.h"
#include "frontend/plcopen/graph_reader.h"
#include "frontend/token_list.h"

namespace rung::plcopen {
namespace {

using iec::Role;
using pugi::xml_node;

struct Section {
  std::string_view name;
  Role role = Role::Local;
};
constexpr std::array kSections = {
    Section{"inputVars", Role::Input},
    Section{"outputVars", Role::Output},
    Section{"inOutVars", Role::InOut},
    Section{"localVars", Role::Local},
    Section{"tempVars", Role::Temp},
    Section{"externalVars", Role::External},
    Section{"globalVars", Role::Global},
};

std::optional<Role> role_of(std::string_view section) {
  for (const Section& one : kSections) {
    if (one.name == section) return one.role;
  }
  return std::nullopt;
}

/// What tells people or editors something, and nothing about the program.
bool says_nothing(std::string_view name) {
  return name == "documentation" || name == "fileHeader" ||
         name == "contentHeader";
}

class ProjectReader {
 public:
  ProjectReader(const Xml& xml, const Semantics& semantics, Ast& ast)
      : xml_(&xml), semantics_(&semantics), ast_(&ast) {}

  iec::Project read() {
    const xml_node root = xml_->root();
    if (local_name(root) != "project") {
      xml_->error("RP094", root,
                  quoted_excerpt(local_name(root)) +
                      " is not supported: the root of a file is `project`");
      return std::move(project_);
    }
    for (const xml_node child : elements_of(root)) {
      const std::string_view name = local_name(child);
      if (name == "types") {
        read_types(child);
      } else if (name == "pous") {  // ESBMC has them here
        read_pous(child);
      } else if (name == "instances") {
        read_instances(child);
      } else if (!says_nothing(name)) {
        xml_->refuse(child);
      }
    }
    return std::move(project_);
  }

 private:
  std::string_view keep(std::string_view text) {
    ast_->made_names.push_back(std::make_shared<const std::string>(text));
    return *ast_->made_names.back();
  }

  void read_types(xml_node types) {
    for (const xml_node child : elements_of(types)) {
      const std::string_view name = local_name(child);
      if (name == "dataTypes") {
        for (const xml_node type : elements_of(child)) xml_->refuse(type);
      } else if (name == "pous") {
        read_pous(child);
      } else if (!says_nothing(name)) {
        xml_->refuse(child);
      }
    }
  }

  void read_pous(xml_node pous) {
    for (const xml_node child : elements_of(pous)) {
      if (local_name(child) == "pou") {
        read_pou(child);
      } else {
        xml_->refuse(child);
      }
    }
  }

  void read_pou(xml_node node) {
    xml_->allow_attributes(node, {"name", "pouType", "globalId"});
    iec::Pou& pou = project_.pous.emplace_back();
    pou.where = xml_->range(node);
    pou.name = identifier(node, "name");
    const std::string_view kind = xml_->attribute(node, "pouType").text;
    if (kind == "program") {
      pou.kind = iec::PouKind::Program;
    } else if (kind == "functionBlock") {
      pou.kind = iec::PouKind::FunctionBlock;
    } else if (kind == "function") {
      pou.kind = iec::PouKind::Function;
    } else {
      xml_->error("RP095", node,
                  quoted_excerpt(kind) + " is no value of `pouType`");
    }
    xml_node body;
    for (const xml_node child : elements_of(node)) {
      const std::string_view name = local_name(child);
      if (name == "interface") {
        read_interface(child, pou);
      } else if (name == "body" && !body) {
        body = child;
      } else if (!says_nothing(name)) {
        xml_->refuse(child);
      }
    }
    if (body) {
      read_body(body, pou);
    } else {
      xml_->error("RP095", node, quoted_excerpt(pou.name) + " has no `body`");
    }
  }

  void read_interface(xml_node interface, iec::Pou& pou) {
    for (const xml_node child : elements_of(interface)) {
      const std::string_view name = local_name(child);
      if (name == "returnType") {
        const std::vector<xml_node> types = elements_of(child);
        if (types.size() == 1) pou.result = type_of(types.front());
      } else if (role_of(name)) {
        read_section(child, *role_of(name), pou.variables);
      } else if (!says_nothing(name)) {
        xml_->refuse(child);
      }
    }
  }

  void read_section(xml_node section, Role role,
                    std::vector<iec::Variable>& variables) {
    xml_->allow_attributes(section, {"constant", "retain", "nonretain", "name",
                                     "persistent", "nonpersistent"});
    const auto says = [&](const char* name) {
      const std::string_view value = xml_->attribute(section, name).text;
      return value == "true" || value == "1";
    };
    for (const xml_node child : elements_of(section)) {
      if (says_nothing(local_name(child))) continue;
      if (local_name(child) != "variable") {
        xml_->refuse(child);
        continue;
      }
      iec::Variable variable = read_variable(child);
      variable.role = role;
      variable.constant = says("constant");
      variable.retain = says("retain") || says("persistent");
      variables.push_back(variable);
    }
  }

  iec::Variable read_variable(xml_node node) {
    xml_->allow_attributes(node, {"name", "address", "globalId"});
    iec::Variable variable;
    variable.name = identifier(node, "name");
    variable.where = xml_->attribute(node, "name").where;
    variable.address = xml_->attribute(node, "address").text;
    for (const xml_node child : elements_of(node)) {
      const std::string_view name = local_name(child);
      const std::vector<xml_node> inner = elements_of(child);
      if (name == "type" && inner.size() == 1) {
        variable.type = type_of(inner.front());
        variable.type_where = xml_->range(inner.front());
      } else if (name == "initialValue" && inner.size() == 1 &&
                 local_name(inner.front()) == "simpleValue") {
        variable.initial = xml_->attribute(inner.front(), "value").text;
      } else if (!says_nothing(name)) {
        xml_->refuse(inner.size() == 1 ? inner.front() : child);
      }
    }
    if (variable.type.empty()) {
      xml_->error("RP095", node,
                  quoted_excerpt(variable.name) + " has no type");
    }
    return variable;
  }

  /// `<BOOL/>`, `<derived name="lamp"/>`; others by what they are called.
  std::string_view type_of(xml_node node) {
    if (local_name(node) == "derived") {
      return xml_->attribute(node, "name").text;
    }
    return keep(iec::upper(local_name(node)));
  }

  std::string_view identifier(xml_node node, const char* attribute) {
    const std::string_view name = xml_->attribute(node, attribute).text;
    if (!is_identifier(name)) {
      xml_->error("RP095", node,
                  quoted_excerpt(name) + " is no name of a " +
                      std::string(local_name(node)));
    }
    return name;
  }

  void read_body(xml_node body, iec::Pou& pou) {
    xml_->allow_attributes(body, {"worksheetName", "globalId"});
    std::vector<xml_node> contents = elements_of(body);
    std::erase_if(contents,
                  [](xml_node node) { return says_nothing(local_name(node)); });
    if (contents.size() != 1) {
      xml_->error("RP095", body, "a body is one `LD`, `FBD`, `ST` or `IL`");
      return;
    }
    const xml_node content = contents.front();
    const std::string_view language = local_name(content);
    if (language == "LD" || language == "FBD") {
      read_drawing(content, pou);
    } else if (language == "ST" || language == "IL") {
      read_text(content, pou, language == "ST");
    } else {
      xml_->refuse(content);
    }
  }

  void read_text(xml_node content, iec::Pou& pou, bool structured) {
    const Text text = xml_->text_of(content);
    auto list = std::make_shared<const iec::TokenList>(iec::tokenize(
        *xml_->readable(), text.where.file, text.where.begin, text.where.end));
    if (list->open_comment.has_value()) {
      xml_->errors().error("RP007", list->open_comment,
                           "this comment is not closed");
    }
    iec::take_comments(*list, *ast_);
    iec::note_mentions(*list, project_);
    const std::size_t end = list->tokens.size() - 1;
    pou.body = structured ? iec::structured_text(std::move(list), 0, end)
                          : iec::instruction_list(std::move(list), 0, end);
  }

  void read_drawing(xml_node content, iec::Pou& pou) {
    auto drawing = std::make_shared<const Drawing>(make_drawing(
        GraphReader(*xml_).read(content), *semantics_, xml_->errors()));
    std::unordered_map<std::string, std::size_t> declared;
    for (std::size_t at = 0; at < pou.variables.size(); ++at) {
      declared.emplace(iec::upper(pou.variables[at].name), at);
    }
    for (const Element& element : drawing->graph.elements) {
      iec::note_mentions(element.text.text, project_);
      if (element.kind != ElementKind::Block) continue;
      note_pins(element);
      if (!element.instance.empty()) note_instance(element, declared, pou);
    }
    pou.body = [drawing](iec::Scope& scope) {
      DrawingRun(*drawing, scope).run();
    };
  }

  void note_pins(const Element& block) {
    for (const auto* const pins : {&block.inputs, &block.outputs}) {
      for (const Pin& pin : *pins) {
        const std::string name = iec::upper(pin.name);
        project_.mentioned.insert(name);
        // What takes the block's values looks at ENO, drawn or not.
        if (name == "EN") project_.mentioned.insert("ENO");
      }
    }
  }

  /// ESBMC's files leave the declaration of instances out.
  void note_instance(const Element& block,
                     std::unordered_map<std::string, std::size_t>& declared,
                     iec::Pou& pou) {
    const auto [known, fresh] =
        declared.emplace(iec::upper(block.instance), pou.variables.size());
    if (fresh) {
      pou.variables.push_back({.name = block.instance,
                               .type = block.type,
                               .where = block.where,
                               .type_where = block.where});
      return;
    }
    const iec::Variable& variable = pou.variables[known->second];
    if (iec::upper(variable.type) == iec::upper(block.type)) return;
    xml_->errors().error(
        "RP095", block.where,
        shown(block) + " is declared as " + quoted_excerpt(variable.type),
        {{variable.where, "declared here"}});
  }

  /// configurations/configuration/resource: globals, tasks and programs.
  void read_instances(xml_node instances) {
    std::vector<xml_node> open = elements_of(instances);
    std::reverse(open.begin(), open.end());
    while (!open.empty()) {
      const xml_node node = open.back();
      open.pop_back();
      const std::string_view name = local_name(node);
      if (name == "configurations" || name == "configuration" ||
          name == "resource" || name == "task") {
        std::vector<xml_node> inner = elements_of(node);
        open.insert(open.end(), inner.rbegin(), inner.rend());
      } else if (name == "globalVars") {
        read_section(node, Role::Global, project_.globals);
      } else if (name == "pouInstance") {
        read_instance(node);
      } else if (!says_nothing(name)) {
        xml_->refuse(node);
      }
    }
  }

  void read_instance(xml_node node) {
    xml_->allow_attributes(node, {"name", "typeName", "type", "globalId"});
    iec::ProgramInstance& instance = project_.instances.emplace_back();
    instance.name = xml_->attribute(node, "name").text;
    instance.type = xml_->attribute(node, "typeName").text;
    instance.where = xml_->range(node);
    const xml_node task = node.parent();
    if (local_name(task) != "task") return;
    xml_->allow_attributes(task, {"name", "interval", "priority", "globalId"});
    const Text interval = xml_->attribute(task, "interval");
    if (interval.text.empty()) return;
    instance.interval_ms = iec::milliseconds_of(interval.text);
    if (!instance.interval_ms || *instance.interval_ms == 0) {
      xml_->errors().error("RP095", interval.where,
                           quoted_excerpt(interval.text) +
                               " is no interval: whole milliseconds, such as "
                               "T#20ms");
    }
  }

  const Xml* xml_;
  const Semantics* semantics_;
  Ast* ast_;
  iec::Project project_;
};

}  // namespace

iec::Project read_project(const Xml& xml, const Semantics& semantics,
                          Ast& ast) {
  return ProjectReader(xml, semantics, ast).read();
}

}  // namespace rung::plcopen
