#include "renderer/host/last_pictures.h"

#include <algorithm>

#include "renderer/host/page_shadows.h"
#include "renderer/view_setup.h"

namespace tidemark::renderer {
namespace {

constexpr std::size_t kMost = 4;               // views of a case in 3D, and sizes of one
constexpr std::int64_t kMostPixels = 1 << 22;  // of a screen; larger pictures are drawn once, for a file

// How far beyond a page a pixel's colour looks, in voxels: occlusion along the normal by up to a band, and
// slopes there.
float reach_of(const PhiPages& phi) {
  return phi.band() + 3.0F;
}

}  // namespace

bool LastPictures::can_keep(const HostScene& scene, const VolumeView& view, PictureSize size) {
  return size.width * size.height <= kMostPixels && view.quality.round == 0 &&
         view.colouring == SurfaceColouring::plain && !scene.labels.pages().show_at(view.label_opacity);
}

const LastPictures::Drawn* LastPictures::of(const VolumeView& view, PictureSize size) const {
  const auto found = std::find_if(drawn_.begin(), drawn_.end(), [&](const Drawn& drawn) {
    return drawn.size == size && drawn.view == view;
  });
  return found != drawn_.end() ? &*found : nullptr;
}

void LastPictures::keep(Drawn drawn) {
  std::erase_if(drawn_, [&](const Drawn& one) { return one.size == drawn.size && one.view == drawn.view; });
  if (drawn_.size() == kMost) drawn_.erase(drawn_.begin());
  drawn_.push_back(std::move(drawn));
}

std::vector<std::uint8_t> changed_pixels(const HostScene& scene, const LastPictures::Drawn& drawn) {
  const PhiPages& phi = scene.phi;
  const PictureSize size = drawn.size;
  const PageShadows shadows(phi.page_shape(), reach_of(phi),
                            voxel_from_view(drawn.view, scene.geometry(), size), size);
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(size.width * size.height), 0);
  std::vector<std::uint8_t> blocks(static_cast<std::size_t>(shadows.columns() * shadows.rows()), 0);
  const glm::ivec3 grid = phi.page_grid();
  int number = 0;
  for (int z = 0; z < grid.z; ++z) {
    for (int y = 0; y < grid.y; ++y) {
      for (int x = 0; x < grid.x; ++x, ++number) {
        if (!phi.has_changed_since(number, drawn.phi)) continue;
        const PageShadows::Shadow shadow = shadows.of({x, y, z});
        for (std::int64_t row = shadow.top; row < shadow.bottom; ++row) {
          for (std::int64_t column = shadow.left; column < shadow.right; ++column) {
            blocks[static_cast<std::size_t>(column + shadows.columns() * row)] = 1;
          }
        }
      }
    }
  }
  for (std::int64_t y = 0; y < size.height; ++y) {
    const std::uint8_t* const row = blocks.data() + shadows.columns() * (y / PageShadows::kBlock);
    for (std::int64_t x = 0; x < size.width; ++x) {
      pixels[static_cast<std::size_t>(x + size.width * y)] = row[x / PageShadows::kBlock];
    }
  }
  return pixels;
}

}  // namespace tidemark::renderer
