#include "declared_text.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "analysis/simulator.h"
#include "dump.h"

namespace rung::test {

DeclaredText::DeclaredText(std::string_view language, std::string text,
                           const ReadOptions& options)
    : file(sources.add("text", std::move(text))),
      ast(find_language(language)->read(sources, file, options, list)) {
  if (!list.has_errors()) program = build_program(ast, {}, list);
}

std::string DeclaredText::rungs() const {
  std::string result;
  for (const AstAssignment& rung : ast.rungs) {
    result += (result.empty() ? "" : " | ") + std::string(rung.target) + "=" +
              dump(ast, rung.value);
  }
  return result;
}

std::string DeclaredText::problems() const {
  std::string result;
  for (const Diagnostic& item : list.items()) {
    const LineColumn at = sources[file].position(item.where.begin);
    result += std::string(item.code) + " " + std::to_string(at.line) + ":" +
              std::to_string(at.column) + " " + item.message + "\n";
  }
  return result;
}

// A scan is words `name=value`; scans are separated by `;`. Watched cells are
// shown after every scan, scans separated by blanks.
std::string DeclaredText::run(std::string_view stimulus,
                              std::string_view watch) const {
  Simulator simulator(program);
  std::string result;
  for (std::size_t at = 0; at <= stimulus.size();) {
    const std::size_t end = std::min(stimulus.find(';', at), stimulus.size());
    std::istringstream words{std::string(stimulus.substr(at, end - at))};
    at = end + 1;
    for (std::string word; words >> word;) {
      const std::size_t equal = word.find('=');
      simulator.set_input(find_cell(program, word.substr(0, equal)),
                          std::stoll(word.substr(equal + 1)));
    }
    simulator.scan(program.scan.min_ms);
    result += result.empty() ? "" : " ";
    std::istringstream names{std::string(watch)};
    std::string values;
    for (std::string name; names >> name;) {
      const CellId cell = find_cell(program, name);
      values += (values.empty() ? "" : ",") +
                (cell.has_value() ? std::to_string(simulator.value(cell))
                                  : "?" + name);
    }
    result += values;
  }
  return result;
}

}  // namespace rung::test
