#include "frontend/rockwell/project.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <string>
#include <utility>

#include "frontend/rockwell/annotations.h"
#include "frontend/token_list.h"

namespace rung::rockwell {
namespace {

using plcopen::child_named;
using plcopen::elements_of;
using plcopen::local_name;

class Reader {
 public:
  Reader(const plcopen::Xml& xml, Ast& ast, ErrorLimit& errors)
      : xml_(xml), ast_(ast), errors_(errors) {}

  std::optional<Project> run() {
    const pugi::xml_node controller = child_named(xml_.root(), "Controller");
    if (local_name(xml_.root()) != "RSLogix5000Content" || !controller) {
      xml_.error("RP051", xml_.root(),
                 "an export of Logix Designer has `RSLogix5000Content` and a "
                 "`Controller` in it");
      return std::nullopt;
    }
    data_types(child_named(controller, "DataTypes"));
    tags(child_named(controller, "Tags"), out_.tags);
    const std::vector<pugi::xml_node> programs =
        elements_of(child_named(controller, "Programs"));
    if (programs.size() != 1) {
      xml_.error("RP087", programs.empty() ? controller : programs[1],
                 programs.empty()
                     ? "there is no program in this export: add-on "
                       "instructions alone are not read"
                     : "several programs are not supported: export one");
      return std::nullopt;
    }
    program(programs.front());
    return std::move(out_);
  }

 private:
  std::string_view attribute(pugi::xml_node node, const char* name) const {
    return xml_.attribute(node, name).text;
  }

  void data_types(pugi::xml_node parent) {
    for (const pugi::xml_node type : elements_of(parent)) {
      DataType& members = out_.types[attribute(type, "Name")];
      for (const pugi::xml_node it :
           elements_of(child_named(type, "Members"))) {
        Member member;
        member.type = attribute(it, "DataType");
        member.target = attribute(it, "Target");
        member.bit = static_cast<std::uint32_t>(
            number_of(attribute(it, "BitNumber")).value_or(0));
        const std::string_view dimension = attribute(it, "Dimension");
        // An array is no leaf: who uses it is told so.
        if (dimension != "0" && !dimension.empty()) member.type = "array";
        members[attribute(it, "Name")] = member;
      }
    }
  }

  void tags(pugi::xml_node parent, std::map<std::string_view, Tag>& into) {
    std::map<std::string_view, Tag> found;
    for (const pugi::xml_node node : elements_of(parent)) {
      const Text name = xml_.attribute(node, "Name");
      Tag tag;
      tag.name = name.text;
      tag.where = name.where;
      tag.type = attribute(node, "DataType");
      tag.dimensions = attribute(node, "Dimensions");
      tag.alias = attribute(node, "AliasFor");
      tag.constant = attribute(node, "Constant") == "true";
      tag.node = node;
      const auto [at, fresh] = found.emplace(tag.name, tag);
      if (fresh) continue;
      errors_.error("RP052", name.where,
                    quoted_excerpt(name.text) + " is declared a second time",
                    {{at->second.where, "it is declared here"}});
    }
    for (auto& [name, tag] : found) into.insert_or_assign(name, tag);
  }

  void program(pugi::xml_node node) {
    tags(child_named(node, "Tags"), out_.tags);
    for (const pugi::xml_node it : elements_of(child_named(node, "Routines"))) {
      routine(it);
    }
    choose_main(node);
    if (errors_.is_full() || out_.routines.empty()) return;
    check_annotations();
  }

  void routine(pugi::xml_node node) {
    const Text name = xml_.attribute(node, "Name");
    Routine routine;
    routine.name = name.text;
    routine.where = name.where;
    routine.type = attribute(node, "Type");
    std::vector<Comment>& comments = comments_.emplace_back();
    for (const pugi::xml_node rung :
         elements_of(child_named(node, "RLLContent"))) {
      const auto first = static_cast<std::uint32_t>(routine.texts.rungs.size());
      read_rung(rung, routine);
      const pugi::xml_node comment = child_named(rung, "Comment");
      if (comment) comments.push_back({xml_.text_of(comment), first});
    }
    if (!names_.insert(name.text).second) {
      errors_.error("RP052", name.where,
                    quoted_excerpt(name.text) + " is declared a second time");
    }
    finish_routine(routine, errors_);
    out_.routines.push_back(std::move(routine));
  }

  void read_rung(pugi::xml_node rung, Routine& routine) {
    const std::string_view type = attribute(rung, "Type");
    if (local_name(rung) != "Rung" || (type != "N" && !type.empty())) {
      return xml_.error("RP087", rung,
                        "rungs that are being edited are not supported");
    }
    const pugi::xml_node child = child_named(rung, "Text");
    if (!child) {
      return xml_.error("RP051", rung, "this rung has no `Text`");
    }
    const Text text = xml_.text_of(child);
    read_rungs({text.text, text.where.file, text.where.begin}, routine.texts,
               errors_);
  }

