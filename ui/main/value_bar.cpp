#include "ui/main/value_bar.h"

#include <cmath>
#include <glm/common.hpp>

#include "solver/point_values.h"
#include "ui/panels/value_unit.h"

namespace tidemark {

ValueBar::ValueBar(QWidget* parent) : QLabel(parent) {
  setAccessibleName(tr("Values under the mouse"));
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  setIndent(6);
}

void ValueBar::set_session(CaseSession* session) {
  if (session_) {
    disconnect(&session_->display(), nullptr, this, nullptr);
    disconnect(session_, nullptr, this, nullptr);
  }
  session_ = session;
  if (session_) {
    connect(&session_->display(), &Display::pointer_moved, this, &ValueBar::follow);
    connect(session_, &CaseSession::state_changed, this, &ValueBar::follow);
  }
  follow();
}

void ValueBar::follow() {
  const auto point = session_ ? session_->display().pointer_mm() : std::nullopt;
  if (!point) return setText(session_ ? tr("Move the mouse over a view to see values") : QString());
  const Volume& volume = session_->volume();
  const Index3 voxel(glm::round(volume.geometry.to_voxel(*point)));
  if (!volume.geometry.contains(voxel)) return setText(tr("outside the volume"));
  const CaseState& state = session_->state();
  const QString place = tr("voxel %1, %2, %3   %4, %5, %6 mm")
                            .arg(voxel.x)
                            .arg(voxel.y)
                            .arg(voxel.z)
                            .arg(point->x, 0, 'f', 1)
                            .arg(point->y, 0, 'f', 1)
                            .arg(point->z, 0, 'f', 1);
  const QString unit = volume.unit.empty() ? QString() : QLatin1Char(' ') + value_unit(volume);
  const double intensity = volume.value(voxel);
  QString values = tr("I %1%2   D %3")
                       .arg(intensity, 0, 'g', 5)
                       .arg(unit)
                       .arg(data_speed(session_->parameters(), intensity), 0, 'f', 2);
  if (state.phi && state.begun) {
    const PointValues at = values_at(*state.phi, volume, session_->parameters(), voxel);
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
