#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "frontend/error_limit.h"

namespace rung::plcopen {

/// Text out of an XML file, without the blanks around it.
struct Text {
  std::string_view text;  // in Xml::readable()
  SourceRange where;
};

/// An XML file as a tree whose nodes know where they stand.
///
/// Names are local names: any prefix and any namespace will do. Nothing is
/// ever fetched or expanded: a document type with an internal subset, where
/// entities would be declared, is refused (RP093), and so are references to
/// entities that XML does not have by itself.
///
/// So that every byte of a text keeps its place, references are replaced within
/// a copy of the file: `&lt;` becomes three blanks and `<`, and tags between
/// two pieces of one text become blanks.
class Xml {
 public:
  Xml(std::string_view text, FileId file, ErrorLimit& errors);

  /// Null when the text is not well formed; there is an error then.
  pugi::xml_node root() const { return root_; }
  pugi::xml_node document() const { return document_; }
  ErrorLimit& errors() const { return *errors_; }

  /// The name in an element's start tag; the text of any other node.
  SourceRange range(pugi::xml_node node) const;
  SourceRange range(pugi::xml_attribute attribute,
                    pugi::xml_node element) const;

  /// All text below an element, where paragraphs and spans do not matter.
  /// Errors: RP094 for any other element.
  Text text_of(pugi::xml_node element) const;
  /// Of one node that is text, or a comment.
  Text text_of_node(pugi::xml_node node) const;
  /// The value of an attribute; empty when there is none.
  Text attribute(pugi::xml_node element, const char* name) const;
  /// The copy of the file that texts point into: of the same length.
  std::shared_ptr<const std::string> readable() const { return readable_; }

  void error(std::string_view code, pugi::xml_node node,
             std::string message) const;
  /// RP094, "`x` in `y` is not supported".
  void refuse(pugi::xml_node element) const;
  /// Refuses attributes that are not listed; those that have a prefix, and
  /// `xmlns`, say nothing about the program.
  void allow_attributes(pugi::xml_node element,
                        std::initializer_list<std::string_view> names) const;

 private:
  bool check_document(pugi::xml_node& root) const;
  void check_attributes() const;
  void decode(SourceRange raw) const;
  void blank(std::uint32_t begin, std::uint32_t end) const;
  Text trimmed_text(SourceRange where) const;
  std::optional<std::uint32_t> offset(const char* place) const;

  std::string_view text_;
  std::string buffer_;  // the parser works in place, so places are offsets
  std::shared_ptr<std::string> readable_;
  FileId file_;
  ErrorLimit* errors_;
  pugi::xml_document document_;
  pugi::xml_node root_;
};

/// Without the prefix: `contact` of `ns1:contact`.
std::string_view local_name(pugi::xml_node element);
bool is_element(pugi::xml_node node);

/// The child elements of a node, in order.
std::vector<pugi::xml_node> elements_of(pugi::xml_node node);
/// The first child of that name; null when there is none.
pugi::xml_node child_named(pugi::xml_node node, std::string_view name);

/// The next node of the whole tree below `root`, in document order; null at
/// the end. Walks without recursion: the depth is the file's choice.
pugi::xml_node next_in_tree(pugi::xml_node node, pugi::xml_node root);

std::string_view trimmed(std::string_view text);
/// A letter or `_`, then letters, digits and `_`.
bool is_identifier(std::string_view text);

}  // namespace rung::plcopen
