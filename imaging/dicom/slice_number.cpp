#include "imaging/dicom/slice_number.h"

#include <algorithm>

#include "imaging/series.h"

namespace tidemark::imaging {
namespace {

constexpr double kWhole = 1.0 - 1e-6;  // weights of neighbours are rounded

// The image that a slice of a planned grid repeats.
std::optional<std::int64_t> image_of(const GridSlice& slice) {
  const auto whole =
      std::find_if(slice.begin(), slice.end(), [](const auto& s) { return s.weight >= kWhole; });
  return whole == slice.end() ? std::nullopt : std::optional(whole->slice);
}

}  // namespace

std::vector<SliceNumber> slice_numbers(const Series& series) {
  std::vector<SliceNumber> of_images = series.numbers;
  if (series.files.size() == 1) {
    for (SliceNumber& number : of_images) number.instance.reset();
  }
  if (series.grid.slices.empty()) return of_images;
  std::vector<SliceNumber> numbers(series.grid.slices.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (const auto image = image_of(series.grid.slices[k])) {
      numbers[k] = of_images[static_cast<std::size_t>(*image)];
    }
  }
  return numbers;
}

}  // namespace tidemark::imaging
