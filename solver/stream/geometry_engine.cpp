#include "solver/stream/geometry_engine.h"

#include <algorithm>

namespace tidemark::solver {
namespace {

// As resources/shaders/solver/stream/page_records.glsl reads it.
constexpr std::int64_t kRecordLength = 21;
constexpr unsigned kRecordsUnit = 0;

std::int32_t two_shorts(std::int64_t low, std::int64_t high) {
  return static_cast<std::int32_t>(low | high << 16);
}

std::int64_t vertices_per_page(Substream substream) {
  switch (substream) {
    case Substream::edges:
      return 8;
    case Substream::corners:
      return 4;
    case Substream::page_point:
      return 1;
    case Substream::interior:
    case Substream::whole_page:
    case Substream::blocks:
      break;
  }
  return 6;
}

gpu::Primitive primitive_of(Substream substream) {
  switch (substream) {
    case Substream::edges:
      return gpu::Primitive::lines;
    case Substream::corners:
    case Substream::page_point:
      return gpu::Primitive::points;
    case Substream::interior:
    case Substream::whole_page:
    case Substream::blocks:
      break;
  }
  return gpu::Primitive::triangles;
}

}  // namespace

GeometryEngine GeometryEngine::create(gpu::Device& device, const PackedLayout& layout) {
  GeometryEngine engine;
  engine.layout_ = layout;
  engine.vertices_ = gpu::VertexArray::create(device);
  return engine;
}

std::int64_t GeometryEngine::bytes_for(std::int64_t pages) {
  return pages * kRecordLength * 4;
}

std::int32_t GeometryEngine::address(PhysicalPage page) const {
  return two_shorts(page % layout_.pages_per_row(), layout_.row(page));
}

void GeometryEngine::append(const PagedMemory<3>& memory, PhysicalPage page) {
  const PageLayout& layout = memory.layout();
  const std::int64_t number = memory.virtual_page(page);
  const Index3 coordinates = layout.page_coordinates(number);
  // Beyond the volume's border lies the page on this side of it; the vertex stage clamps the texel.
  const auto there = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    const Index3 other = glm::clamp(coordinates + Index3(x, y, z), Index3(0), layout.pages() - Index3(1));
    return address(memory.physical(other));
  };
  for (std::int64_t y = -1; y <= 1; ++y) {
    for (std::int64_t x = -1; x <= 1; ++x) staging_.push_back(there(x, y, 0));
  }
  for (const std::int64_t z : {-1, 1}) {
    for (const auto& [x, y] : {std::pair{0, -1}, {-1, 0}, {0, 0}, {1, 0}, {0, 1}})
      staging_.push_back(there(x, y, z));
  }
  const Index3 voxel = layout.first_voxel(number);
  staging_.push_back(two_shorts(voxel.x, voxel.y));
  staging_.push_back(static_cast<std::int32_t>(voxel.z));
  const Index3 valid = layout.valid_shape(number);
  voxels_ += valid.x * valid.y * valid.z;
}

Status GeometryEngine::describe(gpu::Device& device, const PagedMemory<3>& memory,
                                std::span<const PhysicalPage> pages) {
  staging_.clear();
  staging_.reserve(pages.size() * kRecordLength);
  voxels_ = 0;
  for (const PhysicalPage page : pages) append(memory, page);
  size_ = static_cast<std::int64_t>(pages.size());
  if (bytes_for(size_) > buffer_.bytes()) {
    constexpr std::int64_t kFewPages = 64;
    auto buffer =
        gpu::Buffer::create(device, bytes_for(size_ + std::max(size_ / 8, kFewPages)), "page records");
    if (!buffer) return pass_on(buffer);
    auto records = gpu::BufferTexture::create(device, *buffer, gpu::TexelFormat::r32i, "page records");
    if (!records) return pass_on(records);
    records_ = std::move(*records);
    buffer_ = std::move(*buffer);
  }
  buffer_.upload_values<std::int32_t>(0, staging_);
  return {};
}

void GeometryEngine::draw(const gpu::Program& program, Substream substream, std::int64_t first,
                          std::int64_t count, glm::ivec2 target_size) const {
  layout_.set_uniforms(program);
  records_.bind(kRecordsUnit);
  program.set("page_records", static_cast<int>(kRecordsUnit));
  program.set("first_page", static_cast<int>(first));
  program.set("target_size", target_size);
  vertices_.bind();
  gpu::draw(primitive_of(substream), count * vertices_per_page(substream));
}

const char* GeometryEngine::vertex_shader(Substream substream) {
  return substream == Substream::page_point ? "solver/stream/page_points.vert" : "solver/stream/pages.vert";
}

gpu::Defines GeometryEngine::defines(Substream substream) const {
  constexpr const char* kNames[] = {"INTERIOR", "EDGES", "CORNERS", "WHOLE", "QUARTERS", "PAGE_POINT"};
  gpu::Defines defines = layout_.defines();
  defines.emplace_back(kNames[static_cast<int>(substream)], "");
  return defines;
}

}  // namespace tidemark::solver
