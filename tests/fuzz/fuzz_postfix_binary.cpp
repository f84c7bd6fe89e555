// Any bytes are refused or run: under the sanitizers, in exactly the memory
// that the machine asks for. What the reader accepts, the machine does. The
// input's length and checksum are put right, so that a changed byte gets past
// them.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/postfix_format.h"
#include "frontend/postfix/disassemble.h"
#include "rungproof_machine.h"

namespace {

void put(std::string& file, std::size_t at, std::uint32_t value) {
  for (std::size_t byte = 0; byte < 4; ++byte) {
    file[at + byte] =
        static_cast<char>(static_cast<unsigned char>(value >> (8 * byte)));
  }
}

void seal(std::string& file) {
  using namespace rung::postfix;
  if (file.size() < kHeaderBytes) return;
  file.replace(0, kMagic.size(), kMagic);
  put(file, LengthField, static_cast<std::uint32_t>(file.size()));
  put(file, ChecksumField, checksum(file));
}

void run(rungproof::Machine& machine) {
  std::int32_t sample = 0;
  for (std::uint32_t scan = 0; scan < 8; ++scan) {
    for (std::uint32_t cell = 0; cell < machine.cell_count(); ++cell) {
      machine.set(cell, sample);
      sample = sample * 5 % 4099 + 1;
    }
    if (!machine.scan(scan * scan * scan)) return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  // The first byte says whether the input is taken as it is.
  if (size == 0) return 0;
  std::string file(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] != 0) seal(file);
  const std::vector<std::uint8_t> bytes(file.begin(), file.end());
  const auto length = static_cast<std::uint32_t>(bytes.size());
  std::vector<std::uint32_t> memory(
      rungproof::Machine::memory_words(bytes.data(), length));
  rungproof::Machine machine;
  const bool accepted =
      machine.begin(bytes.data(), length, memory.data(),
                    static_cast<std::uint32_t>(memory.size())) ==
      rungproof::Refusal::None;
  const rung::Disassembly text = rung::disassemble_postfix(file);
  if (text.has_value() && !accepted) std::abort();
  // Refused by the reader alone: for a reason that the format has no number of.
  if (accepted && !text.has_value() && text.code != 0) std::abort();
  if (accepted) run(machine);
  return 0;
}
