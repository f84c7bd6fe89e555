#include "app/build_identity.h"

#include <elf.h>
#include <link.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace rung {
namespace {

/// The build id in a segment of notes; empty: none.
std::string_view build_id(std::string_view notes) {
  const auto padded = [](std::size_t size) { return (size + 3) & ~3UL; };
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) head;
    std::memcpy(&head, notes.data(), sizeof head);
    notes.remove_prefix(sizeof head);
    const std::size_t name = padded(head.n_namesz);
    const std::size_t text = padded(head.n_descsz);
    if (name > notes.size() || text > notes.size() - name) return {};
    const bool is_gnu =
        notes.substr(0, head.n_namesz) == std::string_view("GNU", sizeof "GNU");
    if (is_gnu && head.n_type == NT_GNU_BUILD_ID) {
      return notes.substr(name, head.n_descsz);
    }
    notes.remove_prefix(name + text);
  }
  return {};
}

struct Found {
  Hasher hasher;
  bool is_first = true;  // the program comes before its libraries
  bool has_program = false;
};

int add_object(dl_phdr_info* object, std::size_t /*size*/, void* data) {
  auto& found = *static_cast<Found*>(data);
  const std::string_view name = object->dlpi_name;
  // The kernel's own page is not part of the program.
  if (name.find("linux-vdso") != std::string_view::npos) return 0;
  for (std::size_t i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const std::uintptr_t address = object->dlpi_addr + segment.p_vaddr;
    // The loader tells addresses as numbers.
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto* const at = reinterpret_cast<const char*>(address);
    const std::string_view id = build_id({at, segment.p_memsz});
    if (id.empty()) continue;
    found.hasher.add(id);
    found.has_program = found.has_program || found.is_first;
  }
  found.is_first = false;
  return 0;
}

}  // namespace

std::optional<Digest> build_identity() {
  Found found;
  ::dl_iterate_phdr(add_object, &found);
  if (!found.has_program) return std::nullopt;
  return found.hasher.finish();
}

}  // namespace rung
