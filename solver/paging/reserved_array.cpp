#include "solver/paging/reserved_array.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "core/large_pages.h"
#include "core/out_of_memory.h"

namespace tidemark::solver {

namespace {

// Address space is dear to give back: all threads of the process must forget it. For a small surface that
// takes longer than its steps, and memory for all of it costs nothing.
constexpr std::size_t kSmall = std::size_t{1} << 20;
constexpr std::size_t kAlignment = 64;  // of a vector register

}  // namespace

void* reserve_address_space(std::size_t bytes) {
  if (bytes <= kSmall) {
    const std::size_t whole = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    void* memory = std::aligned_alloc(kAlignment, whole);
    if (memory == nullptr) throw OutOfMemory(static_cast<std::int64_t>(bytes));
    return std::memset(memory, 0, whole);
  }
  void* address =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (address == MAP_FAILED) throw OutOfMemory(static_cast<std::int64_t>(bytes));
  // A surface of some thousand pages touches more small pages of memory than the processor can look up.
  prefer_large_pages(address, bytes);
  return address;
}

void release_address_space(void* address, std::size_t bytes) {
  if (bytes <= kSmall) {
    std::free(address);
  } else {
    ::munmap(address, bytes);
  }
}

}  // namespace tidemark::solver
