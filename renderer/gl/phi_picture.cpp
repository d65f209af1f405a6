#include "renderer/gl/phi_picture.h"

#include <algorithm>

#include "gpu/framebuffer.h"

namespace tidemark::renderer {
Result<PhiPicture::Array> PhiPicture::Array::create(gpu::Device& device, std::int64_t texels,
                                                    gpu::TexelFormat format, std::string_view label) {
  Array array;
  auto buffer = gpu::Buffer::create(device, texels * gpu::bytes_per_texel(format), label);
  if (!buffer) return pass_on(buffer);
  array.buffer = std::move(*buffer);
  auto texture = gpu::BufferTexture::create(device, array.buffer, format, label);
  if (!texture) return pass_on(texture);
  array.texture = std::move(*texture);
  return array;
}

Result<PhiPicture> PhiPicture::create(gpu::Device& device, const PageLayout& layout, double band) {
  PhiPicture picture;
  const solver::PackedLayout packed(layout, device.capabilities());
  auto field = solver::PackedField::create(device, packed, packed.without_power_of_two(solver::kFirstPage),
                                           static_cast<float>(band), 1);
  if (!field) return pass_on(field);
  picture.field_ = std::move(*field);
  picture.pages_ = solver::PagedMemory<3>(layout, solver::kUnlimited);
  picture.band_ = band;
  picture.shown_ = SharedPages(layout.page_count(), layout.voxels_per_page());
  auto table = Array::create(device, layout.page_count(), gpu::TexelFormat::r32i, "page table");
  if (!table) return pass_on(table);
  picture.page_table_ = std::move(*table);
  auto flags = Array::create(device, layout.page_count(), gpu::TexelFormat::r32i, "page flags");
  if (!flags) return pass_on(flags);
  picture.page_flags_ = std::move(*flags);
  auto scatter =
      gpu::Program::render(device, "render/scatter.vert", "", "render/scatter.frag", packed.defines());
  if (!scatter) return pass_on(scatter);
  picture.scatter_ = std::move(*scatter);
  picture.vertices_ = gpu::VertexArray::create(device);
  constexpr std::int64_t kMostStaged = 8192;  // 16 MB of the default pages
  picture.most_staged_ = std::clamp<std::int64_t>(
      device.capabilities().largest_buffer_texture / layout.voxels_per_page(), 1, kMostStaged);
  return picture;
}

// Makes the page table that of `phi`, and finds the pages that differ from what was shown.
std::vector<PhiPicture::Change> PhiPicture::follow(const solver::Field& phi) {
  std::vector<std::int64_t> stored;
  const auto look_at = [&](std::int64_t page) {
    const solver::Field::Kind kind = phi.pages.kind(page);
    const bool is_inside = kind == solver::Field::Kind::inside;
    if (kind == solver::Field::Kind::stored) {
      stored.push_back(page);
    } else if (solver::is_static_page(pages_.physical(page))) {
      pages_.set_static(page, is_inside);
    } else {
      pages_.release(page, is_inside);
    }
  };
  if (shown_) {
    SharedPages::for_each_difference(*shown_, phi.pages, look_at);
  } else {
    for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) look_at(page);
  }
  // After the freed ones, so that their room is used again.
  new_pages_.clear();
  std::vector<Change> changes;
  for (const std::int64_t page : stored) {
    solver::PhysicalPage physical = pages_.physical(page);
    if (solver::is_static_page(physical)) {
      physical = pages_.make_resident(page).value();
      new_pages_.push_back(page);
    }
    changes.push_back({page, physical});
  }
  return changes;
}

Status PhiPicture::update(gpu::Device& device, const solver::Field& phi,
                          std::span<const std::int64_t> quiet) {
  const std::vector<Change> changes = follow(phi);
  // Until everything is up there, nothing counts as shown.
  shown_.reset();
  if (pages_.table().capacity() > field_.capacity()) {
    // By a quarter more than needed: a growing surface does not copy G with every picture.
    const std::int64_t needed = pages_.table().capacity();
    TIDEMARK_TRY(
        field_.grow(device, layout().without_power_of_two(layout().ample(needed, needed + needed / 4))));
  }
  for (std::size_t first = 0; first < changes.size(); first += static_cast<std::size_t>(most_staged_)) {
    const std::size_t count = std::min(changes.size() - first, static_cast<std::size_t>(most_staged_));
    TIDEMARK_TRY(upload(device, phi, std::span(changes).subspan(first, count)));
  }
  pages_uploaded_ = static_cast<std::int64_t>(changes.size());
  upload_tables(quiet);
  viewed_.reset();
  shown_ = phi.pages;
  return device.check("sending phi to the pictures");
}

