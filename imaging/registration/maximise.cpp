#include "imaging/registration/maximise.h"

#include <itkCommand.h>
#include <itkEuler3DTransform.h>
#include <itkImage.h>
#include <itkMattesMutualInformationImageToImageMetricv4.h>
#include <itkRegularStepGradientDescentOptimizerv4.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <new>
#include <random>

#include "imaging/onto_grid.h"
#include "imaging/registration/pyramid.h"

namespace tidemark::imaging::registration {
namespace {

using Image = itk::Image<float, 3>;
using Optimizer = itk::RegularStepGradientDescentOptimizerv4<double>;
using Transform = itk::Euler3DTransform<double>;

// The metric with its sums in one order: the same bits every time. SetMaximumNumberOfWorkUnits() leaves the
// work in as many pieces as before.
class Metric : public itk::MattesMutualInformationImageToImageMetricv4<Image, Image> {
 public:
  using Self = Metric;
  using Pointer = itk::SmartPointer<Self>;
  itkSimpleNewMacro(Self);

 protected:
  Metric() {
    m_SparseGetValueAndDerivativeThreader->SetNumberOfWorkUnits(1);
    m_DenseGetValueAndDerivativeThreader->SetNumberOfWorkUnits(1);
  }
};

constexpr unsigned kHistogramBins = 32;
constexpr unsigned kIterations = 120;
// So many tell the information well; more make a step longer.
constexpr std::int64_t kSamples = 50000;
constexpr double kSmallestStep = 0.01;  // of the first one
constexpr double kRelaxation = 0.7;

// An ITK image over the values of a pyramid's level, which it neither copies nor owns.
Image::Pointer wrap(const Volume& volume) {
  const Geometry& grid = volume.geometry;
  Image::RegionType region;
  Image::SpacingType spacing;
  Image::PointType origin;
  Image::DirectionType direction;
  for (unsigned row = 0; row < 3; ++row) {
    const int axis = static_cast<int>(row);
    region.SetSize(row, static_cast<itk::SizeValueType>(grid.size[axis]));
    spacing[row] = grid.spacing_mm[axis];
    origin[row] = grid.origin_mm[axis];
    for (unsigned column = 0; column < 3; ++column) {
      direction[row][column] = grid.direction[static_cast<int>(column)][axis];
    }
  }
  auto image = Image::New();
  image->SetRegions(region);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(direction);
  const auto& values = std::get<std::vector<float>>(volume.voxels);
  // ITK's container takes no const pointer; the metric reads alone.
  image->GetPixelContainer()->SetImportPointer(const_cast<float*>(values.data()), values.size(), false);
  return image;
}

// Places all over the image, not at the voxels' centres: samples on the grid would favour transforms that put
// grid upon grid.
Metric::FixedSampledPointSetType::Pointer make_samples(const Geometry& grid) {
  auto samples = Metric::FixedSampledPointSetType::New();
  std::mt19937 random(1);
  const auto part = [&random] { return static_cast<double>(random()) / 4294967296.0; };  // below 1
  const std::int64_t voxels = grid.voxel_count();
  const std::int64_t count = std::min(voxels, kSamples);
  for (std::int64_t n = 0; n < count; ++n) {
    const double place = (static_cast<double>(n) + part()) / static_cast<double>(count);
    const auto offset = std::min(static_cast<std::int64_t>(place * static_cast<double>(voxels)), voxels - 1);
    glm::dvec3 voxel(grid.voxel_at(offset));
    for (int axis = 0; axis < 3; ++axis) {
      const double last = static_cast<double>(grid.size[axis] - 1);
      voxel[axis] = std::clamp(voxel[axis] + part() - 0.5, 0.0, last);
    }
    const glm::dvec3 patient = grid.to_patient(voxel);
    Metric::FixedSampledPointSetType::PointType point;
    for (unsigned axis = 0; axis < 3; ++axis) {
      point[axis] =
          static_cast<Metric::FixedSampledPointSetType::CoordRepType>(patient[static_cast<int>(axis)]);
    }
    samples->SetPoint(static_cast<itk::IdentifierType>(n), point);
  }
  return samples;
}

Transform::Pointer make_transform(const glm::dmat4& to_moving, glm::dvec3 centre) {
  auto transform = Transform::New();
  Transform::InputPointType itk_centre;
  Transform::MatrixType matrix;
  Transform::OffsetType offset;
  for (unsigned row = 0; row < 3; ++row) {
    const int axis = static_cast<int>(row);
    itk_centre[row] = centre[axis];
    offset[row] = to_moving[3][axis];
    for (unsigned column = 0; column < 3; ++column) {
      matrix[row][column] = to_moving[static_cast<int>(column)][axis];
    }
  }
  transform->SetCenter(itk_centre);
  transform->SetMatrix(matrix);
  transform->SetOffset(offset);
  return transform;
}

glm::dmat4 to_glm(const Transform& transform) {
  glm::dmat4 result(1.0);
  for (unsigned row = 0; row < 3; ++row) {
    const int axis = static_cast<int>(row);
    result[3][axis] = transform.GetOffset()[row];
    for (unsigned column = 0; column < 3; ++column) {
      result[static_cast<int>(column)][axis] = transform.GetMatrix()[row][column];
    }
  }
  return result;
}

Metric::Pointer make_metric(const Volume& moving, const Volume& fixed, Transform* transform) {
  auto metric = Metric::New();
  metric->SetNumberOfHistogramBins(kHistogramBins);
  metric->SetFixedImage(wrap(fixed));
  metric->SetMovingImage(wrap(moving));
  metric->SetMovingTransform(transform);
  metric->SetFixedSampledPointSet(make_samples(fixed.geometry));
  metric->SetUseSampledPointSet(true);
  metric->SetVirtualDomainFromImage(metric->GetFixedImage());
  metric->SetUseFixedImageGradientFilter(false);  // gradients at the samples alone
  metric->SetUseMovingImageGradientFilter(false);
  return metric;
}

// A radian weighs as much as the way of the image's edge, so that a step is a length in mm.
Optimizer::ScalesType make_scales(const Geometry& grid) {
  const double radius = 0.5 * glm::length(glm::dvec3(grid.size) * grid.spacing_mm);
  Optimizer::ScalesType scales(6);
  for (unsigned n = 0; n < 3; ++n) scales[n] = radius * radius;
  for (unsigned n = 3; n < 6; ++n) scales[n] = 1.0;
  return scales;
}

// Calls `work`; what ITK throws becomes an error.
template <class Work>
auto guarded(const Volume& moving, const Volume& fixed, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "registration: not enough memory");
  } catch (const itk::ExceptionObject&) {
    // The metric throws when no or almost no sample lies in both images.
    return fail(ErrorKind::usage, "registration: the images share too little space: {} and {}",
                describe(moving.geometry), describe(fixed.geometry));
  } catch (const std::exception& exception) {
    return fail(ErrorKind::internal, "registration: {}", exception.what());
  }
}

}  // namespace

