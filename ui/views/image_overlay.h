// Further images of a case, in colour over a slice.
#pragma once

#include <QImage>
#include <QSize>
#include <memory>
#include <vector>

#include "engine/shown_image.h"
#include "ui/views/view_geometry.h"

namespace tidemark::ui {

// Keeps the picture until slice, images or size change.
class ImageOverlay {
 public:
  // All visible images that the slice meets, over one another in this order, to be stretched over the view;
  // transparent where they are not. Null: there are none.
  const QImage& picture(const std::vector<engine::ShownImage>& images, const renderer::SliceView& slice,
                        const SliceScreen& screen, QSize size);
  // The same for the renderer.
  const std::shared_ptr<const renderer::ImagesOver>& over(const std::vector<engine::ShownImage>& images,
                                                          const renderer::SliceView& slice,
                                                          const SliceScreen& screen, QSize size);

 private:
  std::vector<engine::ShownImage> images_;
  renderer::SliceView slice_;
  QSize size_;
  QImage picture_;
  std::shared_ptr<const renderer::ImagesOver> over_;
};

// 0xRRGGBB of a value that is `part` of the way through its window, 0 to 1.
[[nodiscard]] QRgb colour_of(engine::ImageColours colours, double part);

}  // namespace tidemark::ui
