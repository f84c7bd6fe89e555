#include "smt/z3_context.h"

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#endif

#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace rung {
namespace {

/// Z3 4.8.12 clears two tables of 8 MB for each term manager that it makes,
/// and a context makes two: four thousand page faults, 41 ms of the 44 ms that
/// its start took where this was measured. On huge pages it takes 3 to 7 ms.
void prepare_heap() {
#ifdef __GLIBC__
  constexpr std::size_t kTables = std::size_t{48} << 20;
  constexpr std::uintptr_t kHugePage = std::uintptr_t{2} << 20;
  // From the heap's top and not from mmap, so that what is prepared here is
  // what Z3 gets. Freed blocks stay there for the next context.
  mallopt(M_MMAP_THRESHOLD, static_cast<int>(kTables * 2));
  mallopt(M_TRIM_THRESHOLD, static_cast<int>(kTables * 2));
  void* block = std::malloc(kTables);
  if (block == nullptr) return;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): pages are addresses
  const auto start = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t begin = (start + kHugePage - 1) & ~(kHugePage - 1);
  const std::uintptr_t end = (start + kTables) & ~(kHugePage - 1);
  // Advice only: without huge pages it is as slow as it was.
  madvise(static_cast<char*>(block) + (begin - start), end - begin,
          MADV_HUGEPAGE);
  std::free(block);
#endif
}

}  // namespace

Z3Context::Z3Context() {
  static const bool prepared = (prepare_heap(), true);
  static_cast<void>(prepared);
  Z3_config config = Z3_mk_config();
  context_ = Z3_mk_context_rc(config);
  Z3_del_config(config);
  Z3_set_error_handler(context_, nullptr);
}

Z3Context::~Z3Context() { Z3_del_context(context_); }

std::string Z3Context::error() const {
  const Z3_error_code code = Z3_get_error_code(context_);
  if (code == Z3_OK) return {};
  return Z3_get_error_msg(context_, code);
}

}  // namespace rung
