#include "solver/distance_transform.h"

#include <algorithm>
#include <glm/common.hpp>
#include <memory>
#include <vector>

#include "core/index_walk.h"
#include "core/thread_pool.h"
#include "solver/box_distances.h"

namespace tidemark::solver {
namespace {

// What a page, or its surroundings, hold: one of these bits, or both.
constexpr std::uint8_t kHoldsOutside = 1;
constexpr std::uint8_t kHoldsInside = 2;
constexpr std::uint8_t kHoldsBoth = kHoldsOutside | kHoldsInside;

Index3 rounded_up(Index3 voxels, Index3 pages) {
  return (voxels + pages - Index3(1)) / pages;
}

// What each page holds.
std::vector<std::uint8_t> contents_of(const Inside& inside, const PageLayout& layout, ThreadPool& threads) {
  const Index3 pages = layout.pages();
  const Index3 size = layout.domain_size();
  const Index3 shape = layout.page_shape();
  std::vector<std::uint8_t> contents(static_cast<std::size_t>(layout.page_count()), 0);
  threads.for_each(pages.y * pages.z, 1, [&](std::int64_t begin, std::int64_t end, int) {
    std::vector<std::uint8_t> row(static_cast<std::size_t>(size.x));
    for (std::int64_t row_of_pages = begin; row_of_pages < end; ++row_of_pages) {
      const Index3 first(0, row_of_pages % pages.y * shape.y, row_of_pages / pages.y * shape.z);
      const Index3 last = glm::min(first + shape, size);
      std::uint8_t* const held = contents.data() + row_of_pages * pages.x;
      for (std::int64_t z = first.z; z < last.z; ++z) {
        for (std::int64_t y = first.y; y < last.y; ++y) {
          inside.read(inside.geometry.offset({0, y, z}), row);
          for (std::int64_t page = 0; page < pages.x; ++page) {
            const auto* const voxels = row.data() + page * shape.x;
            const std::int64_t there = std::min(shape.x, size.x - page * shape.x);
            const auto count = std::count(voxels, voxels + there, std::uint8_t{1});
            if (count != 0) held[page] |= kHoldsInside;
            if (count != there) held[page] |= kHoldsOutside;
          }
        }
      }
    }
  });
  return contents;
}

// What each page holds together with those that are at most `reach` pages away along each axis.
std::vector<std::uint8_t> with_surroundings(std::vector<std::uint8_t> contents, const PageLayout& layout,
                                            Index3 reach) {
  std::int64_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t length = layout.pages()[axis];
    const std::vector<std::uint8_t> from = contents;
    for (std::int64_t page = 0; page < layout.page_count(); ++page) {
      const std::int64_t place = page / stride % length;
      const std::int64_t low = std::max(-reach[axis], -place);
      const std::int64_t high = std::min(reach[axis], length - 1 - place);
      std::uint8_t held = 0;
      for (std::int64_t steps = low; steps <= high; ++steps) {
        held |= from[static_cast<std::size_t>(page + steps * stride)];
      }
      contents[static_cast<std::size_t>(page)] = held;
    }
    stride *= length;
  }
  return contents;
}

// phi layer by layer of blocks. A block is some pages, so many that it is not small beside its surroundings,
// which are computed with it.
class PageDistances {
 public:
  PageDistances(const Inside& inside, Field& phi)
      : inside_(inside),
        phi_(phi),
        layout_(phi.layout),
        reach_(phi.geometry, phi.band),
        block_(glm::clamp(rounded_up(reach_.voxels * std::int64_t{2}, layout_.page_shape()), Index3(1),
                          layout_.pages())),
        boxes_(static_cast<std::size_t>(threads_.threads()), BoxDistances(reach_)) {}

  void run() {
    near_ = with_surroundings(contents_of(inside_, layout_, threads_), layout_,
                              rounded_up(reach_.voxels, layout_.page_shape()));
    for (std::int64_t layer = 0; layer < layout_.pages().z; layer += block_.z) make_layer(layer);
  }

