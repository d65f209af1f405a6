#include "solver/stream/region_passes.h"

#include <algorithm>
#include <bit>

namespace tidemark {
namespace {

constexpr Substream kSubstreams[] = {Substream::interior, Substream::edges, Substream::corners};
constexpr std::int64_t kPageSide = 16;
constexpr int kPageLevel = 4;  // of mipmaps: one texel a page
constexpr std::int64_t kPlacesPerRow = GeometryEngine::kPlacesPerRow;

std::int64_t whole_rows(std::int64_t pages) {
  return (pages + kPlacesPerRow - 1) / kPlacesPerRow * kPlacesPerRow;
}

void bind(const gpu::Program& program, unsigned unit, const gpu::Texture2D& texture, const char* sampler) {
  texture.bind(unit);
  program.set(sampler, static_cast<int>(unit));
}

}  // namespace

void RegionPasses::use(const gpu::Program& program, const PhysicalMemory& memory) const {
  program.use();
  program.set("phi_texel", 1.0F / glm::vec2(memory.size()));
  program.set("place_texel", 1.0F / glm::vec2(size()));
}

std::vector<RegionPasses::Region> RegionPasses::regions(std::int64_t pages) const {
  std::vector<Region> regions;
  for (std::int64_t first = 0; first < pages; first += largest_region_) {
    regions.push_back({first, std::min(largest_region_, pages - first)});
  }
  return regions;
}

std::int64_t RegionPasses::pooled_bytes() const {
  std::int64_t bytes = 0;
  for (const gpu::Texture2D* texture :
       {&upwind_, &central_, &second_, &mixed_, &speed_terms_, &blocks_, &in_slice_, &slices_, &message_}) {
    bytes += texture->bytes();
  }
  return bytes;
}

Status RegionPasses::reserve(gpu::Device& device, std::int64_t pages) {
  using gpu::TexelFormat;
  const std::int64_t message_rows = whole_rows(std::max<std::int64_t>(pages, 1)) / kPlacesPerRow;
  if (message_.height() < message_rows) {
    auto message = gpu::Texture2D::create(device, TexelFormat::r8, kPlacesPerRow,
                                          message_rows + message_rows / 4, "message");
    if (!message) return pass_on(message);
    auto target = gpu::Framebuffer::create(device, {&*message}, "message");
    if (!target) return pass_on(target);
    message_ = std::move(*message);
    message_target_ = std::move(*target);
  }
  const auto wanted = static_cast<std::int64_t>(
      std::bit_ceil(static_cast<std::uint64_t>(std::max<std::int64_t>(pages, kPlacesPerRow))));
  const std::int64_t capacity = std::min(wanted, largest_region_);
  if (capacity <= capacity_ && capacity_ <= 4 * capacity) return {};

  const std::int64_t width = kPlacesPerRow * kPageSide;
  const std::int64_t height = capacity / kPlacesPerRow * kPageSide;
  struct Wanted {
    gpu::Texture2D& texture;
    TexelFormat format;
    std::int64_t divisor;
    bool mipmaps;
    const char* label;
  };
  for (const Wanted& w :
       {Wanted{upwind_, TexelFormat::rgba32f, 1, false, "upwind gradients"},
        Wanted{central_, TexelFormat::rgba32f, 1, false, "central differences"},
        Wanted{second_, TexelFormat::rgba32f, 1, false, "second differences"},
        Wanted{mixed_, TexelFormat::rgba32f, 1, false, "mixed differences"},
        Wanted{speed_terms_, TexelFormat::rgba32f, 1, false, "speed terms"},
        Wanted{blocks_, TexelFormat::rgba32f, 4, false, "motion of blocks"},
        Wanted{in_slice_, TexelFormat::rgba16f, 1, true, "neighbour information in the slice"},
        Wanted{slices_, TexelFormat::rgba16f, 1, true, "neighbour information across slices"}}) {
    capacity_ = 0;
    auto made =
        gpu::Texture2D::create(device, w.format, width / w.divisor, height / w.divisor, w.label, w.mipmaps);
    if (!made) return pass_on(made);
    if (w.mipmaps) made->limit_levels(kPageLevel);
    w.texture = std::move(*made);
  }
  auto differences =
      gpu::Framebuffer::create(device, {&upwind_, &central_, &second_, &mixed_}, "differences");
  auto speeds = gpu::Framebuffer::create(device, {&speed_terms_}, "speed terms");
  auto blocks = gpu::Framebuffer::create(device, {&blocks_}, "motion of blocks");
  auto neighbours = gpu::Framebuffer::create(device, {&in_slice_, &slices_}, "neighbour information");
  for (auto* made : {&differences, &speeds, &blocks, &neighbours}) {
    if (!*made) return pass_on(*made);
  }
  differences_target_ = std::move(*differences);
  speeds_target_ = std::move(*speeds);
  blocks_target_ = std::move(*blocks);
  neighbours_target_ = std::move(*neighbours);
  capacity_ = capacity;
  return {};
}

void RegionPasses::step(const GeometryEngine& geometry, const PhysicalMemory& memory,
                        const SourceTexture& source, const StepConstants<float>& constants, int now,
                        bool measure_motion) const {
  for (const Region region : regions(geometry.size())) {
    differentiate(geometry, memory, constants, now, measure_motion, region);
    compute_speeds(geometry, memory, source, constants, region);
    update(geometry, memory, constants, 1 - now, region);
    if (measure_motion) add_motion(geometry, memory, constants, 1 - now, region);
  }
}

void RegionPasses::differentiate(const GeometryEngine& geometry, const PhysicalMemory& memory,
                                 const StepConstants<float>& constants, int now, bool measure_motion,
                                 Region region) const {
  differences_target_.bind();
  for (std::size_t i = 0; i < derivatives_.size(); ++i) {
    const gpu::Program& program = derivatives_[i];
    use(program, memory);
    set_step_uniforms(program, constants);
    program.set("measure_motion", measure_motion ? 1 : 0);
    bind(program, 1, memory.field().phi(now), "phi_now");
    bind(program, 2, memory.field().phi(1 - now), "phi_before");
    geometry.draw(program, kSubstreams[i], region.first, region.count, size());
  }
}

void RegionPasses::compute_speeds(const GeometryEngine& geometry, const PhysicalMemory& memory,
                                  const SourceTexture& source, const StepConstants<float>& constants,
                                  Region region) const {
  speeds_target_.bind();
  use(speeds_, memory);
  set_step_uniforms(speeds_, constants);
  bind(speeds_, 1, upwind_, "upwind_buffer");
  bind(speeds_, 2, central_, "central_buffer");
  bind(speeds_, 3, second_, "second_buffer");
  bind(speeds_, 4, mixed_, "mixed_buffer");
  source.set_uniforms(speeds_, 5);
  geometry.draw(speeds_, Substream::whole_page, region.first, region.count, size());
}

void RegionPasses::update(const GeometryEngine& geometry, const PhysicalMemory& memory,
                          const StepConstants<float>& constants, int next, Region region) const {
  memory.draw_into(next);
  use(update_, memory);
  set_step_uniforms(update_, constants);
  bind(update_, 1, upwind_, "upwind_buffer");
  bind(update_, 2, speed_terms_, "speed_buffer");
  geometry.draw(update_, Substream::whole_page, region.first, region.count, memory.size());
}

void RegionPasses::add_motion(const GeometryEngine& geometry, const PhysicalMemory& memory,
                              const StepConstants<float>& constants, int next, Region region) const {
  blocks_target_.bind();
  use(motion_blocks_, memory);
  motion_blocks_.set("near", constants.near);
  bind(motion_blocks_, 1, memory.field().phi(next), "phi_next");
  bind(motion_blocks_, 2, central_, "central_buffer");
  geometry.draw(motion_blocks_, Substream::blocks, region.first, region.count, size() / 4);

  const gpu::BlendScope added(gpu::Blending::add);
  memory.draw_into_motion();
  use(motion_pages_, memory);
  bind(motion_pages_, 1, blocks_, "block_buffer");
  geometry.draw(motion_pages_, Substream::page_point, region.first, region.count, memory.motion_size());
}

Result<std::vector<PageMessage>> RegionPasses::message(const GeometryEngine& geometry,
                                                       const PhysicalMemory& memory, int buffer, float band,
                                                       float quiet_change) {
  for (const Region region : regions(geometry.size())) {
    note_neighbours(geometry, memory, buffer, band, region);
    encode(geometry, memory, quiet_change, region);
  }
  return read_message(geometry.size());
}

void RegionPasses::note_neighbours(const GeometryEngine& geometry, const PhysicalMemory& memory, int buffer,
                                   float band, Region region) const {
  neighbours_target_.bind();
  if (has_partial_pages_) gpu::clear_colours(2);  // padding, which is never drawn, gives notice of nothing
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    const gpu::Program& program = neighbours_[i];
    use(program, memory);
    program.set("band", band);
    bind(program, 1, memory.field().phi(buffer), "phi_now");
    geometry.draw(program, kSubstreams[i], region.first, region.count, size());
  }
}

void RegionPasses::encode(const GeometryEngine& geometry, const PhysicalMemory& memory, float quiet_change,
                          Region region) {
  in_slice_.generate_mipmaps();
  slices_.generate_mipmaps();
  message_target_.bind();
  use(code_, memory);
  code_.set("quiet_change", quiet_change);
  bind(code_, 1, in_slice_, "in_slice_buffer");
  bind(code_, 2, slices_, "slices_buffer");
  bind(code_, 3, memory.motion(), "motion_buffer");
  geometry.draw(code_, Substream::page_point, region.first, region.count,
                {message_.width(), message_.height()});
}

Result<std::vector<PageMessage>> RegionPasses::read_message(std::int64_t pages) const {
  const std::int64_t count = whole_rows(pages);
  std::vector<PageMessage> message(static_cast<std::size_t>(count));
  static_assert(sizeof(PageMessage) == 1);
  if (auto status = message_.download({0, 0, kPlacesPerRow, count / kPlacesPerRow},
                                      std::as_writable_bytes(std::span(message)));
      !status) {
    return pass_on(status);
  }
  message.resize(static_cast<std::size_t>(pages));
  return message;
}

}  // namespace tidemark
