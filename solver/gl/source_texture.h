// The source of the tent on the GPU, in its stored type; resources/shaders/solver/source.glsl reads it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/volume.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "solver/gl/filled_blocks.h"

namespace tidemark::solver {

// One 3D texture. Where the driver has none so large, blocks that are filled where they are read.
class SourceTexture {
 public:
  SourceTexture() = default;
  // `threads` as in ExecutorOptions. Fails (ErrorKind::capability) when the driver's limits or its memory are
  // too small.
  static Result<SourceTexture> create(gpu::Device& device, std::shared_ptr<const Volume> source, int threads);

  // Null: it is one texture.
  [[nodiscard]] FilledBlocks* wanted() { return blocks_ ? &*blocks_ : nullptr; }
  [[nodiscard]] const FilledBlocks* wanted() const { return blocks_ ? &*blocks_ : nullptr; }
  Status fill(gpu::Device& device, std::int64_t most_bytes);  // as SpeedTextures does

  static constexpr int kUnits = 2;  // from `unit` on
  [[nodiscard]] gpu::Defines defines() const;
  void set_uniforms(const gpu::Program& program, int unit) const;  // of the program in use

 private:
  std::shared_ptr<const Volume> source_;
  gpu::Texture3D texture_;
  std::optional<FilledBlocks> blocks_;
};

}  // namespace tidemark::solver
