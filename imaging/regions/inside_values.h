// The values of an image inside of a region.
#pragma once

#include <array>
#include <optional>

#include "core/progress.h"
#include "core/region.h"

namespace tidemark::imaging {

// Uptake of a tracer (PET in standardised uptake values).
struct Uptake {
  // The highest mean of a ball of 1 ml around a voxel of the region (PERCIST 1.0). The ball may reach beyond
  // the region, and ends where the image does.
  double peak = 0.0;
  double total_glycolysis = 0.0;  // mean times ml
};

inline constexpr std::array<double, 5> kPercentiles{5.0, 25.0, 50.0, 75.0, 95.0};

// In the image's units.
struct InsideValues {
  double smallest = 0.0;
  double largest = 0.0;
  double mean = 0.0;
  double standard_deviation = 0.0;                        // of the population
  std::array<double, kPercentiles.size()> percentiles{};  // linear between the two nearest ranks
  std::optional<Uptake> uptake;                           // where the image's unit is one of uptake
};

// The region lies in the image's grid, and is not empty. Of an image that was resampled to the grid,
// `covered` are the voxels that it has, with the region among them; null: all. Fails (ErrorKind::cancelled).
Result<InsideValues> values_inside(const Region& region, const Volume& image, const Progress& progress = {},
                                   const Region* covered = nullptr);

}  // namespace tidemark::imaging
