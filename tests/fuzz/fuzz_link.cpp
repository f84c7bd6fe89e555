// Any bytes on the wire of a controller: under the sanitizers, in exactly the
// memory that it is given. What runs is what the verifier of the tools accepts
// as well, and the wire works afterwards.
//
// The first byte says how the rest is taken: as it comes from the wire, or in
// pieces, each a content that is framed, so that the checksum is right.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "frontend/postfix/disassemble.h"
#include "tests/link/controller.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  if (size == 0) return 0;
  const std::string bytes(data + 1, data + size);
  rung::Eeprom eeprom(300);
  rung::EmulatedController controller(rung::copy_program(), &eeprom);
  if (data[0] == 0) {
    controller.exchange(bytes);
  } else {
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t piece =
          1 + static_cast<unsigned char>(bytes[at]) % rungproof::kFrameContent;
      controller.exchange(rung::frame(bytes.substr(at + 1, piece)));
      at += 1 + piece;
    }
  }
  // The reader alone refuses some programs, which have no number.
  const rung::Disassembly text =
      rung::disassemble_postfix(controller.running());
  require(text.has_value() || text.code == 0);
  const rung::Reply reply =
      rung::ask(controller, rung::request(rungproof::Command::Hello, ""));
  require(reply.answer == 0);
  return 0;
}
