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
  [[nodiscard]] QString details_at(Index3 voxel) const;
  [[nodiscard]] QString speed_at(Index3 voxel) const;

  QPointer<engine::CaseProxy> proxy_;
  engine::SpeedSampler* speed_;
  bool detailed_ = false;
};

}  // namespace tidemark::ui
