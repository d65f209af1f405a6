// A further image of a case as it is shown over the slices.
#pragma once

#include <memory>

#include "document/drive.h"

namespace tidemark::engine {

struct LoadedStudy;

enum class ImageColours { grey, inverted, hot, cool };

struct ShownImage {
  std::shared_ptr<const document::CaseImage> image;
  bool visible = true;
  ImageColours colours = ImageColours::hot;
  double opacity = 0.5;
  WindowLevel window;

  bool operator==(const ShownImage&) const = default;
};

// What was loaded, as a further image of another case. PET is shown from 0.
[[nodiscard]] ShownImage shown_image(const LoadedStudy& loaded);

// Whether the image is known to lie in the study's patient coordinates: by one frame of reference, or by a
// registration.
[[nodiscard]] bool is_placed(const document::CaseImage& image, const LoadedStudy& study);

// Its value at a place of the case's patient coordinates; nothing outside of it.
[[nodiscard]] std::optional<double> value_at(const document::CaseImage& image, glm::dvec3 case_mm);

}  // namespace tidemark::engine
