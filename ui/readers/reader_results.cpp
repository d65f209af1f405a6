#include "ui/readers/reader_results.h"

#include <fmt/format.h>

#include "core/csv.h"

namespace tidemark::ui {
namespace {

std::string number_field(double value) {
  return fmt::format("{:.4f}", value);
}

}  // namespace

double ComparedPair::first_ml() const {
  return static_cast<double>(comparison.voxels) * comparison.voxel_ml;
}

double ComparedPair::second_ml() const {
  return static_cast<double>(comparison.other_voxels) * comparison.voxel_ml;
}

double ReaderResults::estimate_ml() const {
  return estimate ? static_cast<double>(estimate->region.count()) * voxel_ml : 0.0;
}

std::string to_csv(const ReaderResults& results) {
  std::string csv =
      csv_line({"a", "b", "region", "dice", "jaccard", "volume_a_ml", "volume_b_ml", "mean_distance_mm",
                "hausdorff95_mm", "hausdorff_mm", "sensitivity", "specificity"});
  const std::string region = csv_text(results.region);
  for (const ComparedPair& pair : results.pairs) {
    const auto& distance = pair.comparison.distance;
    csv += csv_line({csv_text(results.names[pair.first]), csv_text(results.names[pair.second]), region,
                     number_field(pair.comparison.dice()), number_field(pair.comparison.jaccard()),
                     number_field(pair.first_ml()), number_field(pair.second_ml()),
                     distance ? number_field(distance->mean_mm) : "",
                     distance ? number_field(distance->most_mm) : "",
                     distance ? number_field(distance->largest_mm) : "", "", ""});
  }
  if (!results.estimate) return csv;
  for (std::size_t n = 0; n < results.names.size(); ++n) {
    const imaging::ReaderQuality& quality = results.estimate->readers[n];
    csv += csv_line({csv_text(results.names[n]), "STAPLE", region, number_field(quality.dice), "", "",
                     number_field(results.estimate_ml()), "", "", "", number_field(quality.sensitivity),
                     number_field(quality.specificity)});
  }
  return csv;
}

}  // namespace tidemark::ui
