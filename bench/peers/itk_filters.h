// ITK's two sparse-field solvers, set up for our equation, for the benchmark and for the tests that hold our
// result against ITK's.
//
// ITK's phi is < 0 inside and its data speed is min(I - lower, upper - I), neither scaled nor clamped: the
// thresholds are T -+ epsilon and the propagation weight is alpha / epsilon. Its curvature is the sum of the
// principal curvatures with a central gradient, as ours, with weight 1 - alpha. It has no rescaling term: the
// layers around the active one are rebuilt by distance in every step.
#pragma once

#include <itkImage.h>
#include <itkParallelSparseFieldLevelSetImageFilter.h>
#include <itkThresholdSegmentationLevelSetImageFilter.h>

#include "bench/peers/problem.h"

namespace tidemark::bench {

using ItkImage = itk::Image<float, 3>;
using ItkThresholdFilter = itk::ThresholdSegmentationLevelSetImageFilter<ItkImage, ItkImage, float>;
using ItkParallelFilter = itk::ParallelSparseFieldLevelSetImageFilter<ItkImage, ItkImage>;

// An image of 1 mm voxels at the origin over `values`, which it neither copies nor owns.
ItkImage::Pointer wrap(const Geometry& geometry, const std::vector<float>& values);

// The filter with its inputs and its own copy of the start, ready to run. One thread.
ItkThresholdFilter::Pointer make_threshold_filter(const Problem& problem);

// The parallel solver with the speed function of the filter above.
ItkParallelFilter::Pointer make_parallel_filter(const Problem& problem, int threads);

// The voxels where phi < 0.
Mask inside(const ItkImage& phi, const Geometry& geometry);

}  // namespace tidemark::bench
