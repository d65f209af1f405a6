// An array that grows in place.
#pragma once

#include <cstddef>
#include <memory>

namespace tidemark::solver {

// Room for `capacity` zeroed values. More than 1 MiB is address space alone, which takes memory where it is
// first touched. Nothing ever moves, so growing copies nothing and addresses stay good. T must be usable when
// it is all zero bytes. Throws std::bad_alloc when the room cannot be had.
void* reserve_address_space(std::size_t bytes);
void release_address_space(void* address, std::size_t bytes);

template <class T>
class ReservedArray {
 public:
  ReservedArray() = default;
  explicit ReservedArray(std::size_t capacity)
      : values_(static_cast<T*>(reserve_address_space(capacity * sizeof(T))), Release{capacity * sizeof(T)}) {
  }

  [[nodiscard]] T* data() const { return values_.get(); }

 private:
  struct Release {
    std::size_t bytes = 0;
    void operator()(T* values) const { release_address_space(values, bytes); }
  };
  std::unique_ptr<T[], Release> values_;
};

}  // namespace tidemark::solver
