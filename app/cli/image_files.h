// Images, maps and masks beside a study, from files of the command line.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "app/cli/console.h"
#include "document/drive.h"
#include "imaging/load_study.h"

namespace tidemark::cli {

// Where a study lies in the patient.
struct StudyPlace {
  Geometry grid;
  std::string frame_of_reference_uid;  // empty where it is not known
};
[[nodiscard]] StudyPlace place_of(const imaging::LoadedSeries& study);

// Warns where the file names a frame of reference that is not the study's (imaging::frame_remark).
void warn_of_frame(const std::string& file, std::span<const std::string> named, const StudyPlace& study,
                   Console& console);

// On its own grid, with the file's name and its frame of reference.
Result<document::CaseImage> read_image(const std::string& file, Console& console);

// On the grid of the study, too. Warns of another frame of reference, unless a registration places the image.
// Fails (ErrorKind::input), naming the image and perhaps the file, where it does not meet the grid.
Result<std::shared_ptr<const document::CaseImage>> placed(const document::CaseImage& image,
                                                          const std::string& file, const StudyPlace& study,
                                                          Console& console);

// As document::load_speed_map(). Warns of another frame of reference.
Result<std::shared_ptr<const document::SpeedMap>> read_speed_map(const std::string& file,
                                                                 const StudyPlace& study, Console& console);

// As imaging::load_any_mask(), on the grid of the study. Warns of what reading left out, and of another frame
// of reference.
Result<Mask> read_mask(const std::string& file, const StudyPlace& study, Console& console);

}  // namespace tidemark::cli
