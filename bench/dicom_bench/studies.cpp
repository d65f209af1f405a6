#include "bench/dicom_bench/studies.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djencode.h>

#include <stdexcept>

#include "imaging/dicom/dicom.h"

namespace tidemark::bench {
namespace {

namespace fs = std::filesystem;

Volume volume_of(Index3 size) {
  Volume volume;
  volume.geometry.size = size;
  volume.geometry.spacing_mm = {0.75, 0.75, 1.0};
  volume.modality = "CT";
  volume.voxels = std::vector<std::int16_t>(static_cast<std::size_t>(volume.geometry.voxel_count()));
  return volume;
}

void write(const Volume& volume, const char* description, const fs::path& folder) {
  imaging::DicomSeriesHeader header;
  header.modality = "CT";
  header.series_description = description;
  header.window = {40.0, 400.0};
  if (Status written = imaging::write_dicom_series(volume, header, folder); !written) {
    throw std::runtime_error(written.error().message);
  }
}

}  // namespace

void write_small_files(const fs::path& folder, int files) {
  constexpr int kSeries = 10;
  const Volume volume = volume_of({32, 32, files / kSeries});
  for (int series = 0; series < kSeries; ++series) {
    write(volume, "small", folder / std::to_string(series));
  }
}

void write_ct(const fs::path& folder, int slices) {
  Volume volume = volume_of({512, 512, slices});
  auto& voxels = std::get<std::vector<std::int16_t>>(volume.voxels);
  std::uint32_t noise = 1;
  std::size_t at = 0;
  for (int k = 0; k < slices; ++k) {
    for (int j = -256; j < 256; ++j) {
      for (int i = -256; i < 256; ++i) {
        noise = noise * 1664525U + 1013904223U;
        const bool is_inside = i * i + 2 * j * j < 200 * 200;
        const int grain = static_cast<int>(noise >> 28) - 8;
        voxels[at++] = static_cast<std::int16_t>(is_inside ? 40 + (i / 32) * 10 + grain : -1000 + grain / 4);
      }
    }
  }
  write(volume, "CT", folder);
}

void write_compressed(const fs::path& source, const fs::path& folder) {
  DJEncoderRegistration::registerCodecs();
  fs::create_directories(folder);
  for (const auto& entry : fs::directory_iterator(source)) {
    DcmFileFormat file;
    const fs::path target = folder / entry.path().filename();
    if (file.loadFile(entry.path().c_str()).bad() ||
        file.getDataset()->chooseRepresentation(EXS_JPEGProcess14SV1, nullptr).bad() ||
        file.saveFile(target.c_str(), EXS_JPEGProcess14SV1).bad()) {
      throw std::runtime_error(target.string() + ": cannot be compressed");
    }
  }
  DJEncoderRegistration::cleanup();
}

}  // namespace tidemark::bench
