// The ways to begin a level set (paper section 6.1): drawn spheres, values, what is there already.
#pragma once

#include <utility>

#include "ui/panels/per_case.h"
#include "ui/panels/start_method.h"

class QComboBox;
class QLabel;
class QToolButton;

namespace tidemark::ui {

class RefineChoice;
class SliderNumber;

// A sphere around the crosshair; in views spheres are drawn with the mouse.
class SphereStartMethod : public StartMethod {
  Q_OBJECT
 public:
  explicit SphereStartMethod(QWidget* parent = nullptr);
  [[nodiscard]] QString title() const override { return tr("Spheres"); }
  [[nodiscard]] QString sentence() const override;
  [[nodiscard]] bool can_start() const override;
  void start(int levels) override;

 protected:
  void refresh() override;

 private:
  QToolButton* draw_;
  SliderNumber* radius_;
};

// All voxels in a range of values, or those of them that are connected to the crosshair.
class ValueStartMethod : public StartMethod {
  Q_OBJECT
 public:
  enum class Extent { everywhere, connected };
  explicit ValueStartMethod(Extent extent, QWidget* parent = nullptr);
  [[nodiscard]] QString title() const override;
  [[nodiscard]] QString sentence() const override;
  [[nodiscard]] bool can_start() const override;
  void start(int levels) override;

 protected:
  void attach() override;
  void refresh() override;

 private:
  void take_tent();
  void keep();
  [[nodiscard]] QString range_text() const;
  [[nodiscard]] std::optional<Index3> voxel() const;  // under the crosshair
  [[nodiscard]] QString everywhere_text() const;
  [[nodiscard]] QString connected_text() const;

  Extent extent_;
  PerCase<std::pair<double, double>> chosen_;  // the values, once the user has changed them
  SliderNumber* low_;
  SliderNumber* high_;
  QLabel* here_ = nullptr;  // the value under the crosshair
};

// All voxels where the speed is above 0, whatever drives the surface.
class SpeedStartMethod : public StartMethod {
  Q_OBJECT
 public:
  explicit SpeedStartMethod(QWidget* parent = nullptr);
  [[nodiscard]] QString title() const override { return tr("Speed above 0"); }
  [[nodiscard]] QString sentence() const override;
  [[nodiscard]] bool can_start() const override;
  void start(int levels) override;

 protected:
  void refresh() override { emit changed(); }

 private:
  // Whether the speed is known before there is a surface.
  [[nodiscard]] bool is_known() const;
};

// A label that was segmented before.
class LabelStartMethod : public StartMethod {
  Q_OBJECT
 public:
  explicit LabelStartMethod(QWidget* parent = nullptr);
  [[nodiscard]] QString title() const override { return tr("Label"); }
  [[nodiscard]] QString sentence() const override;
  [[nodiscard]] bool can_start() const override;
  void start(int levels) override;

 protected:
  void attach() override;
  void refresh() override;

 private:
  std::vector<document::Label> shown_;
  QComboBox* label_;
  RefineChoice* refine_;
};

}  // namespace tidemark::ui
