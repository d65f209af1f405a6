#include "core/large_pages.h"

#include <sys/mman.h>

#include <memory>

namespace tidemark {

void prefer_large_pages(void* memory, std::size_t bytes) {
  constexpr std::size_t kLargePage = std::size_t{2} << 20;
  // Only whole pages within the memory.
  void* first = memory;
  if (std::align(kLargePage, kLargePage, first, bytes) == nullptr) return;
  ::madvise(first, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
}

}  // namespace tidemark
