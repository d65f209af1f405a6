#include "ui/main/value_bar.h"

#include <cmath>
#include <glm/common.hpp>

#include "solver/voxel_values.h"
#include "ui/panels/value_unit.h"
#include "ui/widgets/number_text.h"

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
                            .arg(rounded(point->x, 1), 0, 'f', 1)
                            .arg(rounded(point->y, 1), 0, 'f', 1)
                            .arg(rounded(point->z, 1), 0, 'f', 1);
  const QString unit = volume.unit.empty() ? QString() : QLatin1Char(' ') + value_unit(volume);
  const double intensity = volume.value(voxel);
  QString values = tr("I %1%2   D %3")
                       .arg(intensity + 0.0, 0, 'g', 5)
                       .arg(unit)
                       .arg(rounded(data_speed(proxy_->parameters(), intensity), 2), 0, 'f', 2);
  if (state.phi && state.begun) {
    const VoxelValues at = values_at(*state.phi, volume, proxy_->parameters(), voxel);
    const bool clamped = std::abs(at.phi) >= state.phi->band;
    values += clamped ? tr("   φ %1").arg(rounded(at.phi, 2), 0, 'f', 2)
                      : tr("   φ %1   κ %2   |∇φ| %3")
                            .arg(rounded(at.phi, 2), 0, 'f', 2)
                            .arg(rounded(at.curvature, 2), 0, 'f', 2)
                            .arg(at.gradient, 0, 'f', 2);
  }
  setText(values + QStringLiteral("      ") + place);
}

}  // namespace tidemark
