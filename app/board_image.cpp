#include "app/board_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "app/controller.h"
#include "app/link_client.h"
#include "base/postfix_format.h"
#include "reports/unicode.h"

namespace rung {
namespace {

// Of a frame of monitor mode: docs/link.md.
constexpr std::size_t kScan = 2;
constexpr std::size_t kDt = 6;
constexpr std::size_t kProgram = 10;
constexpr std::size_t kFirst = 12;
constexpr std::size_t kHead = 16;

std::string_view role_name(rungproof::Role role) {
  switch (role) {
    case rungproof::Role::Input:
      return "input";
    case rungproof::Role::Output:
      return "output";
    case rungproof::Role::Memory:
      break;
  }
  return "memory";
}

std::string value_text(const BoardImage::Cell& cell) {
  return cell.value ? std::to_string(*cell.value) : "?";
}

}  // namespace

BoardImage::BoardImage(const std::string& program) {
  LoadedMachine loaded(program);
  if (loaded.refusal != rungproof::Refusal::None) return;
  rungproof::Machine& machine = loaded.machine;
  bits_ = machine.bit_count();
  checksum_ = frame_number_at(program, postfix::ChecksumField);
  cells_.resize(machine.cell_count());
  std::array<char, postfix::kMaxName> name{};
  for (std::uint32_t i = 0; i < cells_.size(); ++i) {
    const std::uint8_t size =
        machine.name(i, name.data(), static_cast<std::uint8_t>(name.size()));
    cells_[i].name.assign(name.data(), size);
    cells_[i].role = machine.role(i);
  }
}

bool BoardImage::take(std::string_view frame) {
  if (frame.size() < kHead) return false;
  const std::uint32_t range = frame_number_at(frame, kFirst);
  const std::size_t first = range & 0xffffU;
  const std::size_t end = first + (range >> 16);
  const std::size_t bits = std::clamp<std::size_t>(bits_, first, end) - first;
  const std::size_t packed = (bits + 7) / 8;
  const bool fits = end <= cells_.size() &&
                    frame.size() - kHead == packed + 4 * (end - first - bits);
  if (!fits ||
      (frame_number_at(frame, kProgram) & 0xffffU) != (checksum_ & 0xffffU)) {
    return false;
  }
  scan_ = frame_number_at(frame, kScan);
  dt_ = frame_number_at(frame, kDt);
  for (std::size_t i = 0; i < bits; ++i) {
    const auto byte = static_cast<unsigned char>(frame[kHead + i / 8]);
    cells_[first + i].value = (byte >> i % 8) & 1;
  }
  for (std::size_t i = first + bits; i < end; ++i) {
    const std::size_t at = kHead + packed + 4 * (i - first - bits);
    cells_[i].value = static_cast<std::int32_t>(frame_number_at(frame, at));
  }
  // A part that was lost: the image waits for the next round.
  const bool follows = first == 0 || first == next_;
  whole_ = follows && end == cells_.size();
  next_ = follows && !whole_ ? end : cells_.size() + 1;
  return true;
}

std::string image_json(const BoardImage& image) {
  nlohmann::ordered_json values = nlohmann::ordered_json::object();
  for (const BoardImage::Cell& cell : image.cells()) {
    if (cell.value) values[valid_utf8(cell.name)] = *cell.value;
  }
  const nlohmann::ordered_json all = {{"scan", image.scan()},
                                      {"dt_ms", image.dt_ms()},
                                      {"values", std::move(values)}};
  return all.dump() + "\n";
}

std::string image_line(const BoardImage& image) {
  std::string line =
      fmt::format("scan {}, {} ms:", image.scan(), image.dt_ms());
  for (const BoardImage::Cell& cell : image.cells()) {
    line += fmt::format(" {}={}", printable(cell.name), value_text(cell));
  }
  return line + "\n";
}

std::string image_table(const BoardImage& image) {
  std::size_t width = 0;
  for (const BoardImage::Cell& cell : image.cells()) {
    width = std::max(width, printable_width(cell.name));
  }
  std::string table =
      fmt::format("scan {}, {} ms\x1b[K\n", image.scan(), image.dt_ms());
  for (const BoardImage::Cell& cell : image.cells()) {
    table += fmt::format("  {}{}  {:6} {:>11}\x1b[K\n", printable(cell.name),
                         std::string(width - printable_width(cell.name), ' '),
                         role_name(cell.role), value_text(cell));
  }
  return table;
}

}  // namespace rung
