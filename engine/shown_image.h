// A further image of a case as it is shown over the slices.
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "core/result.h"
#include "document/drive.h"

namespace tidemark::engine {

struct LoadedStudy;

// heat: the colours of a sweep (document/sweep_picture.h), which no user chooses.
enum class ImageColours { grey, inverted, hot, cool, heat };

struct ShownImage {
  std::shared_ptr<const document::CaseImage> image;
  bool visible = true;
  ImageColours colours = ImageColours::hot;
  double opacity = 0.5;
  WindowLevel window;
  bool used = true;  // by speed functions that learn from several images

  bool operator==(const ShownImage&) const = default;
};

// What was loaded, as a further image of another case. PET is shown from 0. Computes the checksum, which
// takes a while, and is empty when that was stopped.
[[nodiscard]] ShownImage shown_image(const LoadedStudy& loaded, const std::stop_token& stop = {});
// One that comes with a session, or back by undo. It may have no voxels.
[[nodiscard]] ShownImage shown_image(std::shared_ptr<const document::CaseImage> image);

// The images that speed functions use, in the order of the list.
[[nodiscard]] std::vector<std::shared_ptr<const document::CaseImage>> used_images(
    const std::vector<ShownImage>& images);
// Makes them the ones that are used, in their order: after undo, or as a session says. Where they are not so
// already, they come before the others. Those that are not in the list are added to it.
void use_images(std::vector<ShownImage>& images,
                const std::vector<std::shared_ptr<const document::CaseImage>>& used);
// Adds it, or puts it in place of a missing one of the same voxels. Fails (ErrorKind::usage) where there are
// as many as a file holds.
Status add_image(std::vector<ShownImage>& images, ShownImage added);

// Whether the image is known to lie in the study's patient coordinates: by one frame of reference, or by a
// registration.
[[nodiscard]] bool is_placed(const document::CaseImage& image, const LoadedStudy& study);

// Its value at a place of the case's patient coordinates; nothing outside of it, or where it is missing.
[[nodiscard]] std::optional<double> value_at(const document::CaseImage& image, glm::dvec3 case_mm);

}  // namespace tidemark::engine
