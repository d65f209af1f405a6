// Models on a server of the site: which there are, and what one finds in a volume.
//
// Both functions take as long as the server does, up to its time-out: call them on a thread of their own. A
// request to stop (Progress::stop) ends them within a second with ErrorKind::cancelled, or within three where
// the server is still told to forget the image. Failures are ErrorKind::input, name the server and say what
// went wrong. What is sent are voxels, spacing, the place and the direction of the grid, and the clicks;
// nothing that says whose they are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/volume.h"
#include "imaging/ai/ai_server.h"
#include "imaging/results/segments.h"

namespace tidemark::imaging {

struct AiLabel {
  int number = 1;  // in the answer, 1 to 255
  std::string name;

  bool operator==(const AiLabel&) const = default;
};

struct AiModel {
  enum class Clicks { none, optional, required };

  std::string name;
  std::string description;  // one line; may be empty
  std::vector<AiLabel> labels;
  Clicks clicks = Clicks::none;
};

// All that work on volumes.
Result<std::vector<AiModel>> ai_models(const AiServer& server, const Progress& progress = {});

// Voxels (i, j, k) that the user says are inside or outside of what is to be found.
struct AiClicks {
  std::vector<Index3> inside;
  std::vector<Index3> outside;
};

struct AiRequest {
  AiModel model;
  std::string label;  // to which clicks inside belong; empty: the model's first
  AiClicks clicks;
};

// On the volume's grid, in voxel order.
struct AiAnswer {
  Geometry geometry;
  std::vector<float> values;    // numbers of labels, or a probability from 0 to 1
  bool is_probability = false;  // some value is none of a label
  std::vector<AiLabel> labels;  // names of the numbers, as far as the model has them
};

// Fails with ErrorKind::usage on clicks outside of the volume, and where the model needs one inside and has
// none; with ErrorKind::input on an answer that is not for this volume, that holds other values, or nothing.
Result<AiAnswer> ai_segment(const AiServer& server, const Volume& volume, const AiRequest& request,
                            const Progress& progress = {});

// A segment for each label that the answer holds; of a probability one, where it is at least one half. That
// one, and a single label of a model without names, gets the name.
Result<Segments> segments_of(const AiAnswer& answer, const std::string& name);

// As a map that drives a surface: of labels 1 inside of all, or of the one with that number, and 0 outside.
std::vector<float> map_of(const AiAnswer& answer, int label = 0);
// The inside of that map: at least one half.
Mask mask_of(const AiAnswer& answer, int label = 0);

}  // namespace tidemark::imaging
