#include "bench/peers/itk_filters.h"

#include <itkMultiThreaderBase.h>
#include <itkThresholdSegmentationLevelSetFunction.h>

#include <algorithm>

namespace tidemark::bench {
namespace {

using SpeedFunction = itk::ThresholdSegmentationLevelSetFunction<ItkImage, ItkImage>;

ItkImage::Pointer allocate(const Geometry& geometry) {
  ItkImage::RegionType region;
  for (int axis = 0; axis < 3; ++axis) {
    region.SetSize(static_cast<unsigned>(axis), static_cast<itk::SizeValueType>(geometry.size[axis]));
  }
  auto image = ItkImage::New();
  image->SetRegions(region);
  return image;
}

// The start as ITK wants it: < 0 inside. A band of 4 holds its three layers on either side.
ItkImage::Pointer start_image(const Problem& problem) {
  constexpr double kBand = 4.0;
  const std::vector<float> distance = start_distance(problem, kBand);
  auto image = allocate(problem.source->geometry);
  image->Allocate();
  std::transform(distance.begin(), distance.end(), image->GetBufferPointer(), [](float d) { return -d; });
  return image;
}

}  // namespace

ItkImage::Pointer wrap(const Geometry& geometry, const std::vector<float>& values) {
  auto image = allocate(geometry);
  // ITK's container takes no const pointer; nothing here writes to a filter's input.
  image->GetPixelContainer()->SetImportPointer(const_cast<float*>(values.data()), values.size(), false);
  return image;
}

ItkThresholdFilter::Pointer make_threshold_filter(const Problem& problem) {
  const solver::Parameters& parameters = problem.parameters;
  auto filter = ItkThresholdFilter::New();
  filter->SetInput(start_image(problem));
  filter->SetFeatureImage(wrap(problem.source->geometry, problem.values));
  filter->SetLowerThreshold(static_cast<float>(parameters.target - parameters.range));
  filter->SetUpperThreshold(static_cast<float>(parameters.target + parameters.range));
  filter->SetPropagationScaling(static_cast<float>(parameters.alpha / parameters.range));
  filter->SetCurvatureScaling(static_cast<float>(1.0 - parameters.alpha));
  filter->SetIsoSurfaceValue(0.0F);
  filter->SetNumberOfWorkUnits(1);
  return filter;
}

ItkParallelFilter::Pointer make_parallel_filter(const Problem& problem, int threads) {
  const solver::Parameters& parameters = problem.parameters;
  auto function = SpeedFunction::New();
  SpeedFunction::RadiusType radius;
  radius.Fill(1);
  function->Initialize(radius);  // before the weights, which it resets
  const auto feature = wrap(problem.source->geometry, problem.values);
  function->SetFeatureImage(feature);
  function->SetLowerThreshold(static_cast<float>(parameters.target - parameters.range));
  function->SetUpperThreshold(static_cast<float>(parameters.target + parameters.range));
  function->SetPropagationWeight(static_cast<float>(parameters.alpha / parameters.range));
  function->SetCurvatureWeight(static_cast<float>(1.0 - parameters.alpha));
  function->SetAdvectionWeight(0.0F);
  function->SetLaplacianSmoothingWeight(0.0F);
  function->AllocateSpeedImage();
  function->CalculateSpeedImage();

  // Its work units wait for one another, so each needs a thread of its own.
  const auto count = static_cast<itk::ThreadIdType>(threads);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(count);
  auto filter = ItkParallelFilter::New();
  filter->SetInput(start_image(problem));
  filter->SetDifferenceFunction(function);
  filter->SetIsoSurfaceValue(0.0F);
  filter->SetNumberOfLayers(3);
  filter->GetMultiThreader()->SetMaximumNumberOfThreads(count);
  filter->SetNumberOfWorkUnits(count);
  return filter;
}

Mask inside(const ItkImage& phi, const Geometry& geometry) {
  Mask mask{geometry, std::vector<std::uint8_t>(static_cast<std::size_t>(geometry.voxel_count()))};
  std::transform(phi.GetBufferPointer(), phi.GetBufferPointer() + mask.voxels.size(), mask.voxels.begin(),
                 [](float value) { return std::uint8_t(value < 0.0F); });
  return mask;
}

}  // namespace tidemark::bench
