#include "tests/imaging/dicom/series_files.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <QTest>

#include <QtGlobal>
#include <algorithm>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom.h"
#include "imaging/dicom/dicom_values.h"

namespace tidemark::test {
namespace {

namespace fs = std::filesystem;

void require(bool holds, const std::string& what) {
  if (!holds) qFatal("%s", what.c_str());
}

Geometry sample_geometry(Index3 size) {
  Geometry geometry;
  geometry.size = size;
  geometry.spacing_mm = {0.7, 0.9, 2.5};
  const glm::dvec3 row = glm::normalize(glm::dvec3(1.0, 0.2, -0.1));
  const glm::dvec3 column = glm::normalize(glm::cross(glm::dvec3(0.1, 0.1, 1.0), row));
  geometry.direction = {row, column, glm::cross(row, column)};
  geometry.origin_mm = {-101.25, 37.5, 512.125};
  return geometry;
}

}  // namespace

Volume sample_volume(Index3 size) {
  Volume volume;
  volume.geometry = sample_geometry(size);
  std::vector<std::int16_t> voxels(static_cast<std::size_t>(volume.geometry.voxel_count()));
  for (std::size_t v = 0; v < voxels.size(); ++v) voxels[v] = static_cast<std::int16_t>(v * 37 % 4001 - 1000);
  voxels.front() = -32768;
  voxels.back() = 32767;
  volume.voxels = std::move(voxels);
  return volume;
}

Volume sample_volume_uint16(Index3 size) {
  Volume volume;
  volume.geometry = sample_geometry(size);
  std::vector<std::uint16_t> voxels(static_cast<std::size_t>(volume.geometry.voxel_count()));
  for (std::size_t v = 0; v < voxels.size(); ++v) voxels[v] = static_cast<std::uint16_t>(v * 371 % 60013);
  voxels.back() = 65535;
  volume.voxels = std::move(voxels);
  return volume;
}

std::vector<fs::path> write_series(const Volume& volume, const fs::path& folder, const char* modality) {
  imaging::DicomSeriesHeader header;
  header.modality = modality;
  header.series_description = "Sample";
  header.window = {40.0, 400.0};
  const Status written = imaging::write_dicom_series(volume, header, folder);
  require(written.has_value(), written ? "" : written.error().message);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void edit(const fs::path& file, const std::function<void(DcmDataset&)>& change, const fs::path& target) {
  DcmFileFormat loaded;
  require(loaded.loadFile(file.c_str()).good(), "cannot load " + file.string());
  loaded.loadAllDataIntoMemory();
  change(*loaded.getDataset());
  const E_TransferSyntax syntax = loaded.getDataset()->getCurrentXfer();
  const fs::path saved = target.empty() ? file : target;
  require(loaded.saveFile(saved.c_str(), syntax).good(), "cannot save " + saved.string());
}

void set_text(const fs::path& file, unsigned group, unsigned element, const char* text) {
  const DcmTagKey key(static_cast<Uint16>(group), static_cast<Uint16>(element));
  edit(file, [&](DcmDataset& dataset) {
    if (*text == '\0') {
      delete dataset.remove(key);
    } else {
      require(dataset.putAndInsertString(DcmTag(key), text).good(), "cannot set an attribute");
    }
  });
}

void tilt(const std::vector<fs::path>& files, const Geometry& grid, double mm) {
  for (std::size_t k = 0; k < files.size(); ++k) {
    const auto step = static_cast<double>(k);
    const glm::dvec3 place = grid.to_patient({0.0, 0.0, step}) + mm * step * grid.direction[1];
    set_text(files[k], 0x0020, 0x0032, imaging::decimals(place.x, place.y, place.z).c_str());
  }
}

void truncate(const fs::path& file, std::uintmax_t bytes) {
  fs::resize_file(file, bytes);
}

imaging::Series only_series(const fs::path& path) {
  const auto found = imaging::scan_dicom(path);
  require(found.has_value(), found ? "" : found.error().message);
  require(found->series.size() == 1, fmt::format("{} series in {}", found->series.size(), path.string()));
  return found->series.front();
}

void verify_same(const Volume& read, const Volume& written) {
  QVERIFY(same_grid(read.geometry, written.geometry, 1e-6));
  QVERIFY(read.voxels == written.voxels);
  QCOMPARE(read.slope, written.slope);
  QCOMPARE(read.intercept, written.intercept);
}

}  // namespace tidemark::test
