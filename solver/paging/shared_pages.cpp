#include "solver/paging/shared_pages.h"

#include <algorithm>
#include <utility>

namespace tidemark::solver {

std::array<float, 1> SharedPages::kInside{};

SharedPages::SharedPages(std::int64_t pages, std::int64_t voxels_per_page)
    : chunks_(static_cast<std::size_t>((pages + kChunk - 1) / kChunk), std::make_shared<Chunk>()),
      size_(pages),
      voxels_per_page_(voxels_per_page) {}

// Whoever has the chunk alone may change it: nobody else can get it meanwhile, since this value is not copied
// while it is changed.
SharedPages::Page& SharedPages::entry(std::int64_t page) {
  std::shared_ptr<Chunk>& chunk = chunks_[static_cast<std::size_t>(page / kChunk)];
  if (chunk.use_count() > 1) chunk = std::make_shared<Chunk>(*chunk);
  return (*chunk)[static_cast<std::size_t>(page % kChunk)];
}

void SharedPages::replace(std::int64_t page, Page by) {
  const bool was_stored = is_stored(page);
  Page& there = entry(page);
  there = std::move(by);
  stored_ += (is_stored(page) ? 1 : 0) - (was_stored ? 1 : 0);
}

void SharedPages::set_constant(std::int64_t page, Kind kind) {
  if (kind == this->kind(page)) return;
  replace(page, kind == Kind::inside ? Page(std::shared_ptr<void>(), kInside.data()) : Page());
}

float* SharedPages::store(std::int64_t page) {
  Page made = std::make_shared_for_overwrite<float[]>(static_cast<std::size_t>(voxels_per_page_));
  float* const values = made.get();
  replace(page, std::move(made));
  return values;
}

float* SharedPages::change(std::int64_t page) {
  const Page former = std::as_const(
      *chunks_[static_cast<std::size_t>(page / kChunk)])[static_cast<std::size_t>(page % kChunk)];
  float* const values = store(page);
  std::copy_n(former.get(), voxels_per_page_, values);
  return values;
}

void SharedPages::share(std::int64_t page, const SharedPages& other) {
  if (place(page) == other.place(page)) return;
  replace(page,
          (*other.chunks_[static_cast<std::size_t>(page / kChunk)])[static_cast<std::size_t>(page % kChunk)]);
}

std::vector<std::int64_t> SharedPages::stored_pages() const {
  std::vector<std::int64_t> pages;
  pages.reserve(static_cast<std::size_t>(stored_));
  for (std::int64_t page = 0; page < size_; ++page) {
    if (is_stored(page)) pages.push_back(page);
  }
  return pages;
}

std::int64_t SharedPages::bytes() const {
  return static_cast<std::int64_t>(chunks_.size() * (sizeof(Chunk) + sizeof(chunks_.front()))) +
         stored_ * voxels_per_page_ * static_cast<std::int64_t>(sizeof(float));
}

}  // namespace tidemark::solver
