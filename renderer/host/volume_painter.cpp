#include "renderer/host/volume_painter.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "renderer/host/ray_caster.h"

namespace tidemark::renderer {
namespace {

constexpr std::int64_t kTile = 16;  // pixels a side: neighbouring rays read the same voxels

// What a view shows beside phi and the source is made ready.
void prepare(HostScene& scene, const VolumeView& view, ThreadPool& threads) {
  if (scene.labels.pages().show_at(view.label_opacity)) scene.labels.prepare_borders();
  if (MapSamples* map = scene.map(map_of(view))) {
    map->fill_pages(scene.phi.layout(), scene.phi.resident_pages(), threads);
  }
}

std::uint8_t as_byte(float share) {
  return static_cast<std::uint8_t>(255.0F * std::clamp(share, 0.0F, 1.0F) + 0.5F);
}

}  // namespace

Status paint_volume(HostScene& scene, const VolumeView& view, Picture& picture,
                    std::span<const std::uint8_t> wanted, ThreadPool& threads, const Progress& progress) {
  prepare(scene, view, threads);
  const PictureSize size{picture.width, picture.height};
  const RayCaster caster(scene, view, size);
  const std::int64_t columns = (size.width + kTile - 1) / kTile;
  const std::int64_t rows = (size.height + kTile - 1) / kTile;
  const auto paint_tile = [&](std::int64_t tile) {
    const std::int64_t left = tile % columns * kTile;
    const std::int64_t top = tile / columns * kTile;
    for (std::int64_t y = top; y < std::min(top + kTile, size.height); ++y) {
      for (std::int64_t x = left; x < std::min(left + kTile, size.width); ++x) {
        const auto number = static_cast<std::size_t>(x + size.width * y);
        if (!wanted.empty() && wanted[number] == 0) continue;
        const glm::vec3 colour = caster.colour(x, y);
        std::uint8_t* const pixel = picture.pixels.data() + 4 * number;
        for (int c = 0; c < 3; ++c) pixel[c] = as_byte(colour[c]);
        pixel[3] = 255;
      }
    }
  };
  threads.for_each(columns * rows, 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t tile = begin; tile < end && !progress.cancelled(); ++tile) paint_tile(tile);
  });
  if (progress.cancelled()) return cancelled_error();
  return {};
}

std::optional<Hit> pick_volume(HostScene& scene, const VolumeView& view, PictureSize size, glm::dvec2 pixel,
                               ThreadPool& threads) {
  prepare(scene, view, threads);
  return RayCaster(scene, view, size).pick(pixel);
}

}  // namespace tidemark::renderer
