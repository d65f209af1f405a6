#include "renderer/gl/slice_stack.h"

namespace tidemark::renderer {

Result<SliceStack> SliceStack::create(gpu::Device& device, const solver::PackedLayout& layout,
                                      const SliceAxis& axis) {
  SliceStack stack;
  stack.axis_ = axis;
  stack.pages_ = layout.layout();
  auto pair = SlicePair::create(device, axis, "slice of phi");
  if (!pair) return pass_on(pair);
  stack.pair_ = std::move(*pair);
  gpu::Defines defines = layout.defines();
  defines.push_back(axis.define());
  auto program = gpu::Program::render(device, "render/slice_phi.vert", "", "render/slice_phi.frag", defines);
  if (!program) return pass_on(program);
  stack.program_ = std::move(*program);
  stack.vertices_ = gpu::VertexArray::create(device);
  constexpr auto kEntry = static_cast<std::int64_t>(sizeof(std::int32_t));
  auto buffer = gpu::Buffer::create(device, stack.pages_.page_count() * kEntry, "pages of slices");
  if (!buffer) return pass_on(buffer);
  stack.list_buffer_ = std::move(*buffer);
  auto list =
      gpu::BufferTexture::create(device, stack.list_buffer_, gpu::TexelFormat::r32i, "pages of slices");
  if (!list) return pass_on(list);
  stack.list_ = std::move(*list);
  return stack;
}

void SliceStack::begin(std::span<const solver::PhysicalPage> table) {
  pair_.forget();
  std::vector<std::int32_t> list;
  layer_begins_.clear();
  const Index3 grid = pages_.pages();
  Index3 page(0);
  for (std::int64_t layer = 0; layer < grid[axis_.along]; ++layer) {
    layer_begins_.push_back(static_cast<std::int64_t>(list.size()));
    page[axis_.along] = layer;
    for (page[axis_.v()] = 0; page[axis_.v()] < grid[axis_.v()]; ++page[axis_.v()]) {
      for (page[axis_.u()] = 0; page[axis_.u()] < grid[axis_.u()]; ++page[axis_.u()]) {
        const std::int64_t number = pages_.page_number(page);
        if (table[static_cast<std::size_t>(number)] == solver::kOutsidePage) continue;
        list.push_back(static_cast<std::int32_t>(number));
      }
    }
  }
  layer_begins_.push_back(static_cast<std::int64_t>(list.size()));
  list_buffer_.upload_values<std::int32_t>(0, list);
}

Status SliceStack::reconstruct(const PhiPicture& phi, std::int64_t slice, int phi_unit, int list_unit,
                               DrawThrottle& throttle) {
  constexpr double kWeight = 0.5;  // of a fragment, beside one of a slab
  if (pair_.holds(slice)) return {};
  pair_.begin(slice);
  vertices_.bind();
  gpu::begin_exact_drawing();
  gpu::clear_colours(1, {static_cast<float>(-phi.band()), 0.0F, 0.0F, 0.0F});
  const Index3 shape = pages_.page_shape();
  const auto layer = static_cast<std::size_t>(slice / shape[axis_.along]);
  program_.use();
  phi.set_uniforms(program_, phi_unit);
  list_.bind(static_cast<unsigned>(list_unit));
  program_.set("shown_pages", list_unit);
  program_.set("slice", static_cast<int>(slice));
  const std::int64_t fragments = shape[axis_.u()] * shape[axis_.v()];
  const auto draw = [&](std::int64_t first, std::int64_t count) {
    program_.set("first_shown", static_cast<int>(layer_begins_[layer] + first));
    gpu::draw(gpu::Primitive::triangles, 6 * count);
  };
  return throttle.things(program_, layer_begins_[layer + 1] - layer_begins_[layer], fragments, kWeight, draw);
}

}  // namespace tidemark::renderer
