// Machine: what must be known of the whole text before it is executed.

#include <algorithm>
#include <array>
#include <set>

#include "frontend/stl/literals.h"
#include "frontend/stl/machine.h"

namespace rung::stl {
namespace {

std::uint32_t scope_of(const Block& block) {
  return block.kind == BlockKind::Function ? block.number + 1 : 0;
}

struct Started {
  std::string_view name;
  std::string_view kind;
};
constexpr std::array<Started, 5> kTimers = {{{"SI", "pulse-s7"},
                                             {"SV", "extended-pulse-s7"},
                                             {"SE", "delay-s7"},
                                             {"SS", "stored-delay-s7"},
                                             {"SA", "off-delay-s7"}}};

}  // namespace

const Block* Machine::find_block(BlockKind kind, std::uint32_t number) const {
  for (const Block& block : source_.blocks) {
    if (block.kind == kind && block.number == number) return &block;
  }
  return nullptr;
}

/// By the operators that only one of the two languages has.
void Machine::choose_mnemonics() {
  bool german = false;
  bool english = false;
  for (const Block& block : source_.blocks) {
    for (const Statement& statement : block.body) {
      if (statement.name == "SE") continue;
      const Operator* const op = find_operator(statement.name, Mnemonics::Both);
      if (op == nullptr) continue;
      german = german || op->mnemonics == Mnemonics::German;
      english = english || op->mnemonics == Mnemonics::English;
    }
  }
  if (german != english) {
    mnemonics_ = german ? Mnemonics::German : Mnemonics::English;
  }
}

void Machine::note_block(const Block& block) {
  // What the accumulator holds where a timer is started: the last load.
  std::optional<std::uint32_t> loaded;
  for (const Statement& statement : block.body) {
    const Operator* const op = find_operator(statement.name, mnemonics_);
    const bool check = op != nullptr && op->code == Code::Assert;
    for (const Operand& operand : statement.operands) {
      if (const auto address = address_of(operand.text, scope_of(block))) {
        memory_.note(*address);
      }
      sees_status_ = sees_status_ || operand.text == "STW" ||
                     (check && operand.text.starts_with("__STW"));
    }
    const bool stops = op != nullptr && op->code == Code::Call &&
                       !statement.operands.empty() &&
                       statement.operands[0].text == "SFC46";
    if (stops && stop_bit_.empty()) {
      stop_bit_ = writer_.make("stop", kBitCell, statement.where);
    }
    if (!statement.label.empty()) loaded.reset();
    if (op == nullptr || statement.operands.empty()) continue;
    if (op->code == Code::Load) {
      loaded = literal_of(statement.operands[0].text);
    } else if (op->code == Code::Timer) {
      note_timer(statement, *op, loaded);
    }
  }
}

void Machine::note_timer(const Statement& statement, const Operator& op,
                         std::optional<std::uint32_t> loaded) {
  const auto preset = loaded ? s5time_of(*loaded) : std::nullopt;
  if (!preset) {
    return fail("RP045", statement.where,
                "the time must be a constant that is loaded above, such as "
                "`L S5T#2S`");
  }
  const auto* const started =
      std::find_if(kTimers.begin(), kTimers.end(),
                   [&](const Started& row) { return row.name == op.element; });
  const auto [entry, is_new] = counted_.try_emplace(
      statement.operands[0].text,
      Counted{started->kind, op.element, {}, preset, statement.where});
  const Counted& first = entry->second;
  if (is_new || (first.kind == started->kind && first.preset == preset)) return;
  broken_ = true;
  errors_.error("RP045", statement.where,
                "this timer is started in two ways or with two times: that is "
                "not supported",
                {{first.where, "it is started here, too"}});
}

bool Machine::prepare() {
  choose_mnemonics();
  std::set<std::pair<BlockKind, std::uint32_t>> seen;
  for (const Block& block : source_.blocks) {
    const bool known = block.kind == BlockKind::Function || block.number == 1 ||
                       block.number == 100;
    if (!known) {
      fail("RP041", block.where,
           "OB " + std::to_string(block.number) +
               " is not supported: OB 1 and OB 100 are");
    }
    if (!seen.emplace(block.kind, block.number).second) {
      fail("RP042", block.where, "there are two blocks of this number");
    }
    if (block.kind == BlockKind::Function) {
      functions_.emplace("FC" + std::to_string(block.number), &block);
    }
    note_block(block);
  }
  return !broken_;
}

}  // namespace rung::stl
