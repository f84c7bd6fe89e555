#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rungproof_machine.h"

namespace rung {

/// The cells of a running program, as monitor mode shows them.
class BoardImage {
 public:
  struct Cell {
    std::string name;
    rungproof::Role role = rungproof::Role::Memory;
    std::optional<std::int32_t> value;  // none: not shown yet
  };

  /// `program`: bytes that a verifier has accepted; else there are no cells.
  explicit BoardImage(const std::string& program);

  /// Takes a frame of monitor mode over. False: it is none, or one of another
  /// program.
  bool take(std::string_view frame);
  /// Whether the last frame has completed the image; a long one comes in
  /// parts, each of the scan after that of the part before.
  bool whole() const { return whole_; }

  std::uint32_t scan() const { return scan_; }
  std::uint32_t dt_ms() const { return dt_; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  std::vector<Cell> cells_;
  std::uint32_t bits_ = 0;
  std::uint32_t checksum_ = 0;
  std::uint32_t scan_ = 0;
  std::uint32_t dt_ = 0;
  std::size_t next_ = 0;  // the cell that a part must begin with
  bool whole_ = false;
};

/// `{"scan":1,"dt_ms":10,"values":{"a":1}}`, a line.
std::string image_json(const BoardImage& image);
/// The same to be read: a line, or a table of `image.cells().size() + 1`.
std::string image_line(const BoardImage& image);
std::string image_table(const BoardImage& image);

}  // namespace rung
