#include "analysis/rules/twin.h"

#include <algorithm>
#include <random>

#include "analysis/rules/support.h"
#include "analysis/simulator.h"

namespace rung {
namespace {

class SideBySide {
 public:
  SideBySide(const Program& one, const Program& other, std::uint64_t work)
      : program_(one), one_(one), other_(other) {
    scans_ = work / (one.nodes.size() + other.nodes.size() + 1);
    for (const CellId id : ids_of(one.cells)) {
      const Cell& cell = one.cells[id];
      if (cell.role == CellRole::Input) inputs_.push_back(id);
      if (cell.role == CellRole::Output) compared_.push_back(id);
    }
    if (!compared_.empty()) return;
    for (const CellId id : ids_of(one.cells)) {
      if (!one.cells[id].made) compared_.push_back(id);
    }
  }

  std::optional<Parting> search(std::int64_t hold_ms) {
    constexpr unsigned kChoices = 8;  // of inputs in one run, then a new one
    values_.resize(inputs_.size());
    while (scans_ > 0) {
      one_.reset();
      other_.reset();
      for (std::size_t i = 0; i < inputs_.size(); ++i) {
        values_[i] = program_.cells[inputs_[i]].initial;
      }
      for (unsigned k = 0; k < kChoices && scans_ > 0; ++k) {
        choose();
        if (run(1 + random_() % 3, 0) || run(0, hold_ms)) return parting();
      }
    }
    return std::nullopt;
  }

 private:
  void choose() {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const Cell& cell = program_.cells[inputs_[i]];
      const auto span = static_cast<std::uint64_t>(cell.high - cell.low) + 1;
      if (random_() % 2 == 0) {
        values_[i] = cell.low + static_cast<std::int64_t>(random_() % span);
      }
      one_.set_input(inputs_[i], values_[i]);
      other_.set_input(inputs_[i], values_[i]);
    }
    const ScanInterval& scan = program_.scan;
    const auto span = static_cast<std::uint64_t>(scan.max_ms - scan.min_ms) + 1;
    dt_ms_ = scan.min_ms + static_cast<std::int64_t>(random_() % span);
  }

  /// `count` scans, and as many as it takes until `ms` have passed. True when
  /// the programs part.
  bool run(std::uint64_t count, std::int64_t ms) {
    const std::int64_t end_ms = one_.now_ms() + ms;
    for (; count > 0 || one_.now_ms() < end_ms; count -= count > 0 ? 1 : 0) {
      if (scans_ == 0) return false;
      --scans_;
      one_.scan(dt_ms_);
      other_.scan(dt_ms_);
      if (differs()) return true;
      const std::int64_t left = (end_ms - one_.now_ms()) / dt_ms_;
      const std::uint64_t idle = std::min(
          {one_.idle_scans(dt_ms_), other_.idle_scans(dt_ms_),
           static_cast<std::uint64_t>(std::max<std::int64_t>(left, 0))});
      one_.skip(idle, dt_ms_);
      other_.skip(idle, dt_ms_);
    }
    return false;
  }

  bool differs() {
    const auto found = std::find_if(
        compared_.begin(), compared_.end(),
        [&](CellId cell) { return one_.value(cell) != other_.value(cell); });
    if (found == compared_.end()) return false;
    parted_ = *found;
    return true;
  }

  Parting parting() const {
    Parting parting{one_.scans(),        one_.now_ms(),         parted_,
                    one_.value(parted_), other_.value(parted_), {}};
    parting.inputs.reserve(inputs_.size());
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      parting.inputs.emplace_back(inputs_[i], values_[i]);
    }
    return parting;
  }

  const Program& program_;
  Simulator one_;
  Simulator other_;
  std::mt19937_64 random_{20200712};
  std::vector<CellId> inputs_;
  std::vector<CellId> compared_;
  std::vector<std::int64_t> values_;  // of inputs_
  std::int64_t dt_ms_ = 1;
  std::uint64_t scans_ = 0;  // left
  CellId parted_;
};

}  // namespace

std::optional<Parting> find_parting(const Program& one, const Program& other,
                                    std::int64_t hold_ms, std::uint64_t work) {
  return SideBySide(one, other, work).search(hold_ms);
}

std::string parting_text(const Program& program, const Parting& parting) {
  constexpr std::size_t kFew = 6;
  std::string text = "seen in scan " + std::to_string(parting.scan) +
                     " of a run, after " + std::to_string(parting.now_ms) +
                     " ms";
  std::size_t shown = 0;
  for (const auto& [cell, value] : parting.inputs) {
    if (program.cells[cell].made || shown == kFew) continue;
    text += (shown++ == 0 ? ", with " : ", ") + quoted(program, cell) + " = " +
            std::to_string(value);
  }
  return text;
}

}  // namespace rung
