#include "renderer/host/slice_painter.h"

#include <algorithm>
#include <glm/common.hpp>

#include "core/without_exceptions.h"
#include "renderer/host/slice_layers.h"

namespace tidemark::renderer {
namespace {

std::uint8_t to_byte(float share) {
  return static_cast<std::uint8_t>(glm::clamp(share, 0.0F, 1.0F) * 255.0F + 0.5F);
}

// Calls body(row, to) for the rows of a tile from its bottom: the first pixel in the tile and in the picture,
// whose rows begin at the top, and how many there are.
template <class Body>
void for_each_row(const SliceTile& tile, Picture& picture, const Body& body) {
  const auto width =
      static_cast<std::size_t>(std::min<std::int64_t>(SliceTile::kWidth, picture.width - tile.left));
  const std::int64_t height = std::min<std::int64_t>(SliceTile::kHeight, picture.height - tile.bottom);
  for (std::int64_t y = 0; y < height; ++y) {
    const std::int64_t row = picture.height - 1 - (tile.bottom + y);
    body(static_cast<std::size_t>(SliceTile::kWidth * y),
         picture.pixels.data() + 4 * (tile.left + picture.width * row), width);
  }
}

void write_colours(const SliceTile& tile, Picture& picture) {
  for_each_row(tile, picture, [&](std::size_t from, std::uint8_t* to, std::size_t width) {
    for (std::size_t x = 0; x < width; ++x) {
      const glm::vec3 colour = tile.colour[from + x];
      for (int channel = 0; channel < 3; ++channel) *to++ = to_byte(colour[channel]);
      *to++ = 255;
    }
  });
}

void write_grey(const SliceTile& tile, Picture& picture) {
  for_each_row(tile, picture, [&](std::size_t from, std::uint8_t* to, std::size_t width) {
    for (std::size_t x = 0; x < width; ++x) {
      const auto grey = static_cast<std::uint8_t>(tile.source[from + x] * 255.0F + 0.5F);
      for (int channel = 0; channel < 3; ++channel) *to++ = grey;
      *to++ = 255;
    }
  });
}

Result<Picture> painted(HostScene& scene, const SliceView& view, PictureSize size, ThreadPool& threads,
                        const Progress& progress) {
  const glm::dmat4 voxel_from_view = slice_from_view(scene.geometry(), view.orientation, view.position_mm,
                                                     view.zoom, view.pan_mm, size.aspect());
  MapSamples* map = scene.map(map_of(view));
  if (map != nullptr) map->fill_plane(voxel_from_view, threads);
  Picture picture{size.width, size.height,
                  std::vector<std::uint8_t>(static_cast<std::size_t>(4 * size.width * size.height))};
  const SlicePlane plane(voxel_from_view, size);
  const SliceLayers layers(scene, view, plane, size, map);
  const std::int64_t columns = (size.width + SliceTile::kWidth - 1) / SliceTile::kWidth;
  const std::int64_t rows = (size.height + SliceTile::kHeight - 1) / SliceTile::kHeight;
  constexpr std::int64_t kTilesAtOnce = 4;
  threads.for_each(columns * rows, kTilesAtOnce, [&](std::int64_t first, std::int64_t end, int) {
    SliceTile tile;
    for (std::int64_t i = first; i < end && !progress.cancelled(); ++i) {
      const std::int64_t left = i % columns * SliceTile::kWidth;
      const std::int64_t bottom = i / columns * SliceTile::kHeight;
      tile.place(plane, static_cast<int>(left), static_cast<int>(bottom), scene.source.size());
      if (layers.draw(tile)) {
        write_colours(tile, picture);
      } else {
        write_grey(tile, picture);
      }
    }
  });
  if (progress.cancelled()) return cancelled_error();
  return picture;
}

}  // namespace

Result<Picture> paint_slice(HostScene& scene, const SliceView& view, PictureSize size, ThreadPool& threads,
                            const Progress& progress) {
  return without_exceptions([&] { return painted(scene, view, size, threads, progress); });
}

}  // namespace tidemark::renderer
