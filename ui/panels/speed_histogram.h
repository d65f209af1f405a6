// The certainty of a speed function: the histogram of the probability p = (D + 1) / 2 in the slice at the
// crosshair.
#pragma once

#include <vector>

#include "engine/speed_sampler.h"
#include "ui/panels/case_widget.h"

namespace tidemark::ui {

// Right of the middle the surface grows. Voxels near the middle are in doubt.
class SpeedHistogram : public CaseWidget {
  Q_OBJECT
 public:
  explicit SpeedHistogram(QWidget* parent = nullptr);

  // Counts from p = 0 to 1; empty: not known yet.
  [[nodiscard]] const std::vector<double>& bars() const { return bars_; }
  [[nodiscard]] QSize sizeHint() const override { return {240, 104}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {120, 84}; }

 protected:
  void attach() override;
  void refresh() override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void clear();
  void count();

  engine::SpeedSampler* sampler_;
  std::vector<double> bars_;
  double growing_ = 0.0;   // the share of voxels with D > 0
  double doubtful_ = 0.0;  // of those with p between a quarter and three quarters
};

}  // namespace tidemark::ui
