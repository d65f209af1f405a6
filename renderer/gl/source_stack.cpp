#include "renderer/gl/source_stack.h"

#include <algorithm>
#include <cstring>
#include <variant>

namespace tidemark::renderer {
namespace {

// A line of the processor's cache holds some 32 values along i: slices across i are gathered so many at once.
constexpr std::int64_t kGatheredAtOnce = 32;

}  // namespace

StoredAs stored_as(const Volume& source) {
  const auto as = [&](gpu::TexelFormat format, double full) {
    return StoredAs{format, glm::vec2(source.slope * full, source.intercept)};
  };
  if (std::holds_alternative<std::vector<std::int16_t>>(source.voxels)) {
    return as(gpu::TexelFormat::r16_snorm, 32767.0);
  }
  if (std::holds_alternative<std::vector<std::uint16_t>>(source.voxels)) {
    return as(gpu::TexelFormat::r16_unorm, 65535.0);
  }
  return as(gpu::TexelFormat::r32f, 1.0);
}

Result<SourceStack> SourceStack::create(gpu::Device& device, const Volume& source, const SliceAxis& axis) {
  SourceStack stack;
  stack.axis_ = axis;
  auto pair = SlicePair::create(device, axis, "slice of the source");
  if (!pair) return pass_on(pair);
  stack.pair_ = std::move(*pair);
  const auto [format, scale] = stored_as(source);
  stack.scale_ = scale;
  for (Stored& stored : stack.stored_) {
    auto texture =
        gpu::Texture2D::create(device, format, axis.width(), axis.height(), "stored slice of the source");
    if (!texture) return pass_on(texture);
    stored.texture = std::move(*texture);
  }
  auto program =
      gpu::Program::render(device, "render/full_view.vert", "", "render/slice_source.frag", {axis.define()});
  if (!program) return pass_on(program);
  stack.program_ = std::move(*program);
  stack.vertices_ = gpu::VertexArray::create(device);
  return stack;
}

// A slice's values, row after row.
template <class Scalar>
std::span<const std::byte> SourceStack::gather(const std::vector<Scalar>& voxels, std::int64_t slice) {
  const auto texels = static_cast<std::size_t>(axis_.width() * axis_.height());
  const Index3 size = axis_.size;
  const auto at = [&](Index3 v) { return voxels.data() + number_in(size, v); };
  if (axis_.along == 2) return std::as_bytes(std::span(at({0, 0, slice}), texels));
  const std::int64_t wanted = axis_.along == 0 ? slice / kGatheredAtOnce * kGatheredAtOnce : slice;
  const std::int64_t count = axis_.along == 0 ? std::min(kGatheredAtOnce, size.x - wanted) : 1;
  if (first_gathered_ != wanted) {
    gathered_.resize(static_cast<std::size_t>(count) * texels * sizeof(Scalar));
    auto* to = reinterpret_cast<Scalar*>(gathered_.data());
    for (std::int64_t row = 0; row < axis_.height(); ++row) {
      if (axis_.along == 1) {
        std::memcpy(to + row * size.x, at({0, slice, row}),
                    static_cast<std::size_t>(size.x) * sizeof(Scalar));
        continue;
      }
      for (std::int64_t y = 0; y < size.y; ++y) {
        const Scalar* from = at({wanted, y, row});
        for (std::int64_t i = 0; i < count; ++i) {
          to[static_cast<std::size_t>(i) * texels + static_cast<std::size_t>(row * size.y + y)] = from[i];
        }
      }
    }
    first_gathered_ = wanted;
  }
  const std::size_t bytes = texels * sizeof(Scalar);
  return std::span<const std::byte>(gathered_).subspan(static_cast<std::size_t>(slice - wanted) * bytes,
                                                       bytes);
}

Status SourceStack::send(const Volume& source, std::int64_t slice, DrawThrottle& throttle) {
  Stored& stored = stored_[static_cast<std::size_t>(slice % 3)];
  if (stored.slice == slice) return {};
  // Draws from this texture's old slice must be complete.
  TIDEMARK_TRY(throttle.wait());
  const auto texels = std::visit([&](const auto& voxels) { return gather(voxels, slice); }, source.voxels);
  stored.texture.upload(axis_.rect(), texels);
  stored.slice = slice;
  return {};
}

Status SourceStack::prepare(const Volume& source, std::int64_t slice, const gpu::TexelRect& part, int unit,
                            DrawThrottle& throttle) {
  constexpr double kWeight = 0.3;  // of a fragment, beside one of a slab
  if (pair_.holds(slice)) return {};
  const std::array<std::int64_t, 3> slices{std::max<std::int64_t>(slice - 1, 0), slice,
                                           std::min(slice + 1, axis_.count() - 1)};
  for (const std::int64_t one : slices) {
    TIDEMARK_TRY(send(source, one, throttle));
  }
  pair_.begin(slice);
  vertices_.bind();
  gpu::begin_exact_drawing();
  program_.use();
  program_.set("source_scale", scale_);
  int next = unit;
  for (const auto& [name, one] :
       {std::pair{"stored_before", slices[0]}, {"stored", slices[1]}, {"stored_behind", slices[2]}}) {
    stored_[static_cast<std::size_t>(one % 3)].texture.bind(static_cast<unsigned>(next));
    program_.set(name, next++);
  }
  return throttle.rectangle(program_, part, kWeight, [](const gpu::TexelRect& piece) {
    const gpu::ScissorScope scissor(piece);
    gpu::draw(gpu::Primitive::triangles, 3);
  });
}

}  // namespace tidemark::renderer
