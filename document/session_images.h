// The further images and the speed maps of a session, read again from where they were.
#pragma once

#include <string>
#include <vector>

#include "core/progress.h"
#include "document/session_contents.h"

namespace tidemark::document {

// Gives images and maps of a session and of all its drives their voxels. What cannot be had stays without:
// the session keeps it, and where it was. Returns one sentence a problem.
std::vector<std::string> find_images(SessionContents& contents, const Progress& progress = {});

// Gives all drives of a recipe the images that are at hand, by checksum. Images that lie at the same place
// are one.
void give_images(Recipe& recipe, std::vector<std::shared_ptr<const CaseImage>> images);

}  // namespace tidemark::document
