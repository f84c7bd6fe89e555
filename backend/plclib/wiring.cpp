#include "backend/plclib/wiring.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace rung::backend {
namespace {

constexpr std::size_t kUnoDigital = 12;  // 2 to 13: 0 and 1 are the serial line
constexpr std::size_t kUnoAnalog = 6;
constexpr std::size_t kMegaDigital = 44;  // and 22 to 53
constexpr std::size_t kAnalog = 8;

template <class Visit>
void for_each_terms(Statement& statement, Visit visit) {
  visit(statement.guard);
  visit(statement.value);
  for (Argument& argument : statement.arguments) visit(argument.value);
}

class Wirer {
 public:
  explicit Wirer(Unit& unit) : unit_(unit) {}

  Wiring run() {
    count_reads();
    find_samples();
    sample_inputs();
    count_reads();  // images instead of inputs
    assign_pins();
    return std::move(wiring_);
  }

 private:
  void count_reads() {
    wiring_.reads.assign(unit_.variables.size(), 0);
    for (Statement& statement : unit_.statements) {
      for_each_terms(statement, [&](const Terms& terms) {
        for (const Term& term : terms) {
          if (term.op == NodeOp::Read) ++wiring_.reads[term.cell.index()];
        }
      });
    }
  }

  /// `X0.2`, `X0.3` and so on are samples of `X0` when none is missing.
  void find_samples() {
    std::unordered_map<std::string_view, CellId> inputs;
    for (const CellId id : ids_of(unit_.variables)) {
      const Variable& variable = unit_.variables[id];
      if (variable.role != CellRole::Input) continue;
      inputs.emplace(variable.source, id);
      const std::size_t dot = variable.source.rfind('.');
      const auto base =
          dot == std::string::npos
              ? inputs.end()
              : inputs.find(std::string_view(variable.source).substr(0, dot));
      if (base == inputs.end()) continue;
      std::vector<CellId>& later = later_[base->second.index()];
      const std::string number = std::to_string(later.size() + 2);
      const bool next = variable.source.substr(dot + 1) == number &&
                        variable.type == unit_.variables[base->second].type;
      if (!next) continue;
      later.push_back(id);
      is_sample_.resize(unit_.variables.size(), false);
      is_sample_[id.index()] = true;
    }
    is_sample_.resize(unit_.variables.size(), false);
  }

  void sample_inputs() {
    std::unordered_map<std::uint32_t, CellId> images;
    const auto sample = [&](CellId input, CellId pin) {
      const bool read = wiring_.reads[input.index()] != 0;
      CellId image;
      if (read) {
        const Variable& variable = unit_.variables[input];
        image = unit_.variables.add(
            {.name = unit_.names.add(variable.name + "_now"),
             .type = variable.type});
        images.emplace(input.index(), image);
      }
      wiring_.samples.push_back({pin, image});
    };
    const std::size_t count = unit_.variables.size();
    for (std::uint32_t at = 0; at < count; ++at) {
      const CellId id(at);
      if (unit_.variables[id].role != CellRole::Input || is_sample_[at]) {
        continue;
      }
      const auto later = later_.find(at);
      // What is read in one place is sampled there.
      if (later == later_.end() && wiring_.reads[at] == 1) continue;
      sample(id, id);
      if (later == later_.end()) continue;
      for (std::size_t i = 0; i < later->second.size(); ++i) {
        sample(later->second[i], id);
        unit_.variables[later->second[i]].name =
            unit_.variables[id].name + "." + std::to_string(i + 2);
      }
    }
    for (Statement& statement : unit_.statements) {
      for_each_terms(statement, [&](Terms& terms) {
        for (Term& term : terms) {
          const auto image = term.op == NodeOp::Read
                                 ? images.find(term.cell.index())
                                 : images.end();
          if (image != images.end()) term.cell = image->second;
        }
      });
    }
  }

  // --- pins ------------------------------------------------------------------

  bool has_pin(CellId id) const {
    const bool sample =
        id.index() < is_sample_.size() && is_sample_[id.index()];
    return unit_.variables[id].role != CellRole::Memory && !sample;
  }

  void assign_pins() {
    wiring_.pins.resize(unit_.variables.size());
    std::vector<CellId> digital;
    std::vector<CellId> analog;
    for (const CellRole role : {CellRole::Input, CellRole::Output}) {
      for (const CellId id : ids_of(unit_.variables)) {
        if (!has_pin(id) || unit_.variables[id].role != role) continue;
        const bool word = unit_.variables[id].type == Type::Word;
        (word ? analog : digital).push_back(id);
      }
    }
    const std::size_t spare = kUnoAnalog - std::min(kUnoAnalog, analog.size());
    wiring_.mega =
        analog.size() > kUnoAnalog || digital.size() > kUnoDigital + spare;
    if (analog.size() > kAnalog || digital.size() > kMegaDigital) {
      wiring_.error = "there are " + std::to_string(digital.size()) +
                      " bits and " + std::to_string(analog.size()) +
                      " words of inputs and outputs: up to " +
                      std::to_string(kMegaDigital) + " and " +
                      std::to_string(kAnalog) + " are supported";
      return;
    }
    std::vector<std::string> free;
    for (int pin = 2; pin < 14; ++pin) free.push_back(std::to_string(pin));
    for (int pin = 22; wiring_.mega && pin < 54; ++pin) {
      free.push_back(std::to_string(pin));
    }
    std::vector<std::string> free_analog;
    for (std::size_t pin = 0; pin < kAnalog; ++pin) {
      free_analog.push_back("A" + std::to_string(pin));
    }
    give(analog, free_analog);
    free_analog.resize(free_analog.size() -
                       (kAnalog - kUnoAnalog) * (wiring_.mega ? 0 : 1));
    if (!wiring_.mega) {
      free.insert(free.end(), free_analog.begin(), free_analog.end());
    }
    give(digital, free);
  }

  /// `pin4` is pin 4 and `A0` is A0 where that is free.
  void give(const std::vector<CellId>& signals,
            std::vector<std::string>& free) {
    for (const bool named : {true, false}) {
      for (const CellId id : signals) {
        std::string& pin = wiring_.pins[id.index()];
        if (!pin.empty()) continue;
        std::string_view wanted = unit_.variables[id].source;
        if (wanted.starts_with("pin")) wanted.remove_prefix(3);
        const auto place =
            named ? std::find(free.begin(), free.end(), wanted) : free.begin();
        if (place == free.end()) continue;
        pin = *place;
        free.erase(place);
      }
    }
  }

  Unit& unit_;
  Wiring wiring_;
  std::unordered_map<std::uint32_t, std::vector<CellId>> later_;
  std::vector<bool> is_sample_;
};

}  // namespace

Wiring wire(Unit& unit) { return Wirer(unit).run(); }

}  // namespace rung::backend
