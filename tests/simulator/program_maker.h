#pragma once

#include <cassert>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/program.h"

namespace rung {

/// Builds programs node by node, for what no reader is wanted in the loop.
/// Nodes are added in execution order; rung() ends the rung.
class ProgramMaker {
 public:
  CellId input(std::string name) {
    return cell(std::move(name), CellRole::Input, Type::Bit, 0, 1);
  }
  CellId output(std::string name) {
    return cell(std::move(name), CellRole::Output, Type::Bit, 0, 1);
  }
  CellId word(std::string name, CellRole role) {
    return cell(std::move(name), role, Type::Word, -32768, 32767);
  }

  std::uint32_t read(CellId cell) {
    return add(
        {.op = NodeOp::Read, .type = program_.cells[cell].type, .cell = cell});
  }
  std::uint32_t constant(std::int64_t value, Type type = Type::Bit) {
    return add({.op = NodeOp::Constant, .type = type, .value = value});
  }
  std::uint32_t node(NodeOp op, std::uint32_t a, std::uint32_t b = 0,
                     Type type = Type::Bit) {
    return add({.op = op, .type = type, .a = a, .b = b});
  }
  /// To be closed by short_circuit(); gives the marker's position.
  std::uint32_t branch(std::uint32_t left, bool skip_when) {
    return add({.op = NodeOp::Branch, .skip_when = skip_when, .a = left});
  }
  std::uint32_t short_circuit(NodeOp op, std::uint32_t marker,
                              std::uint32_t right) {
    const std::uint32_t at = node(op, program_.nodes[marker].a, right);
    program_.nodes[marker].target = at;
    return at;
  }
  std::uint32_t call(std::string_view dialect, std::string_view name,
                     std::int64_t index, std::int64_t parameter,
                     std::vector<std::uint32_t> arguments) {
    const FoundOperation found = find_operation(dialect, name);
    assert(found.kind != nullptr);
    const InstanceId instance = instance_of(found.kind, index);
    Instance& shared = program_.instances[instance];
    shared.largest_parameter = std::max(shared.largest_parameter, parameter);
    shared.clock_cap = shared.largest_parameter + 1;
    ElementCall element;
    element.instance = instance;
    element.operation = found.operation;
    element.parameter = parameter;
    element.arguments = std::move(arguments);
    const CallId id = program_.calls.add(std::move(element));
    return add({.op = NodeOp::Call, .call = id});
  }

  void rung(CellId target) {
    Rung rung;
    rung.target = target;
    rung.begin = begin_;
    rung.end = begin_ = static_cast<std::uint32_t>(program_.nodes.size());
    program_.rungs.add(rung);
  }

  Program& program() { return program_; }

 private:
  CellId cell(std::string name, CellRole role, Type type, std::int64_t low,
              std::int64_t high) {
    Cell cell;
    cell.name = std::move(name);
    cell.type = type;
    cell.role = role;
    cell.low = low;
    cell.high = high;
    return program_.cells.add(std::move(cell));
  }

  std::uint32_t add(Node node) {
    program_.nodes.push_back(node);
    return static_cast<std::uint32_t>(program_.nodes.size() - 1);
  }

  InstanceId instance_of(const ElementKind* kind, std::int64_t index) {
    for (const InstanceId id : ids_of(program_.instances)) {
      const Instance& known = program_.instances[id];
      if (known.kind == kind && known.index == index) return id;
    }
    Instance instance;
    instance.kind = kind;
    instance.index = index;
    instance.name =
        std::string(kind->letter) + "(" + std::to_string(index) + ")";
    return program_.instances.add(std::move(instance));
  }

  Program program_;
  std::uint32_t begin_ = 0;
};

}  // namespace rung