 private:
  void make_layer(std::int64_t first_layer) {
    const std::int64_t pages_per_layer = layout_.pages().x * layout_.pages().y;
    const std::int64_t layers = std::min(block_.z, layout_.pages().z - first_layer);
    first_page_ = first_layer * pages_per_layer;
    find_places(layers * pages_per_layer);
    const Index3 blocks = rounded_up(layout_.pages(), block_);
    threads_.for_each(blocks.x * blocks.y, 1, [&](std::int64_t begin, std::int64_t end, int member) {
      for (std::int64_t block = begin; block < end; ++block) {
        make_block({block % blocks.x * block_.x, block / blocks.x * block_.y, first_layer}, member);
      }
    });
    store();
  }

  // Where the pages of the layer that the boundary is near go to.
  void find_places(std::int64_t pages) {
    places_.clear();
    std::int64_t used = 0;
    for (std::int64_t page = first_page_; page < first_page_ + pages; ++page) {
      places_.push_back(is_near(page) ? used++ : -1);
    }
    values_.assign(static_cast<std::size_t>(used * layout_.voxels_per_page()),
                   static_cast<float>(-phi_.band));
  }

  [[nodiscard]] bool is_near(std::int64_t page) const {
    return near_[static_cast<std::size_t>(page)] == kHoldsBoth;
  }

  void make_block(Index3 first_page, int member) {
    const Index3 end_page = glm::min(first_page + block_, layout_.pages());
    bool any = false;
    const auto for_each_near = [&](const auto& visit) {
      for_each_index(first_page, end_page, [&](Index3 coordinates) {
        if (const std::int64_t page = layout_.page_number(coordinates); is_near(page)) visit(page);
      });
    };
    for_each_near([&](std::int64_t) { any = true; });
    if (!any) return;
    const Index3 first = first_page * layout_.page_shape();
    const Index3 size = glm::min(end_page * layout_.page_shape(), layout_.domain_size()) - first;
    const auto distances =
        boxes_[static_cast<std::size_t>(member)].compute(inside_, first, size, static_cast<float>(phi_.band));
    for_each_near([&](std::int64_t page) { copy(page, distances.data(), first, size); });
  }

  void copy(std::int64_t page, const float* distances, Index3 first, Index3 size) {
    const Index3 at = layout_.first_voxel(page) - first;
    const Index3 valid = layout_.valid_shape(page);
    const Index3 shape = layout_.page_shape();
    float* const to = values_of(page);
    for (std::int64_t z = 0; z < valid.z; ++z) {
      for (std::int64_t y = 0; y < valid.y; ++y) {
        const Index3 row(0, y, z);
        std::copy_n(distances + number_in(size, at + row), valid.x, to + number_in(shape, row));
      }
    }
  }

  float* values_of(std::int64_t page) {
    return values_.data() + places_[static_cast<std::size_t>(page - first_page_)] * layout_.voxels_per_page();
  }

  // In the order of pages, whoever made them.
  void store() {
    const auto length = static_cast<std::size_t>(layout_.voxels_per_page());
    const auto pages = static_cast<std::int64_t>(places_.size());
    for (std::int64_t page = first_page_; page < first_page_ + pages; ++page) {
      if (is_near(page)) {
        phi_.store_page(page, {values_of(page), length});
      } else if (near_[static_cast<std::size_t>(page)] == kHoldsInside) {
        phi_.pages.set_constant(page, Field::Kind::inside);
      }
    }
  }

  const Inside& inside_;
  Field& phi_;
  const PageLayout& layout_;
  ThreadPool threads_;
  BandReach reach_;
  Index3 block_;                     // pages
  std::vector<BoxDistances> boxes_;  // one a thread
  std::vector<std::uint8_t> near_;   // what pages hold as far as the band reaches

  // Of the layer that is made: its first page, and the values of those that the boundary is near.
  std::int64_t first_page_ = 0;
  std::vector<std::int64_t> places_;
  std::vector<float> values_;
};

}  // namespace

Field distance_transform(const Inside& inside, double band, Index3 page_shape) {
  Field phi = Field::empty(inside.geometry, band, page_shape);
  PageDistances(inside, phi).run();
  phi.store_between();
  return phi;
}

Field distance_transform(const Mask& mask, double band, Index3 page_shape) {
  return distance_transform(inside_of(mask), band, page_shape);
}

}  // namespace tidemark::solver
