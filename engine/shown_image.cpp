#include "engine/shown_image.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <utility>

#include "document/checksum.h"
#include "document/file_limits.h"
#include "engine/study_loader.h"
#include "imaging/resample.h"

namespace tidemark::engine {

ShownImage shown_image(const LoadedStudy& loaded, const std::stop_token& stop) {
  auto image = std::make_shared<document::CaseImage>();
  image->name = loaded.name.toStdString();
  // A volume file names itself in place of a series.
  if (!loaded.dicom_files.empty()) image->series_uid = loaded.origin.series_uid;
  image->frame_of_reference_uid = loaded.frame_of_reference_uid;
  image->checksum = document::checksum_of(*loaded.volume, stop);
  image->path = loaded.origin.path;
  image->policy = loaded.origin.policy;
  image->volume = loaded.volume;
  ShownImage shown;
  shown.window = loaded.summary.window;
  if (loaded.volume->modality == "CT" || loaded.volume->modality == "MR") shown.colours = ImageColours::grey;
  if (loaded.volume->modality == "PT") {
    const double high = shown.window.centre + 0.5 * shown.window.width;
    if (high > 0.0) shown.window = {0.5 * high, high};
  }
  shown.image = std::move(image);
  return shown;
}

ShownImage shown_image(std::shared_ptr<const document::CaseImage> image) {
  ShownImage shown;
  if (image->volume) {
    const auto [low, high] = image->volume->common_range();
    shown.window.width = high > low ? static_cast<double>(high) - static_cast<double>(low) : 1e-6;
    shown.window.centre = static_cast<double>(low) + 0.5 * shown.window.width;
  }
  shown.image = std::move(image);
  return shown;
}

std::vector<std::shared_ptr<const document::CaseImage>> used_images(const std::vector<ShownImage>& images) {
  std::vector<std::shared_ptr<const document::CaseImage>> used;
  for (const ShownImage& shown : images) {
    if (shown.used) used.push_back(shown.image);
  }
  return used;
}

void use_images(std::vector<ShownImage>& images,
                const std::vector<std::shared_ptr<const document::CaseImage>>& used) {
  if (used_images(images) == used) return;
  std::vector<ShownImage> now;
  for (const auto& image : used) {
    const auto is_same = [&](const ShownImage& shown) { return shown.image == image; };
    // The same voxels at another place: a registration was taken back.
    const auto was_moved = [&](const ShownImage& shown) {
      return image->volume && shown.image->volume == image->volume;
    };
    auto shown = std::ranges::find_if(images, is_same);
    if (shown == images.end()) shown = std::ranges::find_if(images, was_moved);
    now.push_back(shown == images.end() ? shown_image(image) : *shown);
    now.back().image = image;
    now.back().used = true;
    if (shown != images.end()) images.erase(shown);
  }
  for (ShownImage& shown : images) {
    shown.used = false;
    now.push_back(std::move(shown));
  }
  images = std::move(now);
}

Status add_image(std::vector<ShownImage>& images, ShownImage added) {
  const auto missing = std::ranges::find_if(images, [&](const ShownImage& shown) {
    return !shown.image->volume && !added.image->checksum.empty() &&
           shown.image->checksum == added.image->checksum;
  });
  if (missing == images.end()) {
    if (images.size() >= document::kMostImages) {
      return fail(ErrorKind::usage, "a study takes at most {} further images: take one away first",
                  document::kMostImages);
    }
    images.push_back(std::move(added));
    return {};
  }
  auto image = std::make_shared<document::CaseImage>(*added.image);
  image->to_case = missing->image->to_case;
  added.used = missing->used;
  added.image = std::move(image);
  *missing = std::move(added);
  return {};
}

bool is_placed(const document::CaseImage& image, const LoadedStudy& study) {
  if (image.to_case != glm::dmat4(1.0)) return true;
  return !image.frame_of_reference_uid.empty() &&
         image.frame_of_reference_uid == study.frame_of_reference_uid;
}

std::optional<double> value_at(const document::CaseImage& image, glm::dvec3 case_mm) {
  if (!image.volume) return std::nullopt;
  const glm::dvec4 own = glm::inverse(image.to_case) * glm::dvec4(case_mm, 1.0);
  return imaging::value_at(*image.volume, glm::dvec3(own));
}

}  // namespace tidemark::engine
