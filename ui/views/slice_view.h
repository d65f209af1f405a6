// Views in 2D: slices, speed maps and pages.
#pragma once

#include "ui/views/picture_view.h"
#include "ui/views/view_geometry.h"

namespace tidemark {

enum class SlicePlane { axial, coronal, sagittal, oblique };

class SliceViewWidget : public PictureView {
  Q_OBJECT
 public:
  SliceViewWidget(CaseProxy& proxy, SlicePlane plane, SliceContent content, QWidget* parent = nullptr);

  [[nodiscard]] QString title() const override;
  [[nodiscard]] SlicePlane plane() const { return plane_; }
  [[nodiscard]] SliceContent content() const { return content_; }
  void set_plane(SlicePlane plane);

  [[nodiscard]] QPointF position_of(glm::dvec3 patient_mm) const override;
  [[nodiscard]] std::optional<glm::dvec3> patient_at(QPointF position) const override;
  [[nodiscard]] double mm_per_pixel() const override { return screen().mm_per_pixel(); }
  // Along the normal: which slice of how many is seen (1-based), and how far they are apart.
  struct Place {
    std::int64_t slice = 1;
    std::int64_t slices = 1;
    double thickness_mm = 1.0;
  };
  [[nodiscard]] Place place() const;

 protected:
  [[nodiscard]] AnyView wanted() const override { return slice(); }
  void paint_overlay(QPainter& painter) override;
  std::unique_ptr<Drag> navigation_drag(const Pointer& pressed) override;
  void scroll(int clicks) override;
  void zoom(double factor, QPointF about) override;

 private:
  [[nodiscard]] SliceOrientation orientation() const;
  [[nodiscard]] SliceView slice() const;
  [[nodiscard]] SliceScreen screen() const;
  void paint_corners(QPainter& painter) const;

  SlicePlane plane_;
  SliceContent content_;
};

}  // namespace tidemark
