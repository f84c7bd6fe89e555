#include "tests/reports/page_check.h"

#include <libxml/parser.h>
#include <libxml/tree.h>

#include <memory>
#include <set>
#include <vector>

#include "reports/assets.h"

namespace rung::test {
namespace {

const std::set<std::string> kElements = {
    // HTML
    "html", "head", "meta", "title", "style", "body", "header", "main",
    "section", "article", "details", "summary", "h1", "h2", "h3", "h4", "p",
    "ul", "li", "a", "b", "strong", "span", "code", "pre", "div", "table",
    "thead", "tbody", "tr", "th", "td", "figure", "figcaption", "script",
    // SVG
    "svg", "g", "rect", "path", "text"};

const std::set<std::string> kAttributes = {
    "lang", "charset", "http-equiv", "content", "name", "class", "id", "href",
    "scope", "role", "tabindex", "open", "aria-label", "aria-labelledby",
    "type", "data-rung", "data-name", "data-net", "data-kind", "data-from",
    "data-to", "data-behind",
    // SVG
    "width", "height", "viewBox", "transform", "x", "y", "d"};

std::string text_of(const xmlChar* text) {
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

class Check {
 public:
  std::string run(const std::string& page) {
    const std::unique_ptr<xmlDoc, decltype(&xmlFreeDoc)> document(
        xmlReadMemory(page.data(), static_cast<int>(page.size()), "page",
                      nullptr,
                      XML_PARSE_NONET | XML_PARSE_NOERROR |
                          XML_PARSE_NOWARNING | XML_PARSE_HUGE),
        &xmlFreeDoc);
    if (!document) {
      const xmlError* error = xmlGetLastError();
      return "line " + std::to_string(error->line) + ": " + error->message;
    }
    for (const xmlNode* node = xmlDocGetRootElement(document.get());
         node != nullptr; node = next(node)) {
      if (node->type == XML_ELEMENT_NODE) look_at(*node);
    }
    for (const std::string& link : links_) {
      const bool is_local = link.starts_with("#") && ids_.count(link.substr(1));
      if (!is_local) problems_ += "a link to " + link + "\n";
    }
    return problems_;
  }

 private:
  /// In the order of the text.
  static const xmlNode* next(const xmlNode* node) {
    if (node->children != nullptr) return node->children;
    while (node != nullptr && node->next == nullptr) node = node->parent;
    return node == nullptr ? nullptr : node->next;
  }

  void look_at(const xmlNode& element) {
    const std::string name = text_of(element.name);
    if (kElements.count(name) == 0) problems_ += "an element " + name + "\n";
    for (const xmlAttr* a = element.properties; a != nullptr; a = a->next) {
      const std::string attribute = text_of(a->name);
      const std::string value =
          a->children == nullptr ? "" : text_of(a->children->content);
      if (kAttributes.count(attribute) == 0) {
        problems_ += "an attribute " + attribute + "\n";
      }
      if (attribute == "href") links_.push_back(value);
      if (attribute == "id" && !ids_.insert(value).second) {
        problems_ += "two elements with the id " + value + "\n";
      }
    }
    if (name == "style") check_style(element);
    if (name == "script") check_script(element);
  }

  /// Data, or the page's own script: nothing else runs.
  void check_script(const xmlNode& element) {
    const std::unique_ptr<xmlChar, void (*)(void*)> type(
        xmlGetProp(&element, reinterpret_cast<const xmlChar*>("type")),
        [](void* text) { xmlFree(text); });
    if (type != nullptr && text_of(type.get()) == "application/json") return;
    const std::unique_ptr<xmlChar, void (*)(void*)> text(
        xmlNodeGetContent(&element), [](void* bytes) { xmlFree(bytes); });
    std::string own(kPageScript.text);
    for (const std::string marker : {"<![CDATA[", "]]>"}) {
      own.erase(own.find(marker), marker.size());
    }
    if (type != nullptr || text_of(text.get()) != own) {
      problems_ += "a script that is not the page's own\n";
    }
  }

  void check_style(const xmlNode& element) {
    const std::string style =
        element.children == nullptr ? "" : text_of(element.children->content);
    for (const char* loads : {"url", "@import"}) {
      if (style.find(loads) != std::string::npos) {
        problems_ += std::string("a style with ") + loads + "\n";
      }
    }
  }

  std::string problems_;
  std::set<std::string> ids_;
  std::vector<std::string> links_;
};

}  // namespace

std::string problems_of(const std::string& page) { return Check().run(page); }

}  // namespace rung::test
