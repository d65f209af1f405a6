#include "solver/host/reserved_array.h"

#include <sys/mman.h>

#include <cstdint>

#include "core/large_pages.h"
#include "core/out_of_memory.h"

namespace tidemark::solver {

void* reserve_address_space(std::size_t bytes) {
  void* address =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (address == MAP_FAILED) throw OutOfMemory(static_cast<std::int64_t>(bytes));
  // A surface of some thousand pages touches more small pages of memory than the processor can look up.
  prefer_large_pages(address, bytes);
  return address;
}

void release_address_space(void* address, std::size_t bytes) {
  ::munmap(address, bytes);
}

}  // namespace tidemark::solver
