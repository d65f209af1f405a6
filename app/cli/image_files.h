// Further images of a case, from files of the command line.
#pragma once

#include <memory>
#include <string>

#include "app/cli/console.h"
#include "document/drive.h"

namespace tidemark::cli {

// On its own grid, with the file's name and its frame of reference.
Result<document::CaseImage> read_image(const std::string& file, Console& console);

// On the grid of the case, too. Fails (ErrorKind::input), naming the image and perhaps the file, where it
// does not meet the grid.
Result<std::shared_ptr<const document::CaseImage>> placed(const document::CaseImage& image,
                                                          const std::string& file, const Geometry& grid);

}  // namespace tidemark::cli
