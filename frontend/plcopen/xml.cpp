#include "frontend/plcopen/xml.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <utility>

#include "frontend/token_list.h"

namespace rung::plcopen {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f";

// Text is taken raw, and references are replaced here: so every byte keeps its
// place. Text outside the root and document types are kept to be refused.
constexpr unsigned kParse = pugi::parse_cdata | pugi::parse_comments |
                            pugi::parse_doctype | pugi::parse_fragment;

struct Entity {
  std::string_view name;
  std::string_view text;
};
constexpr std::array kEntities = {
    Entity{"lt", "<"},    Entity{"gt", ">"},   Entity{"amp", "&"},
    Entity{"quot", "\""}, Entity{"apos", "'"},
};

std::string utf8(std::uint32_t code) {
  std::string text;
  const auto put = [&](std::uint32_t byte) {
    text.push_back(static_cast<char>(byte));
  };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | code >> 6);
    put(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    put(0xE0 | code >> 12);
    put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  } else {
    put(0xF0 | code >> 18);
    put(0x80 | (code >> 12 & 0x3F));
    put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  }
  return text;
}

/// Of `#65` or `#x41`; nothing when it is no character of a text.
std::optional<std::string> character(std::string_view digits) {
  digits.remove_prefix(1);
  const bool hex = digits.starts_with("x");
  if (hex) digits.remove_prefix(1);
  if (digits.empty() || digits.size() > 7) return std::nullopt;
  std::uint32_t code = 0;
  for (const char one : digits) {
    const auto at = std::string_view("0123456789abcdef")
                        .find(static_cast<char>(
                            std::tolower(static_cast<unsigned char>(one))));
    if (at == std::string_view::npos || (!hex && at > 9)) return std::nullopt;
    code = code * (hex ? 16 : 10) + static_cast<std::uint32_t>(at);
  }
  const bool control =
      code < 0x20 && code != '\t' && code != '\n' && code != '\r';
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  if (control || code == 0x7F || surrogate || code > 0x10FFFF) {
    return std::nullopt;
  }
  return utf8(code);
}

/// Of the name between `&` and `;`.
std::optional<std::string> replacement(std::string_view name) {
  if (name.starts_with("#")) return character(name);
  for (const Entity& entity : kEntities) {
    if (entity.name == name) return std::string(entity.text);
  }
  return std::nullopt;
}

/// Elements of XHTML that only set text.
bool is_typesetting(std::string_view name) {
  constexpr std::array<std::string_view, 5> kNames = {"xhtml", "p", "div",
                                                      "span", "html"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

}  // namespace

Xml::Xml(std::string_view text, FileId file, ErrorLimit& errors)
    : text_(text),
      buffer_(text),
      readable_(std::make_shared<std::string>(text)),
      file_(file),
      errors_(&errors) {
  const pugi::xml_parse_result result = document_.load_buffer_inplace(
      buffer_.data(), buffer_.size(), kParse, pugi::encoding_utf8);
  if (!result) {
    const auto at = static_cast<std::uint32_t>(std::clamp<std::ptrdiff_t>(
        result.offset, 0, static_cast<std::ptrdiff_t>(text.size())));
    std::string what = result.description();
    what[0] = static_cast<char>(std::tolower(what[0]));
    errors.error("RP093", {file, at, at},
                 "this is not well-formed XML: " + what);
    return;
  }
  pugi::xml_node root;
  if (!check_document(root)) return;
  root_ = root;
  check_attributes();
}

/// One root element, and no document type that could declare entities.
bool Xml::check_document(pugi::xml_node& root) const {
  for (const pugi::xml_node node : document_.children()) {
    switch (node.type()) {
      case pugi::node_element:
        if (root) {
          error("RP093", node, "a file has one root element");
          return false;
        }
        root = node;
        break;
      case pugi::node_doctype:
        if (std::string_view(node.value()).find('[') !=
            std::string_view::npos) {
          error("RP093", node,
                "a document type with declarations of its own is not read: "
                "entities are not expanded");
          return false;
        }
        break;
      case pugi::node_pcdata:
      case pugi::node_cdata:
        if (trimmed(node.value()).empty()) break;
        error("RP093", node, "there is text outside the root element");
        return false;
      default:
        break;
    }
  }
  if (!root) errors_->error("RP093", {file_, 0, 0}, "there is no element");
  return static_cast<bool>(root);
}

/// The parser takes the first of two attributes of one name; XML has none.
void Xml::check_attributes() const {
  std::vector<std::string_view> names;
  for (pugi::xml_node node = root_; node; node = next_in_tree(node, root_)) {
    names.clear();
    for (const pugi::xml_attribute attribute : node.attributes()) {
      names.emplace_back(attribute.name());
    }
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice == names.end()) continue;
    error("RP093", node,
          "the attribute " + quoted_excerpt(*twice) + " stands here twice");
  }
}

std::optional<std::uint32_t> Xml::offset(const char* place) const {
  const char* const begin = buffer_.data();
  if (place < begin || place > begin + buffer_.size()) return std::nullopt;
  return static_cast<std::uint32_t>(place - begin);
}

SourceRange Xml::range(pugi::xml_node node) const {
  const char* const text =
      node.type() == pugi::node_element ? node.name() : node.value();
  const auto begin = offset(text);
  if (!begin) return {file_, 0, 0};
  const std::size_t length = std::string_view(text).size();
  return {file_, *begin, *begin + static_cast<std::uint32_t>(length)};
}

SourceRange Xml::range(pugi::xml_attribute attribute,
                       pugi::xml_node element) const {
  const auto begin = offset(attribute.value());
  if (!attribute || !begin) return range(element);
  const std::size_t length = std::string_view(attribute.value()).size();
  return {file_, *begin, *begin + static_cast<std::uint32_t>(length)};
}

