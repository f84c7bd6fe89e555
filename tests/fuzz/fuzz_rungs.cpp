// Any bytes give a program or a clear error: the reader of neutral text and
// the builder behind it. What the reader accepts the builder accepts.

#include <cstddef>
#include <cstdint>

#include "checks.h"
#include "frontend/rockwell/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  check_declared_reader(rung::read_rungs_text, data, size);
  return 0;
}
