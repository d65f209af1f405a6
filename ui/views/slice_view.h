// Views in 2D: slices, speed maps and pages.
#pragma once

#include "core/bit_mask.h"
#include "ui/views/image_overlay.h"
#include "ui/views/marks_overlay.h"
#include "ui/views/picture_view.h"
#include "ui/views/slice_outline.h"
#include "ui/views/view_geometry.h"

namespace tidemark::ui {

enum class SlicePlane { axial, coronal, sagittal, oblique };

class SliceViewWidget : public PictureView {
  Q_OBJECT
 public:
  SliceViewWidget(engine::CaseProxy& proxy, SlicePlane plane, renderer::SliceContent content,
                  QWidget* parent = nullptr);

  [[nodiscard]] QString title() const override;
  [[nodiscard]] SlicePlane plane() const { return plane_; }
  [[nodiscard]] renderer::SliceContent content() const { return content_; }

  [[nodiscard]] QPointF position_of(glm::dvec3 patient_mm) const override;
  [[nodiscard]] std::optional<glm::dvec3> patient_at(QPointF position) const override;
  [[nodiscard]] double mm_per_pixel() const override { return screen().mm_per_pixel(); }
  [[nodiscard]] std::optional<engine::SliceSlab> slab() const override;
  [[nodiscard]] bool shows(glm::dvec3 place_mm, glm::dvec3 outward) const override;
  // Along the normal: which slice of how many is seen (1-based), and how far they are apart. Slices are
  // counted in one direction, whatever side of the patient is on the left.
  struct Place {
    std::int64_t slice = 1;
    std::int64_t slices = 1;
    double thickness_mm = 1.0;
  };
  [[nodiscard]] Place place() const;
  // The number that other systems give the slice that is seen: "instance 37", "frame 12". Empty where the
  // view looks along another plane than the slices were acquired in, or the file has none.
  [[nodiscard]] QString acquired_number() const;

 protected:
  [[nodiscard]] engine::AnyView wanted() const override { return fused_slice(); }
  [[nodiscard]] std::optional<solver::PlaneSlab> force_slab() const override;
  void paint_overlay(QPainter& painter) override;
  std::unique_ptr<Drag> begin_drag(const Pointer& pressed) override;
  std::unique_ptr<Drag> navigation_drag(const Pointer& pressed) override;
  [[nodiscard]] Qt::CursorShape cursor_at(QPointF position) const override;
  void scroll(int clicks) override;
  void zoom(double factor, QPointF about) override;

 private:
  [[nodiscard]] renderer::SliceOrientation radiological() const;
  // As it is seen: the user may want left and right the other way round, which turns the normal round.
  [[nodiscard]] renderer::SliceOrientation orientation() const;
  [[nodiscard]] renderer::SliceView slice() const;  // without further images
  [[nodiscard]] bool shows_no_speed() const;        // where its map is wanted, for want of a function
  // With the further images as far as they are there. While those of the present place are not, slice and
  // images stay where they were: neither is seen over the other's place.
  [[nodiscard]] renderer::SliceView fused_slice() const;
  [[nodiscard]] std::optional<double> swipe_line() const;  // its place from the left; none: it is not seen
  [[nodiscard]] SliceScreen screen() const;
  void paint_swipe_line(QPainter& painter) const;
  void paint_truth(QPainter& painter, const SliceScreen& on_screen);
  void paint_compared(QPainter& painter, const SliceScreen& on_screen);
  [[nodiscard]] QString compared_text() const;  // what its outline is of; empty: there is none
  void paint_preview(QPainter& painter, const SliceScreen& on_screen);
  void paint_corners(QPainter& painter) const;
  void paint_legend(QPainter& painter) const;  // of what colours mean
  [[nodiscard]] engine::DrawnMarks marks() const;
  void paint_marks(QPainter& painter, const SliceScreen& on_screen);
  void follow_marks();

  const SlicePlane plane_;
  renderer::SliceContent content_;
  SliceOutline<BitMask> truth_outline_;
  SliceOutline<solver::Field> compared_outline_;
  SliceOutline<engine::LabelPreview> preview_outline_;  // of a tool for labels
  SliceOutline<engine::LabelPreview> stroke_outline_;   // of their brush
  MarksOverlay marks_overlay_;
  engine::DrawnMarks marks_;     // as of the last state
  mutable ImageOverlay images_;  // asked for when a picture is
};

}  // namespace tidemark::ui
