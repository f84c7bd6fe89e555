#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace rung::stl {

/// The 32 bits that `L` puts into the accumulator: `5`, `-3`, `L#5`, `2#101`,
/// `B#16#ff`, `W#16#ffff`, `DW#16#ff`, `C#123`, `S5T#1s500ms`. No value when
/// the text, in capitals and without blanks, is none of these.
std::optional<std::uint32_t> literal_of(std::string_view text);

/// The milliseconds of a word in the format of S5TIME, the count of one in that
/// of counters; no value when a digit is none.
std::optional<std::int64_t> s5time_of(std::uint32_t word);
std::optional<std::int64_t> count_of(std::uint32_t word);

}  // namespace rung::stl
