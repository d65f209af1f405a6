// The voxels of a described body.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <string>

#include "core/progress.h"
#include "core/thread_pool.h"
#include "imaging/phantom/phantom.h"
#include "imaging/phantom/shapes.h"

namespace tidemark::imaging::phantom {

// Of folds, lobes and textures: the body stays the same, the caller's random seed makes the noise.
inline constexpr std::uint64_t kShapeSeed = 1;

// A body and its scanner.
struct Scene {
  Index3 size;
  double spacing_mm = 1.0;  // the same along all axes
  std::string modality = "MR";
  std::string description;
  WindowLevel window;
  double brightest = 1000.0;  // noise_percent refers to it
  double default_noise_percent = 0.0;

  // Paints the voxel at patient coordinates (LPS, mm; the origin is the middle of the volume). Called from
  // several threads.
  std::function<Mixture(const glm::dvec3& p_mm)> tissue;

  // The scanner's factor at a place, when it is not the same everywhere (a bias field).
  std::function<double(const glm::dvec3& p_mm)> gain;
};

// Voxels, ground truth and geometry; the caller adds parameters and a start. MR noise is that of a magnitude
// image (Rician: Gudbjartsson and Patz 1995), CT noise is Gaussian. The result does not depend on the
// number of threads.
Result<Phantom> scan(const Scene& scene, const PhantomOptions& options, ThreadPool& pool,
                     const Progress& progress);

// The voxel that holds a point, for seeds.
[[nodiscard]] std::array<double, 4> seed_at(const Geometry& geometry, const glm::dvec3& p_mm,
                                            double radius_mm);

}  // namespace tidemark::imaging::phantom
