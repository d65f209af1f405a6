// Measures on phantoms.
#pragma once

#include <cstdint>
#include <map>

#include "imaging/phantom/phantom.h"

namespace tidemark::test {

// A phantom on a pool of that many threads. Fails the program when it cannot be made.
imaging::Phantom made(std::string_view kind, const imaging::PhantomOptions& options = {}, int threads = 2);

const std::vector<std::int16_t>& stored(const imaging::Phantom& phantom);

// FNV-1a of the stored voxels, low byte first, and of the truth.
std::uint64_t checksum(const imaging::Phantom& phantom);

// Values of the ground truth.
struct Contrast {
  double mean = 0.0;
  double in_range = 0.0;  // the share within T +- epsilon
  std::int64_t voxels = 0;
};
Contrast contrast_of(const imaging::Phantom& phantom);

// The share of the largest part that hangs together across faces.
double largest_part(const Mask& mask);

// How thick a mask is: the diameters (voxels, rounded) of the largest balls inside, at the places where no
// neighbouring voxel has a larger one, in every `step`-th slice. Balls up to `radius` are told apart.
std::map<int, std::int64_t> thickness(const Mask& mask, int radius, int step);

}  // namespace tidemark::test
