// The mean of a still view's pictures on the GPU.
#pragma once

#include <optional>

#include "gpu/program.h"
#include "renderer/gl/canvas.h"

namespace tidemark::renderer {

// The counterpart of PictureMean (quality_control.h), which has pictures that are read back.
class CanvasMean {
 public:
  static Result<CanvasMean> create(gpu::Device& device);

  void clear() { count_ = 0; }
  // Adds the picture and puts the mean of all into its place. Starts anew with another size.
  Status replace_by_mean(gpu::Device& device, Canvas& picture);

 private:
  void use(const Canvas& picture, float weight) const;

  gpu::Program weighted_;
  Canvas sum_;
  int count_ = 0;
};

}  // namespace tidemark::renderer
