// The pages of a field as a value: copies share them, and a page that is set in one copy is set in no other.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace tidemark {

// A virtual page that is not stored is outside or inside throughout.
//
// Two values that come from one another differ in those pages alone that do not lie at the same place, so
// nobody has to compare voxels to find them. The table is shared as well, in chunks: a copy costs 16 bytes
// for kChunk pages, and a page that is set then costs its chunk.
template <class T>
class BasicSharedPages {
 public:
  enum class Kind : std::uint8_t { outside, inside, stored };

  BasicSharedPages() = default;
  // All outside. The pages have `voxels_per_page` values each, i fastest.
  BasicSharedPages(std::int64_t pages, std::int64_t voxels_per_page);

  [[nodiscard]] std::int64_t size() const { return size_; }      // virtual pages
  [[nodiscard]] std::int64_t stored() const { return stored_; }  // of them
  [[nodiscard]] std::int64_t voxels_per_page() const { return voxels_per_page_; }

  [[nodiscard]] Kind kind(std::int64_t page) const {
    const T* const at = place(page);
    return at == nullptr ? Kind::outside : at == kInside.data() ? Kind::inside : Kind::stored;
  }
  [[nodiscard]] bool is_stored(std::int64_t page) const { return kind(page) == Kind::stored; }
  // Null where the page is not stored.
  [[nodiscard]] const T* values(std::int64_t page) const {
    const T* const at = place(page);
    return at == kInside.data() ? nullptr : at;
  }

  // `kind` is not stored.
  void set_constant(std::int64_t page, Kind kind);
  // A page of the caller's values; what it writes there is seen in no other copy. They are not set yet.
  [[nodiscard]] T* store(std::int64_t page);
  // The values of a stored page, to be changed; copies keep what they were. Where no copy has the page it
  // stays at its place, and several threads may ask for it.
  [[nodiscard]] T* change(std::int64_t page);
  // The page as it is in another value with as many pages.
  void share(std::int64_t page, const BasicSharedPages& other) { share(page, other, page); }
  // The page as that one of another value, whose pages have as many voxels.
  void share(std::int64_t page, const BasicSharedPages& other, std::int64_t like);
  // The page as another page of this value is.
  void repeat(std::int64_t page, std::int64_t like) { replace(page, held(like)); }

  // The stored pages, in ascending order.
  [[nodiscard]] std::vector<std::int64_t> stored_pages() const;

  // Bytes of the table and of all stored pages, as if nothing were shared.
  [[nodiscard]] std::int64_t bytes() const;

  // Calls visit(page) for the pages, in ascending order, that do not lie at the same place in both, which
  // have as many pages. Takes time by what they do not share.
  template <class Visit>
  static void for_each_difference(const BasicSharedPages& a, const BasicSharedPages& b, const Visit& visit) {
    for (std::size_t chunk = 0; chunk < a.chunks_.size(); ++chunk) {
      if (a.chunks_[chunk] == b.chunks_[chunk]) continue;
      const std::int64_t first = static_cast<std::int64_t>(chunk) * kChunk;
      for (std::int64_t page = first; page < first + kChunk && page < a.size_; ++page) {
        if (a.place(page) != b.place(page)) visit(page);
      }
    }
  }

 private:
  static constexpr std::int64_t kChunk = 512;  // pages
  using Page = std::shared_ptr<T[]>;
  using Chunk = std::array<Page, kChunk>;
  // Stands for a page that is inside throughout; nobody reads or writes it.
  static inline std::array<T, 1> kInside{};

  [[nodiscard]] const Page& held(std::int64_t page) const {
    const auto number = static_cast<std::size_t>(page);  // what has no sign is divided by shifting
    return std::as_const(*chunks_[number / kChunk])[number % kChunk];
  }
  [[nodiscard]] const T* place(std::int64_t page) const { return held(page).get(); }
  Page& entry(std::int64_t page);
  void replace(std::int64_t page, Page by);

  std::vector<std::shared_ptr<Chunk>> chunks_;
  std::int64_t size_ = 0;
  std::int64_t voxels_per_page_ = 0;
  std::int64_t stored_ = 0;
};

// Of phi.
using SharedPages = BasicSharedPages<float>;

template <class T>
BasicSharedPages<T>::BasicSharedPages(std::int64_t pages, std::int64_t voxels_per_page)
    : chunks_(static_cast<std::size_t>((pages + kChunk - 1) / kChunk), std::make_shared<Chunk>()),
      size_(pages),
      voxels_per_page_(voxels_per_page) {}

// Whoever has the chunk alone may change it: nobody else can get it meanwhile, since this value is not copied
// while it is changed.
template <class T>
typename BasicSharedPages<T>::Page& BasicSharedPages<T>::entry(std::int64_t page) {
  std::shared_ptr<Chunk>& chunk = chunks_[static_cast<std::size_t>(page / kChunk)];
  if (chunk.use_count() > 1) chunk = std::make_shared<Chunk>(*chunk);
  return (*chunk)[static_cast<std::size_t>(page % kChunk)];
}

template <class T>
void BasicSharedPages<T>::replace(std::int64_t page, Page by) {
  const bool was_stored = is_stored(page);
  Page& there = entry(page);
  there = std::move(by);
  stored_ += (is_stored(page) ? 1 : 0) - (was_stored ? 1 : 0);
}

template <class T>
void BasicSharedPages<T>::set_constant(std::int64_t page, Kind kind) {
  if (kind == this->kind(page)) return;
  replace(page, kind == Kind::inside ? Page(std::shared_ptr<void>(), kInside.data()) : Page());
}

template <class T>
T* BasicSharedPages<T>::store(std::int64_t page) {
  Page made = std::make_shared_for_overwrite<T[]>(static_cast<std::size_t>(voxels_per_page_));
  T* const values = made.get();
  replace(page, std::move(made));
  return values;
}

template <class T>
T* BasicSharedPages<T>::change(std::int64_t page) {
  if (const Page& there = entry(page); there.use_count() == 1) return there.get();
  const Page former = held(page);
  T* const values = store(page);
  std::copy_n(former.get(), voxels_per_page_, values);
  return values;
}

template <class T>
void BasicSharedPages<T>::share(std::int64_t page, const BasicSharedPages& other, std::int64_t like) {
  if (place(page) == other.place(like)) return;
  replace(page, other.held(like));
}

template <class T>
std::vector<std::int64_t> BasicSharedPages<T>::stored_pages() const {
  std::vector<std::int64_t> pages;
  pages.reserve(static_cast<std::size_t>(stored_));
  for (std::int64_t page = 0; page < size_; ++page) {
    if (is_stored(page)) pages.push_back(page);
  }
  return pages;
}

template <class T>
std::int64_t BasicSharedPages<T>::bytes() const {
  return static_cast<std::int64_t>(chunks_.size() * (sizeof(Chunk) + sizeof(chunks_.front()))) +
         stored_ * voxels_per_page_ * static_cast<std::int64_t>(sizeof(T));
}

}  // namespace tidemark
