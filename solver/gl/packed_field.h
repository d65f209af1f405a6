// Physical memory G (paper section 3.2): phi of the resident pages, packed in 2D textures, or in layers of
// them where one texture cannot hold it.
#pragma once

#include <span>
#include <vector>

#include "solver/field.h"
#include "solver/gl/packed_textures.h"

namespace tidemark::solver {

// Textures of R32F: two where a step reads phi from one and writes it to the other, one for pictures.
// Physical pages 0 and 1 hold the constants that stand for everything that is not resident, -W and W.
class PackedField {
 public:
  PackedField() = default;
  // Room for at least `capacity` physical pages, the static ones included. Fails (ErrorKind::capability) when
  // the driver's textures or its memory are too small.
  static Result<PackedField> create(gpu::Device& device, const PackedLayout& layout, std::int64_t capacity,
                                    float band, int buffers = 2);

  // Enlarges G by copy. On failure it is as before.
  Status grow(gpu::Device& device, std::int64_t capacity) { return textures_.grow(device, capacity); }

  [[nodiscard]] const PackedLayout& layout() const { return textures_.layout(); }
  [[nodiscard]] std::int64_t capacity() const { return textures_.capacity(); }
  [[nodiscard]] std::int64_t bytes() const { return textures_.bytes(); }
  [[nodiscard]] const gpu::TextureLayers& phi(int buffer) const {
    return textures_[static_cast<std::size_t>(buffer)];
  }

  // Writes pages kFirstPage, kFirstPage + 1, ... of all buffers: the stored ones in the order of their
  // virtual numbers.
  void upload(const SharedPages& pages);
  // Writes the tile of one page in one buffer.
  void upload_page(PhysicalPage page, std::span<const float> tile, int buffer);
  // The voxels of all physical pages, in the same order, page 0 first. Waits for the GPU.
  Result<std::vector<float>> download(int buffer) const;

 private:
  void write_static_pages(float band);

  PackedTextures textures_;
};

// Makes `phi` what a page table says, from the voxels of all physical pages as PackedField::download() gives
// them. Pages that are as they were stay where they lie.
void update(Field& phi, std::span<const PhysicalPage> table, std::span<const float> physical);

}  // namespace tidemark::solver
