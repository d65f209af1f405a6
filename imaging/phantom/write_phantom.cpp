#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "imaging/phantom/kinds.h"
#include "imaging/phantom/phantom.h"

namespace tidemark::imaging {
namespace {

// "tumour" -> "Phantom^Tumour", as DICOM writes family and given name.
std::string patient_name(std::string kind) {
  if (!kind.empty() && kind[0] >= 'a' && kind[0] <= 'z') kind[0] = static_cast<char>(kind[0] - 'a' + 'A');
  return "Phantom^" + kind;
}

nlohmann::ordered_json description(const Phantom& phantom) {
  const Geometry& geometry = phantom.volume.geometry;
  nlohmann::ordered_json json;
  json["kind"] = phantom.kind;
  json["target"] = phantom.target;
  json["range"] = phantom.range;
  json["alpha"] = phantom.alpha;
  if (phantom.init_threshold) {
    json["init_threshold"] = {phantom.init_threshold->first, phantom.init_threshold->second};
  } else if (phantom.seed) {
    const auto& [i, j, k, radius_mm] = *phantom.seed;
    json["seed"] = {static_cast<std::int64_t>(i), static_cast<std::int64_t>(j), static_cast<std::int64_t>(k),
                    radius_mm};
  }
  json["modality"] = phantom.volume.modality;
  json["size"] = {geometry.size.x, geometry.size.y, geometry.size.z};
  json["spacing_mm"] = {geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z};
  json["noise_percent"] = phantom.noise_percent;
  json["random_seed"] = phantom.random_seed;
  json["truth"] = phantom::truth_of(phantom.kind);
  return json;
}

}  // namespace

Status write_phantom(const Phantom& phantom, const std::filesystem::path& folder, const Progress& progress) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return fail(ErrorKind::write, "{}: the folder cannot be made: {}", folder.string(), error.message());
  }
  DicomSeriesHeader header;
  header.modality = phantom.volume.modality;
  header.patient_name = patient_name(phantom.kind);
  header.series_description = phantom.volume.description;
  header.window = phantom.volume.window.value_or(WindowLevel{});
  Status written = write_dicom_series(phantom.volume, header, folder / "series", progress);
  if (!written) return written;
  written = write_mask_file(phantom.truth, folder / "truth.nii.gz");
  if (!written) return written;
  return write_file(folder / "phantom.json", description(phantom).dump(2) + "\n");
}

}  // namespace tidemark::imaging
