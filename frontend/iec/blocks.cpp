#include "frontend/iec/blocks.h"

#include <algorithm>
#include <array>

namespace rung::iec {
namespace {

constexpr std::array<Pin, 2> kTimerInputs = {{{"IN"}, {"PT", &kTime}}};
constexpr std::array<Pin, 2> kTimerOutputs = {{{"Q"}, {"ET", &kTime}}};
constexpr std::array<Pin, 3> kUpInputs = {{{"CU"}, {"R"}, {"PV", &kInt}}};
constexpr std::array<Pin, 3> kDownInputs = {{{"CD"}, {"LD"}, {"PV", &kInt}}};
constexpr std::array<Pin, 2> kCounterOutputs = {{{"Q"}, {"CV", &kInt}}};
constexpr std::array<Pin, 5> kUpDownInputs = {
    {{"CU"}, {"CD"}, {"R"}, {"LD"}, {"PV", &kInt}}};
constexpr std::array<Pin, 3> kUpDownOutputs = {{{"QU"}, {"QD"}, {"CV", &kInt}}};
constexpr std::array<Pin, 1> kTriggerInputs = {{{"CLK"}}};
constexpr std::array<Pin, 1> kTriggerOutputs = {{{"Q"}}};
constexpr std::array<Pin, 2> kSetInputs = {{{"S1"}, {"R"}}};
constexpr std::array<Pin, 2> kResetInputs = {{{"S"}, {"R1"}}};
constexpr std::array<Pin, 1> kLatchOutputs = {{{"Q1"}}};

constexpr std::string_view kTimers = "matiec esbmc";
constexpr std::string_view kCounters = "matiec";

constexpr std::array<Block, 10> kBlocks = {{
    {"CTD", "ctd", kCounters, kDownInputs, kCounterOutputs},
    {"CTU", "ctu", kCounters, kUpInputs, kCounterOutputs},
    {"CTUD", "ctud", kCounters, kUpDownInputs, kUpDownOutputs},
    {"F_TRIG", "f-trig", "esbmc", kTriggerInputs, kTriggerOutputs},
    {"RS", "rs", {}, kResetInputs, kLatchOutputs},
    {"R_TRIG", "r-trig", {}, kTriggerInputs, kTriggerOutputs},
    {"SR", "sr", {}, kSetInputs, kLatchOutputs},
    {"TOF", "tof", kTimers, kTimerInputs, kTimerOutputs},
    {"TON", "ton", kTimers, kTimerInputs, kTimerOutputs},
    {"TP", "tp", kTimers, kTimerInputs, kTimerOutputs},
}};

}  // namespace

std::string Block::element_id(std::string_view dialect) const {
  // Whole words: `iec` is none of `matiec esbmc`.
  const bool has_own =
      !dialect.empty() &&
      (" " + std::string(own) + " ").find(" " + std::string(dialect) + " ") !=
          std::string::npos;
  return std::string(element) + (has_own ? "-" + std::string(dialect) : "");
}

std::span<const Block> blocks() { return kBlocks; }

const Block* find_block(std::string_view upper_name) {
  const auto* const found = std::find_if(
      kBlocks.begin(), kBlocks.end(),
      [&](const Block& block) { return block.name == upper_name; });
  return found == kBlocks.end() ? nullptr : found;
}

std::vector<std::string_view> block_names() {
  std::vector<std::string_view> names;
  names.reserve(kBlocks.size());
  for (const Block& block : kBlocks) names.push_back(block.name);
  return names;
}

const Pin* find_pin(std::span<const Pin> pins, std::string_view upper_name) {
  const auto found =
      std::find_if(pins.begin(), pins.end(),
                   [&](const Pin& pin) { return pin.name == upper_name; });
  return found == pins.end() ? nullptr : &*found;
}

std::string pin_list(const Block& block) {
  std::string text;
  for (const std::span<const Pin> pins : {block.inputs, block.outputs}) {
    for (const Pin& pin : pins) {
      text += (text.empty() ? "" : " ") + std::string(pin.name);
    }
  }
  return text;
}

}  // namespace rung::iec
