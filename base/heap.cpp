#include "base/heap.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

// A sanitizer has a heap of its own.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define RUNG_OTHER_HEAP
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define RUNG_OTHER_HEAP
#endif

#if defined(__GLIBC__) && !defined(RUNG_OTHER_HEAP)
#define RUNG_GLIBC_HEAP
#include <malloc.h>
#include <sys/mman.h>
#endif

namespace rung {
namespace {

bool advise() {
#ifdef RUNG_GLIBC_HEAP
  constexpr std::size_t kHeap = std::size_t{512} << 20;  // addresses, no memory
  constexpr std::uintptr_t kHugePage = std::uintptr_t{2} << 20;
  // Everything comes from the heap's top and not from mmap, and what is freed
  // stays there: so what is prepared here is what is used.
  mallopt(M_MMAP_THRESHOLD, static_cast<int>(kHeap * 2));
  mallopt(M_TRIM_THRESHOLD, static_cast<int>(kHeap * 2));
  void* block = std::malloc(kHeap);
  if (block == nullptr) return false;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): pages are addresses
  const auto start = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t begin = (start + kHugePage - 1) & ~(kHugePage - 1);
  const std::uintptr_t end = (start + kHeap) & ~(kHugePage - 1);
  madvise(static_cast<char*>(block) + (begin - start), end - begin,
          MADV_HUGEPAGE);
  std::free(block);
#endif
  return true;
}

}  // namespace

void prepare_heap() {
  static const bool prepared = advise();
  static_cast<void>(prepared);
}

}  // namespace rung
