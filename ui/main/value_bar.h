// The values under the mouse: brightness and place, in detail also D, phi, kappa and |grad phi|.
#pragma once

#include <QLabel>
#include <QPointer>

#include "engine/case_proxy.h"
#include "engine/speed_sampler.h"

namespace tidemark::ui {

class ValueBar : public QLabel {
  Q_OBJECT
 public:
  explicit ValueBar(QWidget* parent = nullptr);
  void set_proxy(engine::CaseProxy* proxy);
  void set_detailed(bool detailed);

 private:
  void follow();
  [[nodiscard]] static QString value_of(const document::CaseImage& image, glm::dvec3 place_mm);
  [[nodiscard]] QString details_at(Index3 voxel);
  [[nodiscard]] QString speed_at(Index3 voxel) const;
  // Of a speed function that has a doubt, else empty.
  [[nodiscard]] QString doubt_at(Index3 voxel);

  QPointer<engine::CaseProxy> proxy_;
  engine::SpeedSampler* speed_;
  engine::SpeedSampler* doubt_;
  std::shared_ptr<const solver::SpeedFunction> doubted_;    // the function,
  std::shared_ptr<const solver::SpeedFunction> doubt_map_;  // and its doubt
  bool detailed_ = false;
};

}  // namespace tidemark::ui
