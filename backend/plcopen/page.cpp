#include "backend/plcopen/page.h"

#include <algorithm>

namespace rung::backend::plcopen {
namespace {

using pugi::xml_node;

// In the units of the drawing. A row is as high as the distance of two pins.
constexpr std::int64_t kRow = 40;
constexpr std::int64_t kMargin = 40;
constexpr std::int64_t kRailWidth = 10;
constexpr std::int64_t kRelay = 20;   // a contact or a coil, in both directions
constexpr std::int64_t kCorner = 20;  // of a wire, before what it leads to
constexpr std::int64_t kLetter = 8;
constexpr std::int64_t kWidest = 400;

std::int64_t y_of(std::size_t row) {
  return kMargin + static_cast<std::int64_t>(row) * kRow;
}

void put_point(xml_node parent, const char* name, std::int64_t x,
               std::int64_t y) {
  xml_node point = parent.append_child(name);
  point.append_attribute("x") = x;
  point.append_attribute("y") = y;
}

void put_output(xml_node parent, std::int64_t x, std::int64_t y,
                bool of_rail = false) {
  xml_node out = parent.append_child("connectionPointOut");
  if (of_rail) out.append_attribute("formalParameter") = "";
  put_point(out, "relPosition", x, y);
}

void put_text(xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).text().set(text.c_str());
}

}  // namespace

void put_note(xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name)
      .append_child("xhtml:p")
      .append_child(pugi::node_cdata)
      .set_value(text.c_str());
}

Page::Page(xml_node body, std::size_t names, std::size_t columns)
    : body_(body),
      pitch_(std::clamp<std::int64_t>(
          (static_cast<std::int64_t>(names) * kLetter / 10 + 6) * 10, 120,
          kWidest)),
      right_(x_of(columns)) {}

std::int64_t Page::x_of(std::size_t column) const {
  return 2 * kMargin + static_cast<std::int64_t>(column) * pitch_;
}

xml_node Page::element(const char* name, std::int64_t x, std::int64_t y,
                       std::int64_t width, std::int64_t height) {
  xml_node node = body_.append_child(name);
  node.append_attribute("localId") = ++next_id_;
  node.append_attribute("height") = height;
  node.append_attribute("width") = width;
  put_point(node, "position", x, y);
  return node;
}

// --- rails -------------------------------------------------------------------

void Page::begin_rung(std::size_t row) {
  top_ = y_of(row) - kRow / 2;
  left_rail_ = {};
  right_rail_ = {};
}

void Page::open_rail(Rail& rail, const char* name, std::int64_t x) {
  rail.node = element(name, x, top_, kRailWidth, kRow);
  rail.id = next_id_;
  rail.top = top_;
  rail.x = x;
}

/// Whether this is a new point of the rail.
bool Page::grow(Rail& rail, std::int64_t y) {
  const bool fresh = rail.points.insert(y).second;
  rail.node.attribute("height") = *rail.points.rbegin() - rail.top + kRow / 2;
  return fresh;
}

End Page::left_rail(std::size_t row) {
  if (left_rail_.id == 0) open_rail(left_rail_, "leftPowerRail", kMargin);
  const std::int64_t y = y_of(row);
  if (grow(left_rail_, y)) {
    put_output(left_rail_.node, kRailWidth, y - left_rail_.top, true);
  }
  return {left_rail_.id, "", left_rail_.x + kRailWidth, y};
}

void Page::right_rail(const End& coil) {
  if (right_rail_.id == 0) open_rail(right_rail_, "rightPowerRail", right_);
  grow(right_rail_, coil.y);
  input(right_rail_.node, right_, coil.y, right_, right_rail_.top, {coil});
}

// --- elements ----------------------------------------------------------------

/// A `connectionPointIn` at x, y; wires have their corners right before it.
void Page::input(xml_node parent, std::int64_t x, std::int64_t y,
                 std::int64_t element_x, std::int64_t element_y,
                 const Feed& feed) {
  xml_node point = parent.append_child("connectionPointIn");
  put_point(point, "relPosition", x - element_x, y - element_y);
  for (const End& end : feed) {
    xml_node wire = point.append_child("connection");
    wire.append_attribute("refLocalId") = end.id;
    if (!end.pin.empty()) {
      wire.append_attribute("formalParameter") = end.pin.c_str();
    }
    put_point(wire, "position", x, y);
    if (end.y != y) {
      put_point(wire, "position", x - kCorner, y);
      put_point(wire, "position", x - kCorner, end.y);
    }
    put_point(wire, "position", end.x, end.y);
  }
}

