// The pages of a field as a value: copies share them, and a page that is set in one copy is set in no other.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace tidemark::solver {

// A virtual page that is not stored is outside or inside throughout.
//
// Two values that come from one another differ in those pages alone that do not lie at the same place, so
// nobody has to compare voxels to find them. The table is shared as well, in chunks: a copy costs 16 bytes
// for kChunk pages, and a page that is set then costs its chunk.
class SharedPages {
 public:
  enum class Kind : std::uint8_t { outside, inside, stored };

  SharedPages() = default;
  // All outside. The pages have `voxels_per_page` values each, i fastest.
  SharedPages(std::int64_t pages, std::int64_t voxels_per_page);

  [[nodiscard]] std::int64_t size() const { return size_; }      // virtual pages
  [[nodiscard]] std::int64_t stored() const { return stored_; }  // of them
  [[nodiscard]] std::int64_t voxels_per_page() const { return voxels_per_page_; }

  [[nodiscard]] Kind kind(std::int64_t page) const {
    const float* const at = place(page);
    return at == nullptr ? Kind::outside : at == kInside.data() ? Kind::inside : Kind::stored;
  }
  [[nodiscard]] bool is_stored(std::int64_t page) const { return kind(page) == Kind::stored; }
  // Null where the page is not stored.
  [[nodiscard]] const float* values(std::int64_t page) const {
    const float* const at = place(page);
    return at == kInside.data() ? nullptr : at;
  }

  // `kind` is not stored.
  void set_constant(std::int64_t page, Kind kind);
  // A page of the caller's values; what it writes there is seen in no other copy. They are not set yet.
  [[nodiscard]] float* store(std::int64_t page);
  // The values of a stored page, to be changed; copies keep what they were.
  [[nodiscard]] float* change(std::int64_t page);
  // The page as it is in another value with as many pages.
  void share(std::int64_t page, const SharedPages& other);

  // The stored pages, in ascending order.
  [[nodiscard]] std::vector<std::int64_t> stored_pages() const;

  // Bytes of the table and of all stored pages, as if nothing were shared.
  [[nodiscard]] std::int64_t bytes() const;

  // Calls visit(page) for the pages, in ascending order, that do not lie at the same place in both, which
  // have as many pages. Takes time by what they do not share.
  template <class Visit>
  static void for_each_difference(const SharedPages& a, const SharedPages& b, const Visit& visit) {
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
  using Page = std::shared_ptr<float[]>;
  using Chunk = std::array<Page, kChunk>;
  // Stands for a page that is inside throughout; nobody reads or writes it.
  static std::array<float, 1> kInside;

  [[nodiscard]] const float* place(std::int64_t page) const {
    return (*chunks_[static_cast<std::size_t>(page / kChunk)])[static_cast<std::size_t>(page % kChunk)].get();
  }
  Page& entry(std::int64_t page);
  void replace(std::int64_t page, Page by);

  std::vector<std::shared_ptr<Chunk>> chunks_;
  std::int64_t size_ = 0;
  std::int64_t voxels_per_page_ = 0;
  std::int64_t stored_ = 0;
};

}  // namespace tidemark::solver
