// The lack of memory as an error, with how much was asked for where that is known.
#pragma once

#include <cstdint>
#include <new>

#include "core/result.h"

namespace tidemark {

// Thrown where much memory is asked for at once.
class OutOfMemory : public std::bad_alloc {
 public:
  explicit OutOfMemory(std::int64_t bytes) : bytes_(bytes) {}
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }
  [[nodiscard]] const char* what() const noexcept override { return "there is not enough memory"; }

 private:
  std::int64_t bytes_;
};

// The result of make(), which asks for that many bytes at once.
template <class Make>
auto asking_for(std::int64_t bytes, const Make& make) -> decltype(make()) {
  try {
    return make();
  } catch (const std::bad_alloc&) {
    throw OutOfMemory(bytes);
  }
}

[[nodiscard]] inline tl::unexpected<Error> out_of_memory(const std::bad_alloc& thrown) {
  const auto* known = dynamic_cast<const OutOfMemory*>(&thrown);
  if (known == nullptr) return fail(ErrorKind::capability, "there is not enough memory");
  return fail(ErrorKind::capability, "there is not enough memory: {} MB more were asked for",
              (known->bytes() + (std::int64_t{1} << 20) - 1) >> 20);
}

}  // namespace tidemark