void Xml::blank(std::uint32_t begin, std::uint32_t end) const {
  for (std::uint32_t at = begin; at < end; ++at) {
    char& one = (*readable_)[at];
    if (one != '\n' && one != '\r') one = ' ';
  }
}

/// Replaces the references of this part of the file. Those that follow each
/// other stay together: `&lt;&gt;` is one operator.
void Xml::decode(SourceRange raw) const {
  const std::string_view text = text_.substr(0, raw.end);
  for (std::size_t at = text.find('&', raw.begin); at < text.size();
       at = text.find('&', at)) {
    std::string replaced;
    const std::size_t begin = at;
    while (at < text.size() && text[at] == '&') {
      const std::size_t length = text.substr(at + 1, 12).find(';');
      const auto found = length == std::string_view::npos
                             ? std::nullopt
                             : replacement(text.substr(at + 1, length));
      if (!found) {
        const auto place = static_cast<std::uint32_t>(at);
        errors_->error("RP093", {file_, place, place + 1},
                       "this is a reference to nothing: XML has `&lt;`, "
                       "`&gt;`, `&amp;`, `&quot;`, `&apos;` and characters by "
                       "number");
        return;
      }
      replaced += *found;
      at += length + 2;
    }
    blank(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(at));
    readable_->replace(at - replaced.size(), replaced.size(), replaced);
  }
}

Text Xml::trimmed_text(SourceRange where) const {
  const std::string_view whole = *readable_;
  const std::string_view text =
      trimmed(whole.substr(where.begin, where.end - where.begin));
  if (text.empty()) return {text, where};
  where.begin = static_cast<std::uint32_t>(text.data() - whole.data());
  where.end = where.begin + static_cast<std::uint32_t>(text.size());
  return {text, where};
}

Text Xml::text_of_node(pugi::xml_node node) const {
  const SourceRange where = range(node);
  if (node.type() == pugi::node_pcdata) decode(where);
  return trimmed_text(where);
}

Text Xml::text_of(pugi::xml_node element) const {
  SourceRange all;
  const auto take = [&](SourceRange piece) {
    if (!all.has_value()) {
      all = piece;
      return;
    }
    blank(all.end, piece.begin);
    all.end = piece.end;
  };
  for (pugi::xml_node node = next_in_tree(element, element); node;
       node = next_in_tree(node, element)) {
    switch (node.type()) {
      case pugi::node_pcdata:
        decode(range(node));
        take(range(node));
        break;
      case pugi::node_cdata:
        take(range(node));
        break;
      case pugi::node_element:
        if (local_name(node) == "br") {
          take(range(node));
          blank(range(node).begin, range(node).end);
          (*readable_)[range(node).begin] = '\n';
        } else if (!is_typesetting(local_name(node))) {
          refuse(node);
          return {"", range(element)};
        }
        break;
      default:
        break;
    }
  }
  if (!all.has_value()) return {"", range(element)};
  return trimmed_text(all);
}

Text Xml::attribute(pugi::xml_node element, const char* name) const {
  const pugi::xml_attribute found = element.attribute(name);
  if (!found) return {"", range(element)};
  const SourceRange where = range(found, element);
  if (std::string_view(found.value()).empty()) return {"", where};
  decode(where);
  return trimmed_text(where);
}

void Xml::error(std::string_view code, pugi::xml_node node,
                std::string message) const {
  errors_->error(code, range(node), std::move(message));
}

void Xml::refuse(pugi::xml_node element) const {
  error("RP094", element,
        quoted_excerpt(local_name(element)) + " in " +
            quoted_excerpt(local_name(element.parent())) + " is not supported");
}

void Xml::allow_attributes(
    pugi::xml_node element,
    std::initializer_list<std::string_view> names) const {
  for (const pugi::xml_attribute attribute : element.attributes()) {
    const std::string_view name = attribute.name();
    if (name == "xmlns" || name.find(':') != std::string_view::npos) continue;
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    errors_->error("RP094", range(attribute, element),
                   "the attribute " + quoted_excerpt(name) + " of " +
                       quoted_excerpt(local_name(element)) +
                       " is not supported");
  }
}

std::string_view local_name(pugi::xml_node element) {
  const std::string_view name = element.name();
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

bool is_element(pugi::xml_node node) {
  return node.type() == pugi::node_element;
}

std::vector<pugi::xml_node> elements_of(pugi::xml_node node) {
  std::vector<pugi::xml_node> found;
  for (const pugi::xml_node child : node.children()) {
    if (is_element(child)) found.push_back(child);
  }
  return found;
}

pugi::xml_node child_named(pugi::xml_node node, std::string_view name) {
  for (const pugi::xml_node child : node.children()) {
    if (is_element(child) && local_name(child) == name) return child;
  }
  return {};
}

pugi::xml_node next_in_tree(pugi::xml_node node, pugi::xml_node root) {
  if (const pugi::xml_node child = node.first_child()) return child;
  while (node && node != root) {
    if (const pugi::xml_node sibling = node.next_sibling()) return sibling;
    node = node.parent();
  }
  return {};
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

bool is_identifier(std::string_view text) {
  const auto letter = [](char one) {
    return std::isalpha(static_cast<unsigned char>(one)) != 0 || one == '_';
  };
  return !text.empty() && letter(text.front()) &&
         std::all_of(text.begin(), text.end(), [&](char one) {
           return letter(one) || (one >= '0' && one <= '9');
         });
}

}  // namespace rung::plcopen
