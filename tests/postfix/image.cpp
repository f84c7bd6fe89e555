#include "tests/postfix/image.h"

#include <gtest/gtest.h>

#include <deque>
#include <utility>

#include "analysis/program.h"
#include "base/postfix_format.h"
#include "frontend/postfix/reader.h"

namespace rung {
namespace {

void append(std::string& bytes, std::uint32_t value, int size) {
  for (int byte = 0; byte < size; ++byte) {
    bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * byte)));
  }
}

// The texts that programs point into; tests are short-lived.
SourceSet& sources() {
  static SourceSet set;
  return set;
}

bool same_node(const Program& a, const Program& b, std::size_t at) {
  const Node& x = a.nodes[at];
  const Node& y = b.nodes[at];
  if (x.op != y.op || x.type != y.type || x.a != y.a || x.b != y.b ||
      x.target != y.target || x.value != y.value ||
      x.skip_when != y.skip_when || x.cell != y.cell ||
      x.call.has_value() != y.call.has_value()) {
    return false;
  }
  if (!x.call.has_value()) return true;
  const ElementCall& p = a.calls[x.call];
  const ElementCall& q = b.calls[y.call];
  return p.instance == q.instance &&
         p.operation->opcode == q.operation->opcode &&
         p.parameter == q.parameter && p.arguments == q.arguments;
}

bool same_cell(const Cell& x, const Cell& y) {
  return x.name == y.name && x.type == y.type && x.role == y.role &&
         x.initial == y.initial && x.low == y.low && x.high == y.high;
}

bool same_instance(const Instance& x, const Instance& y) {
  return x.kind == y.kind && x.index == y.index && x.name == y.name &&
         x.largest_parameter == y.largest_parameter;
}

template <class ArenaT, class Same>
std::string compare(const char* what, const ArenaT& a, const ArenaT& b,
                    Same same) {
  if (a.size() != b.size()) return std::string(what) + ": numbers differ";
  auto other = b.begin();
  for (const auto& item : a) {
    if (!same(item, *other++)) return std::string(what) + " differ";
  }
  return {};
}

}  // namespace

std::string Image::bytes_of(const std::vector<unsigned>& bytes) {
  std::string text;
  for (const unsigned byte : bytes) append(text, byte, 1);
  return text;
}

std::string Image::number(std::uint32_t value) {
  std::string text;
  append(text, value, 4);
  return text;
}

std::string Image::file() const {
  std::string file(postfix::kMagic);
  append(file, version, 2);
  append(file, flags, 1);
  append(file, dialect, 1);
  append(file, 0, 4);
  append(file, 0, 4);
  append(file, scan_min, 4);
  append(file, scan_max, 4);
  append(file, bits, 2);
  append(file, words, 2);
  append(file, slots, 2);
  append(file, bit_stack, 2);
  append(file, word_stack, 2);
  append(file, branches, 2);
  append(
      file,
      static_cast<std::uint32_t>(static_cast<int>(code.size()) + code_excess),
      4);
  append(file, static_cast<std::uint32_t>(names.size()), 4);
  append(file, static_cast<std::uint32_t>(notes.size()), 4);
  file += attributes + ranges + slot_table + code + names + notes;
  return sealed(std::move(file));
}

std::string sealed(std::string file) {
  std::string length;
  append(length, static_cast<std::uint32_t>(file.size()), 4);
  file.replace(postfix::LengthField, 4, length);
  std::string crc;
  append(crc, postfix::checksum(file), 4);
  file.replace(postfix::ChecksumField, 4, crc);
  return file;
}

Program program_of(std::string_view text, std::string& said) {
  DiagnosticList found;
  const FileId file =
      add_postfix(sources(), "p.postfix", std::string(text), found);
  Program program;
  if (file.has_value()) {
    const Ast ast = read_postfix(sources(), file, found);
    if (!found.has_errors()) program = build_program(ast, {}, found);
  }
  for (const Diagnostic& item : found.items()) {
    said += std::string(item.code) + ": " + item.message + "\n";
  }
  return program;
}

Program program_of(std::string_view text) {
  std::string said;
  Program program = program_of(text, said);
  EXPECT_EQ(said, "") << text;
  return program;
}

std::string postfix_text(std::string_view declarations, std::string_view rungs,
                         std::string_view evaluation) {
  return "postfix 1\ndialect none\nevaluation " + std::string(evaluation) +
         "\nscan 1..100 ms\n" + std::string(declarations) + "rungs\n" +
         std::string(rungs);
}

std::string difference(const Program& a, const Program& b) {
  if (a.dialect != b.dialect) return "dialects differ";
  if (a.evaluation != b.evaluation) return "evaluations differ";
  if (a.scan.min_ms != b.scan.min_ms || a.scan.max_ms != b.scan.max_ms) {
    return "scan intervals differ";
  }
  if (a.annotations.size() != b.annotations.size()) return "notes differ";
  for (std::size_t i = 0; i < a.annotations.size(); ++i) {
    if (a.annotations[i].text != b.annotations[i].text) return "notes differ";
  }
  std::string found = compare("cells", a.cells, b.cells, same_cell);
  if (found.empty()) {
    found = compare("elements", a.instances, b.instances, same_instance);
  }
  if (found.empty()) {
    found =
        compare("rungs", a.rungs, b.rungs, [](const Rung& x, const Rung& y) {
          return x.target == y.target && x.begin == y.begin && x.end == y.end;
        });
  }
  if (found.empty() && a.nodes.size() != b.nodes.size()) {
    found = "nodes: numbers differ";
  }
  for (std::size_t at = 0; found.empty() && at < a.nodes.size(); ++at) {
    if (!same_node(a, b, at)) found = "node " + std::to_string(at) + " differs";
  }
  return found;
}

}  // namespace rung
