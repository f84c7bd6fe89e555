#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "backend/unit/contacts.h"
#include "backend/unit/network.h"
#include "backend/unit/unit.h"

namespace rung::backend::plcopen {

/// The pins of a block or a function, as editors know them.
struct PinNames {
  std::string_view type;  // "TON"
  std::vector<std::string_view> inputs;
  std::vector<std::string_view> outputs;
};
const PinNames& pins_of(std::string_view block);

/// What feeds a pin of a block: contacts in one row, or a number.
struct Input {
  std::string_view pin;
  Network power;  // a contact or a series of them, or a constant
  Terms word;     // else: a variable or a literal
};

/// Where an output of a block goes.
struct Output {
  std::string_view pin;
  CellId target;
};

/// What is drawn as one: whatever it reads, it writes one sink, or the outputs
/// of one block.
struct Rung {
  enum class Kind : std::uint8_t {
    Coil,     // target := power, or `storage` where there is power
    Compare,  // target := word, a comparison
    Word,     // target := word
    Call,
  };
  Kind kind = Kind::Coil;
  RungId source;
  CellId target;
  Network power;
  Storage storage = Storage::None;
  Terms word;
  Terms enable;  // Word, Call: a contact or a constant; empty: always
  BlockId block;
  std::optional<std::int64_t> preset;  // ms, of a timer
  std::vector<Input> inputs;
  std::vector<Output> outputs;
};

/// The statements of a unit as rungs, in their order. Pins that the unit reads
/// or assigns become variables. Contacts hold no comparisons and boxes stand
/// behind one row of contacts: what is more has a bit or a word of its own.
/// Linear, no recursion.
std::vector<Rung> make_rungs(Unit& unit);

}  // namespace rung::backend::plcopen
