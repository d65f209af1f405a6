#include "solver/stream/region_passes.h"

#include <algorithm>
#include <bit>
#include <glm/gtc/packing.hpp>

#include "solver/stream/pass_record.h"

namespace tidemark::solver {
namespace {

constexpr Substream kSubstreams[] = {Substream::interior, Substream::edges, Substream::corners};
constexpr int kPageLevel = 2;  // of mipmaps: one texel a page, from 4 x 4 blocks

std::int64_t whole_rows(std::int64_t pages) {
  return (pages + GeometryEngine::kPlacesPerRow - 1) / GeometryEngine::kPlacesPerRow *
         GeometryEngine::kPlacesPerRow;
}

template <class Texture>
void bind(const gpu::Program& program, unsigned unit, const Texture& texture, const char* sampler) {
  texture.bind(unit);
  program.set(sampler, static_cast<int>(unit));
}

}  // namespace

void RegionPasses::use(const gpu::Program& program, const PhysicalMemory& memory) const {
  program.use();
  program.set("phi_texel", 1.0F / glm::vec2(memory.size()));
  program.set("place_texel", 1.0F / glm::vec2(size()));
}

// The program is in use. Each layer clips the pages of the others.
void RegionPasses::draw_into_memory(const gpu::Program& program, const GeometryEngine& geometry,
                                    Region region, const PhysicalMemory& memory,
                                    PhysicalMemory::Target target) {
  for (std::int64_t layer = 0; layer < memory.layers(); ++layer) {
    memory.draw_into(target, layer);
    program.set("target_layer", static_cast<int>(layer));
    geometry.draw(program, Substream::whole_page, region.first, region.count, memory.size());
  }
}

std::vector<RegionPasses::Region> RegionPasses::regions(std::int64_t pages, std::int64_t largest) {
  std::vector<Region> regions;
  for (std::int64_t first = 0; first < pages; first += largest) {
    regions.push_back({first, std::min(largest, pages - first)});
  }
  return regions;
}

// How many pages of intermediate buffers a list needs; as many as there are while these do.
std::int64_t RegionPasses::pool_size(std::int64_t pages, std::int64_t largest, std::int64_t present) {
  const auto wanted = static_cast<std::int64_t>(std::bit_ceil(
      static_cast<std::uint64_t>(std::max<std::int64_t>(pages, GeometryEngine::kPlacesPerRow))));
  const std::int64_t size = std::min(wanted, largest);
  return size <= present && present <= 4 * size ? present : size;
}

Status RegionPasses::make_pool(gpu::Device& device, std::int64_t pages,
                               std::initializer_list<Pooled> textures) {
  const std::int64_t width = GeometryEngine::kPlacesPerRow * GeometryEngine::kPageSide;
  const std::int64_t height = pages / GeometryEngine::kPlacesPerRow * GeometryEngine::kPageSide;
  for (const Pooled& pooled : textures) {
    auto made = gpu::Texture2D::create(device, pooled.format, width / pooled.divisor, height / pooled.divisor,
                                       pooled.label, pooled.mipmaps);
    if (!made) return pass_on(made);
    if (pooled.mipmaps) made->limit_levels(kPageLevel);
    pooled.texture = std::move(*made);
  }
  return {};
}

Status RegionPasses::reserve(gpu::Device& device, std::int64_t pages) {
  TIDEMARK_TRY(reserve_message(device, pages));
  const std::int64_t capacity = pool_size(pages, largest_region_, capacity_);
  if (capacity == capacity_) return {};
  using gpu::TexelFormat;
  capacity_ = 0;
  TIDEMARK_TRY(make_pool(device, capacity,
                         {{upwind_, gpu::TexelFormat::rgba32f, 1, false, "upwind gradients"},
                          {central_, gpu::TexelFormat::rgba32f, 1, false, "central differences"},
                          {second_, gpu::TexelFormat::rgba32f, 1, false, "second differences"},
                          {mixed_, gpu::TexelFormat::rgba32f, 1, false, "mixed differences"},
                          {speed_terms_, gpu::TexelFormat::rgba32f, 1, false, "speed terms"},
                          {blocks_, gpu::TexelFormat::rgba32f, 4, false, "motion of blocks"}}));
  auto differences =
      gpu::Framebuffer::create(device, {&upwind_, &central_, &second_, &mixed_}, "differences");
  auto speeds = gpu::Framebuffer::create(device, {&speed_terms_}, "speed terms");
  auto blocks = gpu::Framebuffer::create(device, {&blocks_}, "motion of blocks");
  for (auto* made : {&differences, &speeds, &blocks}) {
    if (!*made) return pass_on(*made);
  }
  differences_target_ = std::move(*differences);
  speeds_target_ = std::move(*speeds);
  blocks_target_ = std::move(*blocks);
  capacity_ = capacity;
  return {};
}

Status RegionPasses::reserve_message(gpu::Device& device, std::int64_t pages) {
  using gpu::TexelFormat;
  const std::int64_t message_rows =
      whole_rows(std::max<std::int64_t>(pages, 1)) / GeometryEngine::kPlacesPerRow;
  if (message_.height() < message_rows) {
    auto message = gpu::Texture2D::create(device, gpu::TexelFormat::r8, GeometryEngine::kPlacesPerRow,
                                          message_rows + message_rows / 4, "message");
    if (!message) return pass_on(message);
    auto target = gpu::Framebuffer::create(device, {&*message}, "message");
    if (!target) return pass_on(target);
    message_ = std::move(*message);
    message_target_ = std::move(*target);
  }
  const std::int64_t capacity = pool_size(pages, kLargestMessage, message_capacity_);
  if (capacity == message_capacity_) return {};
  message_capacity_ = 0;
  TIDEMARK_TRY(make_pool(device, capacity,
                         {{in_slice_, gpu::TexelFormat::rgba16f, 4, true, "neighbours in the slice"},
                          {slices_, gpu::TexelFormat::rgba16f, 4, true, "neighbours across slices"}}));
  auto neighbours = gpu::Framebuffer::create(device, {&in_slice_, &slices_}, "neighbour information");
  if (!neighbours) return pass_on(neighbours);
  neighbours_target_ = std::move(*neighbours);
  message_capacity_ = capacity;
  return {};
}

void RegionPasses::step(const GeometryEngine& geometry, const PhysicalMemory& memory,
                        const DriveTextures& drive, const StepConstants<float>& constants, int now,
                        bool measure_motion) const {
  for (const Region region : regions(geometry.size(), largest_region_)) {
    differentiate(geometry, memory, constants, now, measure_motion, region);
    compute_speeds(geometry, memory, drive, constants, region);
    update(geometry, memory, drive, constants, 1 - now, region);
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
                                  const DriveTextures& drive, const StepConstants<float>& constants,
                                  Region region) const {
  speeds_target_.bind();
  use(speeds_, memory);
  set_step_uniforms(speeds_, constants);
  bind(speeds_, 1, upwind_, "upwind_buffer");
  bind(speeds_, 2, central_, "central_buffer");
  bind(speeds_, 3, second_, "second_buffer");
  bind(speeds_, 4, mixed_, "mixed_buffer");
  drive.set_uniforms(speeds_, 5);
  geometry.draw(speeds_, Substream::whole_page, region.first, region.count, size());
}

void RegionPasses::update(const GeometryEngine& geometry, const PhysicalMemory& memory,
                          const DriveTextures& drive, const StepConstants<float>& constants, int next,
                          Region region) const {
  use(update_, memory);
  set_step_uniforms(update_, constants);
  bind(update_, 1, upwind_, "upwind_buffer");
  bind(update_, 2, speed_terms_, "speed_buffer");
  drive.set_constraint_uniforms(update_, 3);
  draw_into_memory(update_, geometry, region, memory, PhysicalMemory::target(next));
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
  for (const Region region : regions(geometry.size(), kLargestMessage)) {
    note_neighbours(geometry, memory, buffer, band, region);
    encode(geometry, memory, quiet_change, region);
  }
  return read_message(geometry.size());
}

void RegionPasses::note_neighbours(const GeometryEngine& geometry, const PhysicalMemory& memory, int buffer,
                                   float band, Region region) const {
  neighbours_target_.bind();
  use(neighbours_, memory);
  neighbours_.set("band", band);
  bind(neighbours_, 1, memory.field().phi(buffer), "phi_now");
  geometry.draw(neighbours_, Substream::blocks, region.first, region.count,
                {in_slice_.width(), in_slice_.height()});
}

void RegionPasses::encode(const GeometryEngine& geometry, const PhysicalMemory& memory, float quiet_change,
                          Region region) {
  in_slice_.generate_mipmaps();
  slices_.generate_mipmaps();
  message_target_.bind();
  use(page_message_, memory);
  page_message_.set("quiet_change", quiet_change);
  bind(page_message_, 1, in_slice_, "in_slice_buffer");
  bind(page_message_, 2, slices_, "slices_buffer");
  bind(page_message_, 3, memory.motion(), "motion_buffer");
  geometry.draw(page_message_, Substream::page_point, region.first, region.count,
                {message_.width(), message_.height()});
}

Result<std::vector<PageMessage>> RegionPasses::read_message(std::int64_t pages) const {
  const std::int64_t count = whole_rows(pages);
  std::vector<PageMessage> message(static_cast<std::size_t>(count));
  static_assert(sizeof(PageMessage) == 1);
  TIDEMARK_TRY(message_.download({0, 0, GeometryEngine::kPlacesPerRow, count / GeometryEngine::kPlacesPerRow},
                                 std::as_writable_bytes(std::span(message))));
  message.resize(static_cast<std::size_t>(pages));
  return message;
}

Status RegionPasses::read_first_page(PassRecord& record) const {
  constexpr gpu::TexelRect kPage{0, 0, GeometryEngine::kPageSide, GeometryEngine::kPageSide};
  const auto read = [&](const gpu::Texture2D& texture, std::vector<glm::vec4>& values) {
    values.resize(GeometryEngine::kPageSide * GeometryEngine::kPageSide);
    return texture.download(kPage, std::as_writable_bytes(std::span(values)));
  };
  const gpu::Texture2D* differences[] = {&upwind_, &central_, &second_, &mixed_};
  for (std::size_t i = 0; i < record.differences.size(); ++i)
    TIDEMARK_TRY(read(*differences[i], record.differences[i]));
  TIDEMARK_TRY(read(speed_terms_, record.speeds));
  const auto read_blocks = [&](const gpu::Texture2D& texture, std::vector<glm::vec4>& values) -> Status {
    constexpr std::int64_t kBlocks = PassRecord::kBlocks;
    std::array<glm::u16vec4, kBlocks * kBlocks> halves{};
    TIDEMARK_TRY(texture.download({0, 0, kBlocks, kBlocks}, std::as_writable_bytes(std::span(halves))));
    for (const glm::u16vec4& half : halves) values.push_back(glm::unpackHalf(half));
    return {};
  };
  TIDEMARK_TRY(read_blocks(in_slice_, record.across_in_slice));
  return read_blocks(slices_, record.across_slices);
}

}  // namespace tidemark::solver
