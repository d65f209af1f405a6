#include "ui/main/value_bar.h"

#include <cmath>
#include <glm/common.hpp>

#include "solver/voxel_values.h"
#include "ui/panels/value_unit.h"

namespace tidemark {

ValueBar::ValueBar(QWidget* parent) : QLabel(parent) {
  setAccessibleName(tr("Values under the mouse"));
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  setIndent(6);
}

void ValueBar::set_proxy(CaseProxy* proxy) {
  if (proxy_) {
    disconnect(&proxy_->display(), nullptr, this, nullptr);
    disconnect(proxy_, nullptr, this, nullptr);
  }
  proxy_ = proxy;
  if (proxy_) {
    connect(&proxy_->display(), &Display::pointer_moved, this, &ValueBar::follow);
    connect(proxy_, &CaseProxy::state_changed, this, &ValueBar::follow);
  }
  follow();
}

void ValueBar::follow() {
  const auto point = proxy_ ? proxy_->display().pointer_mm() : std::nullopt;
  if (!point) return setText(proxy_ ? tr("Move the mouse over a view to see values") : QString());
  const Volume& volume = proxy_->volume();
  const Index3 voxel(glm::round(volume.geometry.to_voxel(*point)));
  if (!volume.geometry.contains(voxel)) return setText(tr("outside the volume"));
  const CaseState& state = proxy_->state();
  const QString place = tr("voxel %1, %2, %3   %4, %5, %6 mm")
                            .arg(voxel.x)
                            .arg(voxel.y)
                            .arg(voxel.z)
                            .arg(point->x, 0, 'f', 1)
                            .arg(point->y, 0, 'f', 1)
                            .arg(point->z, 0, 'f', 1);
  const QString unit = volume.unit.empty() ? QString() : QLatin1Char(' ') + value_unit(volume);
  const Volume& source = *proxy_->source();
  QString values = tr("I %1%2").arg(volume.value(voxel), 0, 'g', 5).arg(unit);
  if (state.smoothed_mm > 0.0) values += tr("   smoothed %1").arg(source.value(voxel), 0, 'g', 5);
  values += tr("   D %1").arg(data_speed(proxy_->parameters(), source.value(voxel)), 0, 'f', 2);
  if (state.phi && state.begun) {
    const VoxelValues at = values_at(*state.phi, source, proxy_->parameters(), voxel);
    const bool clamped = std::abs(at.phi) >= state.phi->band;
    values += clamped ? tr("   φ %1").arg(at.phi, 0, 'f', 2)
                      : tr("   φ %1   κ %2   |∇φ| %3")
                            .arg(at.phi, 0, 'f', 2)
                            .arg(at.curvature, 0, 'f', 2)
                            .arg(at.gradient, 0, 'f', 2);
  }
  setText(values + QStringLiteral("      ") + place);
}

}  // namespace tidemark
