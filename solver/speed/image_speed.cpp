// A map that was made elsewhere, such as a neural network's probabilities, as D.
#include "solver/speed/image_speed.h"

#include <algorithm>
#include <cmath>

#include "core/typed_volume.h"
#include "solver/speed/speed_kinds.h"

namespace tidemark::solver {
namespace {

// Resampled and rescaled values leave their range by rounding.
constexpr float kRounding = 1e-4F;

enum Form { by_values = 0, probability = 1, is_speed = 2 };

class ImageSpeed final : public SpeedFunction {
 public:
  // D = factor * value + shift.
  ImageSpeed(std::shared_ptr<const Volume> map, double factor, double shift)
      : map_(std::move(map)), factor_(factor), shift_(shift) {}

  void evaluate(const VoxelBox& box, double* speed) const override {
    with_type(*map_, [&](const auto& map) {
      for (std::int64_t z = 0; z < box.size.z; ++z) {
        for (std::int64_t y = 0; y < box.size.y; ++y) {
          const std::int64_t row = map.geometry.offset(box.first + Index3(0, y, z));
          for (std::int64_t x = 0; x < box.size.x; ++x) {
            *speed++ = std::clamp(factor_ * static_cast<double>(map.value(row + x)) + shift_, -1.0, 1.0);
          }
        }
      }
    });
  }

 private:
  std::shared_ptr<const Volume> map_;
  double factor_;
  double shift_;
};

// Fails on values outside of [low, 1], naming the first voxel.
Status check_values(const Volume& map, float low) {
  return with_type(map, [&](const auto& typed) -> Status {
    const std::int64_t count = map.geometry.voxel_count();
    for (std::int64_t i = 0; i < count; ++i) {
      const float value = typed.value(i);
      if (value >= low - kRounding && value <= 1.0F + kRounding) continue;
      const Index3 v = map.geometry.voxel_at(i);
      return fail(ErrorKind::input,
                  "the map of the speed function image: voxel ({}, {}, {}) is {}, not between {} and 1", v.x,
                  v.y, v.z, value, low);
    }
    return {};
  });
}

Result<std::shared_ptr<const SpeedFunction>> make_image(const SpeedInputs& inputs,
                                                        const std::map<std::string, double>& values,
                                                        const Progress& /*progress*/) {
  const Volume& map = *inputs.map;
  const Index3 size = map.geometry.size;
  const Index3 grid = inputs.source->geometry.size;
  if (size != grid) {
    return fail(ErrorKind::usage,
                "the map of the speed function image has {} x {} x {} voxels, the volume has {} x {} x {}",
                size.x, size.y, size.z, grid.x, grid.y, grid.z);
  }
  TIDEMARK_TRY(require_finite(map, "the map of the speed function image"));
  const auto form = std::lround(values.at("form"));
  const bool has_speed = form == is_speed || (form == by_values && holds_speed(map));
  TIDEMARK_TRY(check_values(map, has_speed ? -1.0F : 0.0F));
  return std::make_shared<ImageSpeed>(inputs.map, has_speed ? 1.0 : 2.0, has_speed ? 0.0 : -1.0);
}

}  // namespace

bool holds_speed(const Volume& map) {
  return map.range().first < -kRounding;
}

const SpeedKind& image_kind() {
  static const SpeedKind kind{
      .name = "image",
      .title = "Map",
      .text =
          "Follows a map that was made elsewhere: grows where it says inside, and shrinks where it says "
          "outside.",
      .needs_map = true,
      .parameters = {{.name = "form",
                      .title = "Values",
                      .text = "What the map holds. By its values: a speed where any is below 0.",
                      .unit = "",
                      .low = by_values,
                      .high = is_speed,
                      .initial = by_values,
                      .choices = {{"by-values", "By its values"},
                                  {"probability", "Probability, 0 to 1"},
                                  {"speed", "Speed, -1 to 1"}}}},
      .make = make_image,
      .cached = false};
  return kind;
}

}  // namespace tidemark::solver
