// A field of a paged memory: what it holds for each physical page.
#pragma once

#include <algorithm>
#include <cstdint>

#include "solver/paging/page_table.h"
#include "solver/paging/reserved_array.h"

namespace tidemark::solver {

// Numbers that a program knows when it is compiled, as the extent of std::span; any: when it runs.
inline constexpr std::int64_t kAny = 0;

// `buffers` times `values` T's a page, those of a page side by side. The static pages have theirs as well:
// they stand for every page that is not resident, so nobody who reads needs a case for those. T must be
// usable when it is all zero bytes.
template <class T, std::int64_t kValues = kAny, std::int64_t kBuffers = kAny>
class PageField {
 public:
  PageField() = default;  // no field: not attached
  PageField(std::int64_t pages, std::int64_t values, std::int64_t buffers)
      : values_(values), buffers_(buffers), data_(static_cast<std::size_t>(pages * stride())) {}

  [[nodiscard]] bool is_attached() const { return data_.data() != nullptr; }
  // Bytes of a page, all buffers together.
  [[nodiscard]] std::int64_t page_bytes() const {
    return is_attached() ? stride() * static_cast<std::int64_t>(sizeof(T)) : 0;
  }

  // The values of a page in a buffer, the domain's first axis fastest.
  [[nodiscard]] T* values(PhysicalPage page, int buffer = 0) const {
    return data_.data() + page * stride() + buffer * values_a_buffer();
  }
  // The only value of a page, or its first.
  [[nodiscard]] T& operator[](PhysicalPage page) const { return *values(page); }

  // All values of a page, in all buffers.
  void fill(PhysicalPage page, T value) const { std::fill_n(values(page), stride(), value); }

 private:
  [[nodiscard]] std::int64_t values_a_buffer() const { return kValues == kAny ? values_ : kValues; }
  [[nodiscard]] std::int64_t stride() const {
    return values_a_buffer() * (kBuffers == kAny ? buffers_ : kBuffers);
  }

  std::int64_t values_ = 0;
  std::int64_t buffers_ = 0;
  ReservedArray<T> data_;
};

}  // namespace tidemark::solver
