#include "frontend/il_mitsubishi/devices.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "frontend/token_list.h"

namespace rung::melsec {
namespace {

constexpr std::uint32_t kAlwaysOn = 8000;
constexpr std::uint32_t kAlwaysOff = 8001;
constexpr std::uint32_t kFirstScan = 8002;
constexpr std::uint32_t kNotFirstScan = 8003;
constexpr std::uint32_t kSecondClock = 8013;

/// Numbers of the FX3 family; of X and Y in octal digits.
struct Area {
  char letter;
  bool octal;
  std::uint32_t last;
  std::string_view numbers;  // for messages
};
constexpr std::array kAreas = {
    Area{'C', false, 199, "C0 to C199 (others count 32 bits)"},
    Area{'D', false, 7'999, "D0 to D7999"},
    Area{'L', false, 8'191, "L0 to L8191"},
    Area{'M', false, 8'511, "M0 to M7679 and some from M8000"},
    Area{'S', false, 4'095, "S0 to S4095"},
    Area{'T', false, 255, "T0 to T255"},
    Area{'X', true, 0377, "X0 to X377, which are octal"},
    Area{'Y', true, 0377, "Y0 to Y377, which are octal"},
};

const Area* find_area(char letter) {
  const auto* const found =
      std::find_if(kAreas.begin(), kAreas.end(),
                   [&](const Area& area) { return area.letter == letter; });
  return found == kAreas.end() ? nullptr : found;
}

char capital(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

template <class Number>
std::optional<Number> number_of(std::string_view digits, int base) {
  Number value = 0;
  const char* const end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, value, base);
  if (digits.empty() || read.ec != std::errc{} || read.ptr != end) return {};
  return value;
}

}  // namespace

std::optional<std::int64_t> constant_of(std::string_view word) {
  const char letter = word.empty() ? '\0' : capital(word[0]);
  if (letter == 'K') {
    const auto value = number_of<std::int64_t>(word.substr(1), 10);
    const bool fits = value && *value >= -32'768 && *value <= 32'767;
    return fits ? value : std::nullopt;
  }
  if (letter != 'H' || word.starts_with("H-") || word.starts_with("h-")) {
    return std::nullopt;
  }
  const auto value = number_of<std::int64_t>(word.substr(1), 16);
  if (!value || *value > 0xffff) return std::nullopt;
  return *value > 0x7fff ? *value - 0x1'0000 : *value;
}

TimerBase base_of(std::uint32_t timer) {
  if (timer < 200) return {100, false};
  if (timer < 246) return {10, false};
  if (timer < 250) return {1, true};
  return {100, true};
}

std::optional<DeviceName> Devices::parse(std::string_view word,
                                         SourceRange where) {
  const Area* const area =
      word.size() < 2 ? nullptr : find_area(capital(word[0]));
  if (area == nullptr) {
    errors_.error("RP041", where,
                  quoted_excerpt(word) +
                      " is no device that is supported: those are X Y M S L T "
                      "C and D with a number");
    return std::nullopt;
  }
  const auto number =
      number_of<std::uint32_t>(word.substr(1), area->octal ? 8 : 10);
  if (!number || *number > area->last) {
    errors_.error("RP044", where,
                  quoted_excerpt(word) + " is no device: there are " +
                      std::string(area->numbers));
    return std::nullopt;
  }
  return DeviceName{area->letter, *number};
}

bool Devices::is_special(DeviceName id, SourceRange where) {
  if (id.letter != 'M' || id.number < 7'680) return false;
  const bool known = (id.number >= kAlwaysOn && id.number <= kNotFirstScan) ||
                     id.number == kSecondClock;
  if (!known) {
    errors_.error("RP044", where,
                  "`M" + std::to_string(id.number) +
                      "` is not supported: of the special relays M8000 to "
                      "M8003 and M8013 are");
  }
  return true;
}

void Devices::declare(const Device& device, SourceRange where) {
  using Kind = AstDeclaration::Kind;
  const bool clock = device.special && device.id.number == kSecondClock;
  const bool has_cell = clock || device.id.number == kFirstScan;
  if (device.special && !has_cell) return;  // constants, a negation
  const bool word = device.id.letter == 'D';
  const bool input = word || clock || device.id.letter == 'X';
  const bool output = device.id.letter == 'Y';
  writer_.declare(device.name, word ? kInt16Cell : kBitCell,
                  input ? Kind::Input : (output ? Kind::Output : Kind::Memory),
                  where);
}

Device* Devices::find(std::string_view word, SourceRange where) {
  const auto id = parse(word, where);
  if (!id) return nullptr;
  const std::uint64_t key =
      (static_cast<std::uint64_t>(id->letter) << 32U) | id->number;
  const auto known = devices_.find(key);
  if (known != devices_.end()) return &known->second;
  Device device = {.name = word, .id = *id};
  device.special = is_special(*id, where);
  if (device.special && id->number == kFirstScan) device.name = "M8002";
  declare(device, where);
  return &devices_.emplace(key, device).first->second;
}

void Devices::push_contact(Expression& nodes, const Device& device,
                           SourceRange where) {
  const std::uint32_t number = device.special ? device.id.number : 0;
  if (number == kAlwaysOn || number == kAlwaysOff) {
    push_leaf(nodes, AstOp::Bool, number == kAlwaysOn ? "true" : "false",
              where);
  } else if (number == kNotFirstScan) {
    find("M8002", where);
    push_leaf(nodes, AstOp::Name, "M8002", where);
    push_unary(nodes, AstOp::Not, where);
  } else {
    push_leaf(nodes, AstOp::Name, device.name, where);
  }
}

std::uint32_t Devices::element(Device& device, SourceRange where) {
  if (!device.element) {
    std::string_view kind = "counter-melsec";
    if (device.id.letter == 'T') {
      kind = base_of(device.id.number).retentive ? "timer-retentive-melsec"
                                                 : "timer-melsec";
    }
    device.element = writer_.element(kind, device.name, where);
  }
  return *device.element;
}

void Devices::write_first_scan(SourceRange where) {
  find("M8002", where);
  const std::string_view first = writer_.make("first", kBitCell, where);
  ast_.declarations.back().initial = 1;
  Expression value;
  push_leaf(value, AstOp::Name, first, where);
  writer_.assign("M8002", false, where, value, where);
  Expression off;
  push_leaf(off, AstOp::Bool, "false", where);
  writer_.assign(first, false, where, off, where);
}

}  // namespace rung::melsec
