// Three slices, the speed map and the surface in one picture.
#pragma once

#include "renderer/renderer.h"

namespace tidemark::renderer {

struct SheetView {
  glm::dvec3 position_mm{0.0};  // the slices go through it (LPS)
  WindowLevel window;
  bool sides_are_known = true;  // of the patient: else "?" is written at the edges
  bool speed = false;           // with the speed map: the parameters are those of the study
  SpeedTerm term = SpeedTerm::data;
  bool nearest = false;   // of slices, as in SliceView
  bool contours = false;  // likewise
  VolumeView volume;
};

// Axial, coronal and sagittal side by side; below them the speed map (axial) and the 3D view, all with
// orientation letters and a scale bar. The size is rounded down to what three columns and two rows share.
Result<Picture> draw_sheet(Renderer& renderer, const SheetView& view, PictureSize size,
                           const Progress& progress = {});

// The finished picture of a still view: the mean of all its rounds (Renderer::still_rounds()).
Result<Picture> draw_still(Renderer& renderer, const VolumeView& view, PictureSize size,
                           const Progress& progress = {});

// A slice or a still 3D view with letters and scale bar, as annotate() writes them.
Result<Picture> draw_annotated(Renderer& renderer, const SliceView& view, PictureSize size,
                               bool sides_are_known, const Progress& progress = {});
Result<Picture> draw_annotated(Renderer& renderer, const VolumeView& view, PictureSize size,
                               bool sides_are_known, const Progress& progress = {});

// The voxel in the middle of the inside (LPS, mm), and the box around the inside with a voxel more on each
// side; of the volume when there is no surface.
glm::dvec3 middle_of(const solver::Field& phi);
Box box_around(const solver::Field& phi);

// The box along the patient's axes around a box of voxels, whose ends are voxel coordinates.
Box box_around(glm::dvec3 low, glm::dvec3 high, const Geometry& geometry);

// The file's own window, or one over the values that are common.
WindowLevel window_of(const Volume& source);

}  // namespace tidemark::renderer
