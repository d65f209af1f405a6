#include "app/cli/image_files.h"

#include <filesystem>

#include "document/checksum.h"
#include "document/speed_map.h"
#include "imaging/results/results.h"

namespace tidemark::cli {
namespace {

std::string file_name(const std::string& file) {
  return std::filesystem::path(file).filename().string();
}

}  // namespace

StudyPlace place_of(const imaging::LoadedSeries& study) {
  return {study.volume.geometry, study.series.frame_of_reference_uid};
}

void warn_of_frame(const std::string& file, std::span<const std::string> named, const StudyPlace& study,
                   Console& console) {
  if (const auto remark = imaging::frame_remark(named, study.frame_of_reference_uid))
    console.warn(file + ": " + *remark);
}

Result<document::CaseImage> read_image(const std::string& file, Console& console) {
  auto loaded = imaging::load_with_series(file, {}, console.progress());
  if (!loaded) return pass_on(loaded);
  document::CaseImage image;
  image.name = file_name(file);
  image.frame_of_reference_uid = loaded->series.frame_of_reference_uid;
  image.checksum = document::checksum_of(loaded->volume);
  image.volume = std::make_shared<const Volume>(std::move(loaded->volume));
  return image;
}

Result<std::shared_ptr<const document::CaseImage>> placed(const document::CaseImage& image,
                                                          const std::string& file, const StudyPlace& study,
                                                          Console& console) {
  auto shared = std::make_shared<const document::CaseImage>(image);
  const auto voxels = document::on_grid(*shared, study.grid);
  if (!voxels) {
    const std::string& why = voxels.error().message;  // begins with the image's name
    return fail(ErrorKind::input, "{}", image.name == file_name(file) ? why : file + ": " + why);
  }
  if (image.to_case == glm::dmat4(1.0))
    warn_of_frame(file, {&image.frame_of_reference_uid, 1}, study, console);
  return shared;
}

Result<std::shared_ptr<const document::SpeedMap>> read_speed_map(const std::string& file,
                                                                 const StudyPlace& study, Console& console) {
  auto map = document::load_speed_map(file, study.grid, console.progress());
  if (map) warn_of_frame(file, {&(*map)->frame_of_reference_uid, 1}, study, console);
  return map;
}

Result<Mask> read_mask(const std::string& file, const StudyPlace& study, Console& console) {
  auto loaded = imaging::load_any_mask(file, &study.grid, console.progress());
  if (!loaded) return pass_on(loaded);
  for (const std::string& change : loaded->changes) console.warn(file + ": " + change);
  warn_of_frame(file, loaded->frames_of_reference, study, console);
  return std::move(loaded->mask);
}

}  // namespace tidemark::cli
