// Any bytes give a program or a clear error: the reader of drawn ladders and
// the builder behind it. What the reader accepts the builder accepts.

#include <cstddef>
#include <cstdint>

#include "checks.h"
#include "frontend/ascii/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  check_declared_reader(rung::read_ascii, data, size);
  return 0;
}
