#include <itkImage.h>
#include <itkRecursiveGaussianImageFilter.h>

#include <algorithm>
#include <cmath>

#include "imaging/filters/filters.h"
#include "imaging/filters/separable_gaussian.h"

namespace tidemark::imaging {
namespace {

using FloatImage = itk::Image<float, 3>;

// ITK's recursive filter needs four voxels along the axis, and its fit to the Gaussian gets poor below one
// voxel of sigma; there a direct sum is short anyway.
constexpr std::int64_t kShortestRecursive = 4;
constexpr double kSmallestRecursiveSigma = 1.5;

// An ITK image over our values, which it neither copies nor owns.
FloatImage::Pointer wrap(std::vector<float>& values, const Geometry& geometry) {
  const auto image = FloatImage::New();
  FloatImage::RegionType region;
  FloatImage::SpacingType spacing;
  for (unsigned axis = 0; axis < 3; ++axis) {
    region.SetSize(axis, static_cast<itk::SizeValueType>(geometry.size[static_cast<int>(axis)]));
    spacing[axis] = geometry.spacing_mm[static_cast<int>(axis)];
  }
  image->SetRegions(region);
  image->SetSpacing(spacing);
  image->GetPixelContainer()->SetImportPointer(values.data(), values.size(), false);
  return image;
}

void smooth_recursively(std::vector<float>& values, const Geometry& geometry, int axis, double sigma_mm) {
  const auto filter = itk::RecursiveGaussianImageFilter<FloatImage, FloatImage>::New();
  filter->SetInput(wrap(values, geometry));
  filter->SetDirection(static_cast<unsigned>(axis));
  filter->SetSigma(sigma_mm);
  filter->SetZeroOrder();
  filter->InPlaceOn();
  filter->Update();
  const float* result = filter->GetOutput()->GetBufferPointer();
  if (result != values.data()) std::copy_n(result, values.size(), values.data());
}

}  // namespace

Result<Volume> smooth(const Volume& volume, double sigma_mm, const Progress& progress) {
  if (!std::isfinite(sigma_mm) || sigma_mm <= 0.0) {
    return fail(ErrorKind::usage, "smoothing: sigma must be a length above 0 mm, not {}", sigma_mm);
  }
  Volume result;
  result.geometry = volume.geometry;
  result.modality = volume.modality;
  result.unit = volume.unit;
  result.description = volume.description;
  result.window = volume.window;
  result.changes = volume.changes;
  try {
    std::vector<float> values = volume.values();
    for (int axis = 0; axis < 3; ++axis) {
      if (progress.cancelled()) return cancelled_error();
      progress(axis / 3.0, "smoothing");
      const double sigma_voxels = sigma_mm / volume.geometry.spacing_mm[axis];
      if (volume.geometry.size[axis] < kShortestRecursive || sigma_voxels < kSmallestRecursiveSigma) {
        convolve_axis(values, volume.geometry.size, axis, sigma_voxels);
      } else {
        smooth_recursively(values, volume.geometry, axis, sigma_mm);
      }
    }
    result.voxels = std::move(values);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "smoothing: not enough memory for {} voxels",
                volume.geometry.voxel_count());
  } catch (const std::exception& exception) {
    return fail(ErrorKind::internal, "smoothing: {}", exception.what());
  }
  return result;
}

}  // namespace tidemark::imaging
