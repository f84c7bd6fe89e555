#pragma once

#include <cstdint>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "backend/unit/contacts.h"

namespace rung::backend::plcopen {

/// `<name>` with a text for people, as the editors write it: as it is, so that
/// property lines keep their operators.
void put_note(pugi::xml_node parent, const char* name, const std::string& text);

/// Where something stands on the page: columns of contacts and rows of wires.
struct Cell {
  std::size_t column = 0;
  std::size_t row = 0;
};

/// An end that wires may begin at.
struct End {
  std::uint32_t id = 0;  // of its element
  std::string pin;       // of a block
  std::int64_t x = 0;
  std::int64_t y = 0;
};
/// What feeds an input; more than one are an OR. Empty: nothing does.
using Feed = std::vector<End>;

/// A pin of a block in the drawing.
struct BoxPin {
  std::string_view name;
  Feed feed;  // of an input
};

/// The body of a ladder diagram: writes elements with all of their geometry,
/// which some editors read the wires from.
class Page {
 public:
  /// `names`: the length of the longest; `columns`: of the widest rung.
  Page(pugi::xml_node body, std::size_t names, std::size_t columns);

  /// The rails of a rung begin here; each has one point in each row that
  /// needs one.
  void begin_rung(std::size_t row);
  End left_rail(std::size_t row);
  void right_rail(const End& coil);

  void comment(std::size_t row, const std::vector<std::string>& lines);
  End contact(Cell at, const std::string& name, bool negated, const Feed& feed);
  End coil(Cell at, const std::string& name, bool negated, Storage storage,
           const Feed& feed);
  End in_variable(Cell at, const std::string& expression);
  void out_variable(Cell at, const std::string& name, const Feed& feed);
  /// The ends of its outputs. Its pins are in the rows from `at` on.
  std::vector<End> box(Cell at, std::string_view type,
                       const std::string& instance,
                       const std::vector<BoxPin>& inputs,
                       const std::vector<std::string_view>& outputs);

 private:
  struct Rail {
    pugi::xml_node node;
    std::uint32_t id = 0;
    std::int64_t top = 0;
    std::int64_t x = 0;
    std::set<std::int64_t> points;
  };

  pugi::xml_node element(const char* name, std::int64_t x, std::int64_t y,
                         std::int64_t width, std::int64_t height);
  End relay(const char* kind, Cell at, const std::string& name, bool negated,
            const Feed& feed, Storage storage);
  void input(pugi::xml_node parent, std::int64_t x, std::int64_t y,
             std::int64_t element_x, std::int64_t element_y, const Feed& feed);
  void open_rail(Rail& rail, const char* name, std::int64_t x);
  static bool grow(Rail& rail, std::int64_t y);
  std::int64_t x_of(std::size_t column) const;

  pugi::xml_node body_;
  std::int64_t pitch_;
  std::int64_t right_;
  std::int64_t top_ = 0;
  std::uint32_t next_id_ = 0;
  Rail left_rail_;
  Rail right_rail_;
};

}  // namespace rung::backend::plcopen
