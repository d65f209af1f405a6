// The measures of a region: its size, its form, and the values of images inside of it.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/progress.h"
#include "document/case_image.h"
#include "imaging/regions/diameters.h"
#include "imaging/regions/inside_values.h"
#include "solver/field.h"

namespace tidemark::document {

// An image on the region's grid.
struct MeasuredImage {
  std::string name;
  std::shared_ptr<const Volume> volume;
  std::shared_ptr<const Region> covered = nullptr;  // the grid's voxels that the image has; null: all
};

// A further image on that grid. Fails as on_grid() does.
Result<MeasuredImage> measured_image(const std::string& name, const CaseImage& image, const Geometry& grid);

// Those of the images that have voxels on the grid, behind the study's own. One that lies elsewhere has none
// inside of a region. Fails (ErrorKind::cancelled), and (ErrorKind::capability) for lack of memory.
Result<std::vector<MeasuredImage>> images_on(const Geometry& grid, MeasuredImage study,
                                             const std::vector<std::shared_ptr<const CaseImage>>& images,
                                             const Progress& progress = {});

struct ImageValues {
  std::string image;  // its name
  std::string unit;   // empty: its values have none
  imaging::InsideValues values;
  double span = 0.0;     // of the whole image's common_range(): how finely values are told
  double covered = 1.0;  // the part of the region's voxels that the image has, above 0: values are of these
};

struct Measures {
  std::int64_t voxels = 0;
  double volume_ml = 0.0;  // of the voxels; of a level set inside it, as solver::measure() has it
  double area_mm2 = 0.0;   // of the surface, and of the faces where the grid ends
  bool is_cut = false;     // by the grid's end
  // The area of a ball with the surface's volume by that area: 1 for a ball.
  double sphericity = 0.0;
  imaging::Diameters diameters;
  std::vector<ImageValues> images;  // without those that have no voxel of the region
};

// With the surface of that level set, whose area is that of solver::measure() where the grid does not cut it;
// null: it runs half way between voxels inside and outside. Fails (ErrorKind::usage) on an empty region,
// (ErrorKind::cancelled), and as extract_surface() does.
Result<Measures> measure(const Region& region, const Geometry& grid, const std::vector<MeasuredImage>& images,
                         const solver::Field* phi = nullptr, const Progress& progress = {});

// As `tidemark-cli measure --json` writes them.
[[nodiscard]] nlohmann::ordered_json to_json(const Measures& measures);

}  // namespace tidemark::document
