// Memory in large pages, for what is as large as a volume.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/out_of_memory.h"

namespace tidemark {

// Asks the kernel to back the memory by large pages (2 MiB) where it can. Nothing but speed depends on it.
void prefer_large_pages(void* memory, std::size_t bytes);

// So many times the value. A vector of a CT touches fifty thousand pages of the usual size for the first
// time. The processor enters the kernel for each, which takes longer than filling them.
template <class Value>
[[nodiscard]] std::vector<Value> make_large_vector(std::size_t count, Value value = {}) {
  std::vector<Value> values;
  asking_for(static_cast<std::int64_t>(count * sizeof(Value)), [&] { values.reserve(count); });
  prefer_large_pages(values.data(), count * sizeof(Value));
  values.resize(count, value);
  return values;
}

}  // namespace tidemark