Status PhiPicture::upload(gpu::Device& device, const solver::Field& phi, std::span<const Change> changes) {
  const std::int64_t voxels = phi.layout.voxels_per_page();
  const auto count = static_cast<std::int64_t>(changes.size());
  std::vector<float> tiles(static_cast<std::size_t>(count * voxels));
  std::vector<std::int32_t> addresses;
  for (std::int64_t i = 0; i < count; ++i) {
    const Change& change = changes[static_cast<std::size_t>(i)];
    layout().pack(phi.pages.values(change.page), tiles.data() + i * voxels, layout().tile().x);
    addresses.push_back(change.physical);
  }
  auto staged = Array::create(device, count * voxels, gpu::TexelFormat::r32f, "changed pages");
  if (!staged) return pass_on(staged);
  staged->buffer.upload_values<float>(0, tiles);
  auto places = Array::create(device, count, gpu::TexelFormat::r32i, "addresses of changed pages");
  if (!places) return pass_on(places);
  places->buffer.upload_values<std::int32_t>(0, addresses);

  const gpu::TextureLayers& memory = field_.phi(0);
  vertices_.bind();
  scatter_.use();
  layout().set_uniforms(scatter_);
  staged->texture.bind(0);
  scatter_.set("staged", 0);
  places->texture.bind(1);
  scatter_.set("addresses", 1);
  scatter_.set("texture_size", glm::vec2(memory.width(), memory.height()));
  gpu::begin_exact_drawing();
  for (std::int64_t layer = 0; layer < memory.layers(); ++layer) {
    auto framebuffer =
        gpu::Framebuffer::create_on_layer(device, layer, {&memory}, "physical memory of pictures");
    if (!framebuffer) return pass_on(framebuffer);
    framebuffer->bind();
    scatter_.set("target_layer", static_cast<int>(layer));
    gpu::draw(gpu::Primitive::triangles, 6 * count);
  }
  return {};
}

void PhiPicture::upload_tables(std::span<const std::int64_t> quiet) {
  page_table_.buffer.upload_values<std::int32_t>(0, pages_.table().entries());
  upload_flags(quiet, pages_.table().resident());
}

void PhiPicture::upload_flags(std::span<const std::int64_t> quiet, std::int64_t resident) {
  constexpr std::int32_t kQuiet = 1;  // as in render/page_state.glsl
  constexpr std::int32_t kNew = 2;
  std::vector<std::int32_t> flags(static_cast<std::size_t>(layout().layout().page_count()));
  for (const std::int64_t page : quiet) flags[static_cast<std::size_t>(page)] |= kQuiet;
  // At first everything is new, which tells nothing.
  if (static_cast<std::int64_t>(new_pages_.size()) < resident) {
    for (const std::int64_t page : new_pages_) flags[static_cast<std::size_t>(page)] |= kNew;
  }
  page_flags_.buffer.upload_values<std::int32_t>(0, flags);
}

Status PhiPicture::look_at(gpu::Device& device, const solver::PackedView& view,
                           const std::optional<std::vector<std::int64_t>>& quiet) {
  // Executors give their buffer a new place when it grows.
  auto table =
      gpu::BufferTexture::create(device, *view.page_table, gpu::TexelFormat::r32i, "executor's page table");
  if (!table) return pass_on(table);
  std::vector<solver::PhysicalPage> before =
      viewed_ ? std::move(viewed_->entries) : std::vector<solver::PhysicalPage>();
  viewed_ = Viewed{view, std::move(*table), {}};
  pages_uploaded_ = 0;
  if (!quiet) {
    viewed_->entries = std::move(before);
    return {};
  }
  viewed_->entries = page_entries();
  new_pages_.clear();
  std::int64_t resident = 0;
  for (std::size_t page = 0; page < viewed_->entries.size(); ++page) {
    if (solver::is_static_page(viewed_->entries[page])) continue;
    ++resident;
    if (before.empty() || solver::is_static_page(before[page]))
      new_pages_.push_back(static_cast<std::int64_t>(page));
  }
  upload_flags(*quiet, resident);
  return device.check("looking at the executor's pages");
}

std::vector<solver::PhysicalPage> PhiPicture::page_entries() const {
  if (!viewed_) return pages_.table().entries();
  return viewed_->view.page_table->download_values<solver::PhysicalPage>(0, layout().layout().page_count());
}

void PhiPicture::set_uniforms(const gpu::Program& program, int unit) const {
  layout().set_uniforms(program);
  const gpu::TextureLayers& phi = viewed_ ? *viewed_->view.phi : field_.phi(0);
  phi.bind(static_cast<unsigned>(unit));
  program.set("phi_pages", unit);
  program.set("phi_texel", 1.0F / glm::vec2(phi.width(), phi.height()));
  (viewed_ ? viewed_->table : page_table_.texture).bind(static_cast<unsigned>(unit + 1));
  program.set("page_table", unit + 1);
  page_flags_.texture.bind(static_cast<unsigned>(unit + 2));
  program.set("page_flags", unit + 2);
  program.set("band", static_cast<float>(band_));
}

}  // namespace tidemark::renderer
