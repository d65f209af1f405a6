#include "app/cli/image_files.h"

#include <filesystem>

#include "document/checksum.h"
#include "imaging/load_study.h"

namespace tidemark::cli {
namespace {

std::string name_of(const std::string& file) {
  return std::filesystem::path(file).filename().string();
}

}  // namespace

Result<document::CaseImage> read_image(const std::string& file, Console& console) {
  auto loaded = imaging::load_with_series(file, {}, console.progress());
  if (!loaded) return pass_on(loaded);
  document::CaseImage image;
  image.name = name_of(file);
  image.frame_of_reference_uid = loaded->series.frame_of_reference_uid;
  image.checksum = document::checksum_of(loaded->volume);
  image.volume = std::make_shared<const Volume>(std::move(loaded->volume));
  return image;
}

Result<std::shared_ptr<const document::CaseImage>> placed(const document::CaseImage& image,
                                                          const std::string& file, const Geometry& grid) {
  auto shared = std::make_shared<const document::CaseImage>(image);
  const auto voxels = document::on_grid(*shared, grid);
  if (voxels) return shared;
  const std::string& why = voxels.error().message;  // begins with the image's name
  return fail(ErrorKind::input, "{}", image.name == name_of(file) ? why : file + ": " + why);
}

}  // namespace tidemark::cli
