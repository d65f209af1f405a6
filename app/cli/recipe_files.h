// The files that a recipe needs beside its volume.
#pragma once

#include "app/cli/drive_options.h"
#include "document/recipe.h"

namespace tidemark::cli {

// Gives the images and the map that a recipe names the files of the command line: images by their voxels, or
// in their order where it has no checksum. Fails (ErrorKind::usage) naming the one that is missing, or a file
// that the recipe does not need, (ErrorKind::input) naming a file with other voxels.
Status give_images(document::Recipe& recipe, const DriveOptions& options, const StudyPlace& study,
                   Console& console);

}  // namespace tidemark::cli
