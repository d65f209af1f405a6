#include "imaging/regions/staple.h"

#include <itkImage.h>
#include <itkSTAPLEImageFilter.h>

#include <glm/common.hpp>

#include "core/index_walk.h"

namespace tidemark::imaging {
namespace {

using ReaderImage = itk::Image<std::uint8_t, 3>;
using Likelihood = itk::Image<double, 3>;

ReaderImage::Pointer image_of(const Region& region, const VoxelRange& box) {
  const auto image = ReaderImage::New();
  const Index3 size = box.high - box.low;
  ReaderImage::RegionType all;
  for (int axis = 0; axis < 3; ++axis)
    all.SetSize(static_cast<unsigned>(axis), static_cast<itk::SizeValueType>(size[axis]));
  image->SetRegions(all);
  image->Allocate(true);
  std::uint8_t* const voxels = image->GetBufferPointer();
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    const Index3 at = voxel - box.low;
    std::fill_n(voxels + (at.z * size.y + at.y) * size.x + at.x, length, std::uint8_t{1});
  });
  return image;
}

}  // namespace

Result<TruthEstimate> estimate_truth(const std::vector<Region>& readers, const Geometry& grid,
                                     const Progress& progress) {
  if (readers.size() < 2)
    return fail(ErrorKind::usage, "an estimate of the truth needs at least two readers");
  VoxelRange around{grid.size, Index3(0)};
  for (const Region& reader : readers) {
    const VoxelRange bounds = reader.bounds();
    if (bounds.empty()) continue;
    around = {glm::min(around.low, bounds.low), glm::max(around.high, bounds.high)};
  }
  if (around.empty()) return fail(ErrorKind::usage, "no reader has drawn anything");
  const VoxelRange box =
      around.widened(glm::max((around.high - around.low) / std::int64_t{10}, Index3(1)), grid.size);

  const auto filter = itk::STAPLEImageFilter<ReaderImage, Likelihood>::New();
  for (std::size_t n = 0; n < readers.size(); ++n)
    filter->SetInput(static_cast<unsigned>(n), image_of(readers[n], box));
  filter->SetForegroundValue(1);
  filter->AddObserver(itk::IterationEvent(), [&](const itk::EventObject&) {
    if (progress.cancelled()) filter->AbortGenerateDataOn();
  });
  filter->Update();
  if (progress.cancelled()) return cancelled_error();

  TruthEstimate estimate{Region(box), {}};
  const double* likelihood = filter->GetOutput()->GetBufferPointer();
  for_each_index(box.low, box.high, [&](Index3 voxel) {
    if (*likelihood++ > 0.5) estimate.region.add(voxel);
  });
  for (unsigned n = 0; n < readers.size(); ++n) {
    estimate.readers.push_back(
        {filter->GetSensitivity(n), filter->GetSpecificity(n), dice(readers[n], estimate.region)});
  }
  return estimate;
}

}  // namespace tidemark::imaging
