#include "solver/gl/source_texture.h"

#include <type_traits>
#include <variant>

namespace tidemark::solver {
namespace {

struct Stored {
  gpu::TexelFormat format;
  const char* sampler;  // of a 3D texture
  const char* blocks;   // of layers
};

Stored stored_as(const Volume& source) {
  return std::visit(
      [](const auto& voxels) -> Stored {
        using Scalar = typename std::decay_t<decltype(voxels)>::value_type;
        if constexpr (std::is_same_v<Scalar, std::int16_t>)
          return {gpu::TexelFormat::r16i, "isampler3D", "isampler2DArray"};
        if constexpr (std::is_same_v<Scalar, std::uint16_t>)
          return {gpu::TexelFormat::r16ui, "usampler3D", "usampler2DArray"};
        return {gpu::TexelFormat::r32f, "sampler3D", "sampler2DArray"};
      },
      source.voxels);
}

}  // namespace

Result<SourceTexture> SourceTexture::create(gpu::Device& device, std::shared_ptr<const Volume> source,
                                            int threads) {
  const Index3 size = source->geometry.size;
  const gpu::TexelFormat format = stored_as(*source).format;
  SourceTexture result;
  const auto bytes =
      std::visit([](const auto& voxels) { return std::as_bytes(std::span(voxels)); }, source->voxels);
  if (auto texture = gpu::Texture3D::create(device, format, size, bytes, "source")) {
    result.texture_ = std::move(*texture);
  } else if (texture.error().kind != ErrorKind::capability || device.lost()) {
    return pass_on(texture);
  } else {
    auto blocks = FilledBlocks::create(device, size, {format}, "source", threads);
    if (!blocks) return pass_on(blocks);
    result.blocks_ = std::move(*blocks);
  }
  result.source_ = std::move(source);
  return result;
}

Status SourceTexture::fill(gpu::Device& device, std::int64_t most_bytes) {
  const auto copy = [&](const VoxelBox& box, std::span<std::byte* const> texels) {
    std::visit(
        [&](const auto& voxels) {
          using Scalar = typename std::decay_t<decltype(voxels)>::value_type;
          std::vector<Scalar> values;
          values.reserve(static_cast<std::size_t>(box.voxels()));
          for (std::int64_t row = 0; row < box.size.y * box.size.z; ++row) {
            const Index3 first = box.first + Index3(0, row % box.size.y, row / box.size.y);
            const auto from = voxels.begin() + source_->geometry.offset(first);
            values.insert(values.end(), from, from + box.size.x);
          }
          to_blocks(box.size, values.data(), reinterpret_cast<Scalar*>(texels[0]));
        },
        source_->voxels);
  };
  return blocks_->fill(device, copy, most_bytes);
}

gpu::Defines SourceTexture::defines() const {
  const Stored stored = stored_as(*source_);
  if (!blocks_) return {{"SOURCE_SAMPLER", stored.sampler}};
  gpu::Defines defines = blocks_->blocks().defines();
  defines.emplace_back("SOURCE_SAMPLER", stored.blocks);
  defines.emplace_back("SOURCE_BLOCKS", "");
  return defines;
}

void SourceTexture::set_uniforms(const gpu::Program& program, int unit) const {
  if (blocks_) {
    blocks_->blocks().bind(unit);
    program.set("source_table", unit + 1);
  } else {
    texture_.bind(static_cast<unsigned>(unit));
  }
  program.set("source_volume", unit);
  program.set("source_slope", static_cast<float>(source_->slope));
  program.set("source_intercept", static_cast<float>(source_->intercept));
}

}  // namespace tidemark::solver