void Page::comment(std::size_t row, const std::vector<std::string>& lines) {
  std::size_t longest = 10;
  std::string text;
  for (const std::string& line : lines) {
    longest = std::max(longest, line.size());
    if (!text.empty()) text += '\n';
    text += line;
  }
  const auto width = static_cast<std::int64_t>(longest + 2) * kLetter;
  const auto height = static_cast<std::int64_t>(lines.size()) * kRow / 2 + 10;
  xml_node node =
      element("comment", kMargin, y_of(row) - kRow / 2, width, height);
  put_note(node, "content", text);
}

End Page::relay(const char* kind, Cell at, const std::string& name,
                bool negated, const Feed& feed, Storage storage) {
  const std::int64_t x = x_of(at.column) + (pitch_ - kRelay) / 20 * 10;
  const std::int64_t y = y_of(at.row);
  const std::int64_t top = y - kRelay / 2;
  xml_node node = element(kind, x, top, kRelay, kRelay);
  node.append_attribute("negated") = negated;
  if (storage != Storage::None) {
    node.append_attribute("storage") =
        storage == Storage::Set ? "set" : "reset";
  }
  input(node, x, y, x, top, feed);
  put_output(node, kRelay, kRelay / 2);
  put_text(node, "variable", name);
  return {next_id_, "", x + kRelay, y};
}

End Page::contact(Cell at, const std::string& name, bool negated,
                  const Feed& feed) {
  return relay("contact", at, name, negated, feed, Storage::None);
}

End Page::coil(Cell at, const std::string& name, bool negated, Storage storage,
               const Feed& feed) {
  return relay("coil", at, name, negated, feed, storage);
}

End Page::in_variable(Cell at, const std::string& expression) {
  const std::int64_t x = x_of(at.column) + kCorner;
  const std::int64_t width = pitch_ - 2 * kCorner;
  const std::int64_t y = y_of(at.row);
  xml_node node = element("inVariable", x, y - kRelay / 2, width, kRelay);
  node.append_attribute("negated") = false;
  put_output(node, width, kRelay / 2);
  put_text(node, "expression", expression);
  return {next_id_, "", x + width, y};
}

void Page::out_variable(Cell at, const std::string& name, const Feed& feed) {
  const std::int64_t x = x_of(at.column) + kCorner;
  const std::int64_t y = y_of(at.row);
  const std::int64_t top = y - kRelay / 2;
  xml_node node = element("outVariable", x, top, pitch_ - 2 * kCorner, kRelay);
  node.append_attribute("negated") = false;
  input(node, x, y, x, top, feed);
  put_text(node, "expression", name);
}

std::vector<End> Page::box(Cell at, std::string_view type,
                           const std::string& instance,
                           const std::vector<BoxPin>& inputs,
                           const std::vector<std::string_view>& outputs) {
  const std::int64_t x = x_of(at.column) + kCorner;
  const std::int64_t width = pitch_ - 2 * kCorner;
  const std::int64_t top = y_of(at.row) - kRow;
  const auto rows =
      static_cast<std::int64_t>(std::max(inputs.size(), outputs.size()));
  xml_node node = element("block", x, top, width, rows * kRow + kRow / 2);
  node.append_attribute("typeName") = std::string(type).c_str();
  if (!instance.empty()) {
    node.append_attribute("instanceName") = instance.c_str();
  }
  xml_node list = node.append_child("inputVariables");
  std::int64_t y = top;
  for (const BoxPin& pin : inputs) {
    y += kRow;
    xml_node variable = list.append_child("variable");
    variable.append_attribute("formalParameter") =
        std::string(pin.name).c_str();
    input(variable, x, y, x, top, pin.feed);
  }
  node.append_child("inOutVariables");
  list = node.append_child("outputVariables");
  std::vector<End> ends;
  y = top;
  for (const std::string_view pin : outputs) {
    y += kRow;
    xml_node variable = list.append_child("variable");
    variable.append_attribute("formalParameter") = std::string(pin).c_str();
    put_output(variable, width, y - top);
    ends.push_back({next_id_, std::string(pin), x + width, y});
  }
  return ends;
}

}  // namespace rung::backend::plcopen
