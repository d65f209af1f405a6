#include "engine/shown_image.h"

#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "engine/study_loader.h"
#include "imaging/resample.h"

namespace tidemark::engine {

ShownImage shown_image(const LoadedStudy& loaded) {
  auto image = std::make_shared<document::CaseImage>();
  image->name = loaded.name.toStdString();
  // A volume file names itself in place of a series.
  if (!loaded.dicom_files.empty()) image->series_uid = loaded.origin.series_uid;
  image->frame_of_reference_uid = loaded.frame_of_reference_uid;
  image->checksum = loaded.origin.checksum;
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

bool is_placed(const document::CaseImage& image, const LoadedStudy& study) {
  if (image.to_case != glm::dmat4(1.0)) return true;
  return !image.frame_of_reference_uid.empty() &&
         image.frame_of_reference_uid == study.frame_of_reference_uid;
}

std::optional<double> value_at(const document::CaseImage& image, glm::dvec3 case_mm) {
  const glm::dvec4 own = glm::inverse(image.to_case) * glm::dvec4(case_mm, 1.0);
  return imaging::value_at(*image.volume, glm::dvec3(own));
}

}  // namespace tidemark::engine
