#include <algorithm>

#include "frontend/plcopen/project.h"

namespace rung::plcopen {
namespace {

using pugi::xml_node;

/// The text after `//@`, or between `(*@` and `*)`; empty: no property line.
std::string_view property_in(std::string_view line) {
  line = trimmed(line);
  const bool block = line.starts_with("(*@");
  if (!block && !line.starts_with("//@")) return {};
  line.remove_prefix(3);
  if (block && line.ends_with("*)")) line.remove_suffix(2);
  return trimmed(line);
}

class CommentReader {
 public:
  explicit CommentReader(Ast& ast) : ast_(&ast) {}

  void read(const Text& text) {
    if (text.text.empty()) return;
    bool properties = false;
    std::string_view rest = text.text;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
      const std::string_view line = property_in(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (line.empty()) continue;
      properties = true;
      const std::string_view word = line.substr(0, line.find_first_of(" \t"));
      // A line `language` has been obeyed.
      if (word != "language")
        ast_->annotations.push_back({line, at(line, text)});
    }
    if (!properties) ast_->comments.push_back({text.text, text.where});
  }

 private:
  static SourceRange at(std::string_view line, const Text& text) {
    const auto begin = text.where.begin + static_cast<std::uint32_t>(
                                              line.data() - text.text.data());
    return {text.where.file, begin,
            begin + static_cast<std::uint32_t>(line.size())};
  }

  Ast* ast_;
};

}  // namespace

void read_comments(const Xml& xml, Ast& ast) {
  CommentReader reader(ast);
  for (xml_node node = xml.document(); node;
       node = next_in_tree(node, xml.document())) {
    if (node.type() == pugi::node_comment) {
      reader.read(xml.text_of_node(node));
    } else if (is_element(node) && (local_name(node) == "documentation" ||
                                    local_name(node) == "content")) {
      reader.read(xml.text_of(node));
    }
  }
}

}  // namespace rung::plcopen
