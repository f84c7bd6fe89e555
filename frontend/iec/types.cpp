#include "frontend/iec/types.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "frontend/iec/token.h"

namespace rung::iec {

namespace {

using enum Kind;

constexpr std::int64_t kMaxTime = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kMax32 = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kMaxUnsigned32 =
    std::numeric_limits<std::uint32_t>::max();

constexpr Type kSint = {"SINT", Integer, -128, 127, "wrap8"};
constexpr Type kDint = {"DINT", Integer, -kMax32 - 1, kMax32, "wrap32"};
constexpr Type kUsint = {"USINT", Integer, 0, 255, "wrap_u8"};
constexpr Type kUint = {"UINT", Integer, 0, 65'535, "wrap_u16"};
constexpr Type kUdint = {"UDINT", Integer, 0, kMaxUnsigned32, "wrap_u32"};
constexpr Type kByte = {"BYTE", Integer, 0, 255, "wrap_u8"};
constexpr Type kWord = {"WORD", Integer, 0, 65'535, "wrap_u16"};
constexpr Type kDword = {"DWORD", Integer, 0, kMaxUnsigned32, "wrap_u32"};

}  // namespace

const Type kBool = {"BOOL", Bool, 0, 1, {}};
const Type kInt = {"INT", Integer, -32'768, 32'767, "wrap16"};
const Type kTime = {"TIME", Time, 0, kMaxTime, {}};
const Type kLiteral = {
    "an integer", Integer, -kMaxUnsigned32, kMaxUnsigned32, {}};

namespace {

constexpr std::array<const Type*, 11> kTypes = {
    &kBool, &kByte,  &kDint, &kDword, &kInt, &kSint,
    &kTime, &kUdint, &kUint, &kUsint, &kWord};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A number that is written in one way only.
bool is_index(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit) &&
         (text.size() == 1 || text[0] != '0');
}

struct Unit {
  std::string_view name;
  std::int64_t milliseconds;
};
// In the order in which a literal has them.
constexpr std::array<Unit, 5> kUnits = {{{"D", 86'400'000},
                                         {"H", 3'600'000},
                                         {"M", 60'000},
                                         {"S", 1000},
                                         {"MS", 1}}};

/// `1_000` without its underscores; none at an end or doubled.
bool drop_underscores(std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '_') continue;
    if (i == 0 || i + 1 == text.size() || text[i + 1] == '_') return false;
  }
  std::erase(text, '_');
  return true;
}

/// One part of a literal, `1.5s`, from `at` on.
std::optional<std::int64_t> read_part(std::string_view text, std::size_t& at,
                                      std::size_t& next_unit) {
  std::int64_t number = 0;
  std::int64_t scale = 1;
  const std::size_t begin = at;
  bool fraction = false;
  while (at < text.size() && (is_digit(text[at]) || text[at] == '.')) {
    if (text[at] == '.') {
      if (fraction || at == begin) return std::nullopt;
      fraction = true;
    } else {
      number = number * 10 + (text[at] - '0');
      if (fraction) scale *= 10;
      if (number > kMaxTime || scale > 1'000'000'000) return std::nullopt;
    }
    ++at;
  }
  if (at == begin || text[at - 1] == '.') return std::nullopt;
  std::size_t end = at;
  while (end < text.size() && !is_digit(text[end]) && text[end] != '.') ++end;
  const std::string_view name = text.substr(at, end - at);
  at = end;
  for (; next_unit < kUnits.size(); ++next_unit) {
    if (kUnits[next_unit].name != name) continue;
    // Only the last part may be a fraction.
    if (fraction && at != text.size()) return std::nullopt;
    const std::int64_t total = number * kUnits[next_unit++].milliseconds;
    if (total % scale != 0) return std::nullopt;
    return total / scale;
  }
  return std::nullopt;
}

/// Digits to a base, `16#ff`, or decimal ones, with a sign where it may stand.
std::optional<std::int64_t> read_integer(std::string text) {
  bool negative = false;
  if (text.starts_with("-") || text.starts_with("+")) {
    negative = text[0] == '-';
    text.erase(0, 1);
  }
  int base = 10;
  if (const std::size_t mark = text.find('#'); mark != std::string::npos) {
    const std::string_view name = std::string_view(text).substr(0, mark);
    base = name == "2" ? 2 : name == "8" ? 8 : name == "16" ? 16 : 0;
    if (base == 0) return std::nullopt;
    text.erase(0, mark + 1);
  }
  if (text.empty() || text[0] == '-' || !drop_underscores(text)) {
    return std::nullopt;
  }
  std::int64_t value = 0;
  const auto [stop, problem] =
      std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (problem != std::errc() || stop != text.data() + text.size()) {
    return std::nullopt;
  }
  return negative ? -value : value;
}

std::optional<Literal> literal_of(const Type& type, std::int64_t value) {
  if (!type.holds(value)) return std::nullopt;
  return Literal{&type, value};
}

}  // namespace

const Type* find_type(std::string_view upper_name) {
  const auto* const found =
      std::find_if(kTypes.begin(), kTypes.end(),
                   [&](const Type* type) { return type->name == upper_name; });
  return found == kTypes.end() ? nullptr : *found;
}

std::vector<std::string_view> type_names() {
  std::vector<std::string_view> names;
  names.reserve(kTypes.size());
  for (const Type* type : kTypes) names.push_back(type->name);
  return names;
}

std::optional<Literal> read_literal(std::string_view text) {
  std::string word = upper(text);
  if (word == "TRUE") return Literal{&kBool, 1};
  if (word == "FALSE") return Literal{&kBool, 0};
  const std::size_t mark = word.find('#');
  if (mark != std::string::npos && !is_digit(word[0]) && word[0] != '-') {
    const std::string prefix = word.substr(0, mark);
    if (prefix == "T" || prefix == "TIME") {
      const auto time = milliseconds_of(word);
      if (!time) return std::nullopt;
      return Literal{&kTime, *time};
    }
    const Type* const type = find_type(prefix);
    if (type == nullptr) return std::nullopt;
    word.erase(0, mark + 1);
    if (type == &kBool && word == "TRUE") return Literal{type, 1};
    if (type == &kBool && word == "FALSE") return Literal{type, 0};
    const auto value = read_integer(word);
    return value ? literal_of(*type, *value) : std::nullopt;
  }
  const auto value = read_integer(word);
  return value ? literal_of(kLiteral, *value) : std::nullopt;
}

std::optional<std::int64_t> read_initial(std::string_view text,
                                         const Type& type) {
  std::string word(text);
  std::erase_if(word, [](char c) { return c == ' ' || c == '\t'; });
  const bool minus = word.starts_with("-");
  const auto literal = read_literal(minus ? word.substr(1) : word);
  if (!literal || (minus && literal->type->kind != Integer)) {
    return std::nullopt;
  }
  const std::int64_t value = minus ? -literal->value : literal->value;
  const bool fits = literal->type == &type ||
                    (literal->type == &kLiteral && type.kind != Kind::Time);
  if (!fits || !type.holds(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> milliseconds_of(std::string_view literal) {
  std::string text = upper(literal.substr(literal.find('#') + 1));
  if (text.empty() || !drop_underscores(text)) return std::nullopt;
  std::int64_t total = 0;
  std::size_t next_unit = 0;
  for (std::size_t at = 0; at < text.size();) {
    const auto part = read_part(text, at, next_unit);
    if (!part || *part > kMaxTime - total) return std::nullopt;
    total += *part;
  }
  return total;
}

std::string address_key(std::string_view text) {
  std::string key = upper(text);
  const bool area =
      key.size() > 2 && (key[1] == 'I' || key[1] == 'Q' || key[1] == 'M');
  if (!area) return {};
  if (is_digit(key[2])) key.insert(2, "X");
  const char size = key[2];
  const std::string_view rest = std::string_view(key).substr(3);
  const std::size_t dot = rest.find('.');
  // `%IX3` may be the same bit as `%IX0.3`, so only one way is read.
  const bool bit = size == 'X' && dot != std::string_view::npos &&
                   is_index(rest.substr(0, dot)) &&
                   is_index(rest.substr(dot + 1));
  const bool word =
      (size == 'B' || size == 'W' || size == 'D') && is_index(rest);
  return bit || word ? key : std::string();
}

const Type& address_type(char size) {
  switch (size) {
    case 'X':
      return kBool;
    case 'B':
      return kByte;
    case 'D':
      return kDint;
    default:
      return kInt;
  }
}

bool fits_address(const Type& type, char size) {
  if (type.kind == Kind::Bool) return size == 'X';
  if (type.kind == Kind::Time) return false;
  const std::int64_t width = type.high - type.low;
  return size == (width < 256 ? 'B' : width < 65'536 ? 'W' : 'D');
}

}  // namespace rung::iec