  // The one that is named; else the one that no other calls.
  void choose_main(pugi::xml_node program) {
    const Text name = xml_.attribute(program, "MainRoutineName");
    std::set<std::string_view> called;
    for (const Routine& routine : out_.routines) {
      for (const Instruction& it : routine.texts.instructions) {
        if (it.kind->op == Op::Call) called.insert(it.operands[0].text);
      }
    }
    std::size_t roots = 0;
    bool found = false;
    for (std::size_t i = 0; i < out_.routines.size(); ++i) {
      const std::string_view routine = out_.routines[i].name;
      if (name.text.empty() ? !called.contains(routine)
                            : routine == name.text) {
        if (!found) out_.main = i;
        found = true;
        ++roots;
      }
    }
    if (roots == 1 && out_.routines[out_.main].type == "RLL") return;
    if (roots == 1) {
      errors_.error("RP087", out_.routines[out_.main].where,
                    "the main routine is no ladder: that is not supported");
      return;
    }
    xml_.error("RP051", program,
               roots == 0 ? "there is no main routine"
                          : "the main routine is not named, and several "
                            "routines could be it");
  }

  // Those of l5x2c stand at the begin and the end of the main routine.
  void check_annotations() {
    for (std::size_t i = 0; i < out_.routines.size(); ++i) {
      const std::size_t rungs = out_.routines[i].texts.rungs.size();
      for (const Comment& comment : comments_[i]) {
        read_annotations(comment.text,
                         {.main = i == out_.main,
                          .first = comment.rung == 0,
                          .last = comment.rung + 1 == rungs},
                         out_, ast_, errors_);
      }
    }
  }

  struct Comment {
    Text text;
    std::uint32_t rung = 0;
  };

  const plcopen::Xml& xml_;
  Ast& ast_;
  ErrorLimit& errors_;
  Project out_;
  std::set<std::string_view> names_;            // of routines
  std::vector<std::vector<Comment>> comments_;  // by routine
};

/// The first name or index of a path, and what follows it.
std::string_view next_part(std::string_view& path) {
  const bool index = path.starts_with("[");
  std::size_t end = index ? path.find(']') : path.find_first_of(".[", 1);
  if (end == path.npos) end = path.size();
  if (index && end < path.size()) ++end;
  const std::string_view part =
      path.substr(index ? 0 : 1, index ? end : end - 1);
  path.remove_prefix(end);
  return part;
}

}  // namespace

std::optional<Project> read_project(const plcopen::Xml& xml, Ast& ast,
                                    ErrorLimit& errors) {
  return Reader(xml, ast, errors).run();
}

void finish_routine(Routine& routine, ErrorLimit& errors) {
  for (std::uint32_t i = 0; i < routine.texts.rungs.size(); ++i) {
    const RungText& rung = routine.texts.rungs[i];
    for (const ladder::Step& step : rung.steps) {
      if (step.kind != ladder::Step::Kind::Instruction) continue;
      const Instruction& it = routine.texts.instructions[step.instruction];
      if (it.kind->op != Op::Label) continue;
      if (&step != rung.steps.data()) {
        errors.error("RP089", it.where, "a label stands first in its rung");
      }
      if (!routine.labels.emplace(it.operands[0].text, i).second) {
        errors.error("RP089", it.operands[0].where,
                     "the label " + quoted_excerpt(it.operands[0].text) +
                         " stands further up already");
      }
    }
  }
}

std::optional<std::int64_t> number_of(std::string_view text) {
  std::string digits;
  for (const char c : text) {
    if (c != '_') digits += c;
  }
  const bool negative = digits.starts_with("-");
  if (negative) digits.erase(0, 1);
  int base = 10;
  for (const int candidate : {2, 8, 16}) {
    const std::string prefix = std::to_string(candidate) + "#";
    if (!digits.starts_with(prefix)) continue;
    base = candidate;
    digits.erase(0, prefix.size());
    break;
  }
  std::int64_t value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, problem] = std::from_chars(digits.data(), end, value, base);
  if (digits.starts_with("-") || problem != std::errc() || stop != end) {
    return std::nullopt;
  }
  return negative ? -value : value;
}

std::optional<std::int64_t> value_of(const Tag& tag, std::string_view path) {
  pugi::xml_node node;
  for (const pugi::xml_node data : tag.node.children("Data")) {
    if (std::string_view(data.attribute("Format").value()) == "Decorated") {
      node = elements_of(data).empty() ? pugi::xml_node()
                                       : elements_of(data).front();
    }
  }
  while (node && !path.empty()) {
    const std::string_view part = next_part(path);
    pugi::xml_node found;
    for (const pugi::xml_node child : node.children()) {
      const bool here =
          std::string_view(child.attribute("Name").value()) == part ||
          std::string_view(child.attribute("Index").value()) == part;
      if (here) found = child;
      if (here) break;
    }
    // The structure of an array's element stands in it.
    node = found;
    if (local_name(node) == "Element" && child_named(node, "Structure")) {
      node = child_named(node, "Structure");
    }
  }
  if (!node || !node.attribute("Value")) return std::nullopt;
  return number_of(node.attribute("Value").value());
}

}  // namespace rung::rockwell
