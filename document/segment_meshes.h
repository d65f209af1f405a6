// Segments as polygons, a file each.
#pragma once

#include <filesystem>
#include <vector>

#include "core/progress.h"
#include "imaging/results/segments.h"
#include "imaging/surface/surface.h"
#include "solver/field.h"

namespace tidemark::document {

// How wide a level set of a mask must be for its surface to see its neighbours along the axis with the
// thickest voxels. In smallest voxels.
[[nodiscard]] double surface_band(const Geometry& geometry);

// The surface of a level set. Fails as extract_surface() does.
Result<imaging::Mesh> mesh_of(const solver::Field& phi);
// The surface of a mask. Fails as extract_surface() does.
Result<imaging::Mesh> mesh_of(const Mask& mask);
// Between the voxels where the segment has a level set.
Result<imaging::Mesh> mesh_of(const Geometry& geometry, const imaging::Segment& segment);

// The names of such files, in the order of the segments: for "organs.stl" and a segment "Left kidney" it is
// "organs-Left kidney.stl". What a file's name must not hold is left out; of two equal names the second one
// ends in " 2".
[[nodiscard]] std::vector<std::filesystem::path> mesh_files(const std::vector<std::string>& segment_names,
                                                            const std::filesystem::path& like);

// Writes them, all or none. Fails (ErrorKind::write) as write_mesh() does, (ErrorKind::cancelled) when told
// to stop.
Status write_meshes(const imaging::Segments& segments, const std::filesystem::path& like,
                    const Progress& progress = {});

}  // namespace tidemark::document
