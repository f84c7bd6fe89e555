#pragma once

#include <nlohmann/json.hpp>

#include "analysis/result.h"

namespace rung {

/// Arrays of values in a fixed order. Only .cpp files include this: the library
/// is slow to compile. As CBOR texts may be any bytes, and numbers are exact.
using Packed = nlohmann::json;

/// A verdict with its certificate and its trace, without its obligation.
Packed pack_result(const ObligationResult& result);

/// Errors: throws what the library throws where these are no such values. A
/// trace has as many values a step as the program has cells.
ObligationResult unpack_result(const Packed& packed, std::size_t cells);

/// Of an enumeration with `last` as its last value.
template <class Enum>
Enum unpack_enum(const Packed& packed, Enum last) {
  const auto value = packed.get<std::uint8_t>();
  if (value > static_cast<std::uint8_t>(last)) {
    throw std::out_of_range("no such enumerator");
  }
  return static_cast<Enum>(value);
}

std::string to_bytes(const Packed& packed);
/// Null where it is not CBOR.
Packed from_bytes(std::string_view bytes);

}  // namespace rung