Result<Maximum> maximise(const Volume& moving, const Volume& fixed, const glm::dmat4& to_moving,
                         double step_mm, const Progress& progress) {
  return guarded(moving, fixed, [&]() -> Result<Maximum> {
    const auto transform = make_transform(to_moving, centre_mm(fixed.geometry));
    const auto metric = make_metric(moving, fixed, transform);
    metric->Initialize();
    auto optimizer = Optimizer::New();
    optimizer->SetMetric(metric);
    optimizer->SetScales(make_scales(fixed.geometry));
    optimizer->SetLearningRate(step_mm);
    optimizer->SetMinimumStepLength(kSmallestStep * step_mm);
    optimizer->SetRelaxationFactor(kRelaxation);
    optimizer->SetNumberOfIterations(kIterations);
    optimizer->SetNumberOfWorkUnits(1);
    optimizer->SetReturnBestParametersAndValue(true);
    optimizer->AddObserver(itk::IterationEvent(), [&](const itk::EventObject&) {
      progress(static_cast<double>(optimizer->GetCurrentIteration()) / kIterations, "registering");
      if (progress.cancelled()) optimizer->StopOptimization();
    });
    optimizer->StartOptimization();
    if (progress.cancelled()) return cancelled_error();
    return Maximum{to_glm(*transform), -optimizer->GetValue()};
  });
}

Result<double> information(const Volume& moving, const Volume& fixed, const glm::dmat4& to_moving) {
  return guarded(moving, fixed, [&]() -> Result<double> {
    const auto transform = make_transform(to_moving, centre_mm(fixed.geometry));
    const auto metric = make_metric(moving, fixed, transform);
    metric->Initialize();
    return -metric->GetValue();
  });
}

}  // namespace tidemark::imaging::registration
