#include "ui/main/value_bar.h"

#include <cmath>
#include <glm/common.hpp>

#include "solver/speed/doubt_map.h"
#include "solver/voxel_values.h"
#include "ui/panels/value_unit.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {

ValueBar::ValueBar(QWidget* parent)
    : QLabel(parent), speed_(new engine::SpeedSampler(this)), doubt_(new engine::SpeedSampler(this)) {
  connect(speed_, &engine::SpeedSampler::answered, this, &ValueBar::follow);
  connect(doubt_, &engine::SpeedSampler::answered, this, &ValueBar::follow);
  setAccessibleName(tr("Values under the mouse"));
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  setIndent(6);
  setToolTip(
      tr("Under the mouse: the brightness I, the voxel and its place in mm (LPS),\n"
         "and the value of each further image that is shown.\n"
         "In detail: the data term D (above 0 the surface grows here), its doubt in bits, φ (positive inside "
         "the surface),\n"
         "and near the surface its curvature κ and the slope of φ."));
}

void ValueBar::set_detailed(bool detailed) {
  detailed_ = detailed;
  follow();
}

void ValueBar::set_proxy(engine::CaseProxy* proxy) {
  if (proxy_) {
    disconnect(&proxy_->display(), nullptr, this, nullptr);
    disconnect(proxy_, nullptr, this, nullptr);
  }
  proxy_ = proxy;
  if (proxy_) {
    connect(&proxy_->display(), &engine::Display::pointer_moved, this, &ValueBar::follow);
    connect(&proxy_->display(), &engine::Display::changed, this, &ValueBar::follow);
    connect(proxy_, &engine::CaseProxy::state_changed, this, &ValueBar::follow);
  }
  follow();
}

void ValueBar::follow() {
  const auto point = proxy_ ? proxy_->display().pointer_mm() : std::nullopt;
  if (!point) return setText(proxy_ ? tr("Move the mouse over a view to see values") : QString());
  const Volume& volume = proxy_->volume();
  const Index3 voxel(glm::round(volume.geometry.to_voxel(*point)));
  if (!volume.geometry.contains(voxel)) return setText(tr("outside the volume"));
  const QString place = tr("voxel %1, %2, %3   %4, %5, %6 mm")
                            .arg(voxel.x)
                            .arg(voxel.y)
                            .arg(voxel.z)
                            .arg(number_text(point->x, 1))
                            .arg(number_text(point->y, 1))
                            .arg(number_text(point->z, 1));
  const QString unit = volume.unit.empty() ? QString() : QLatin1Char(' ') + value_unit(volume);
  const Volume& source = *proxy_->source();
  QString values = tr("I %1%2").arg(general_text(volume.value(voxel), 5), unit);
  if (proxy_->state().smoothed_mm > 0.0) {
    values += tr("   smoothed %1").arg(general_text(source.value(voxel), 5));
  }
  for (const engine::ShownImage& shown : proxy_->display().settings().images) {
    if (shown.visible && shown.image->volume) values += value_of(*shown.image, *point);
  }
  if (detailed_) values += details_at(voxel);
  setText(values + QStringLiteral("      ") + place);
}

// The tent is known at once; other functions may take a while.
QString ValueBar::speed_at(Index3 voxel) const {
  const auto text = [](double speed) { return number_text(speed, 2); };
  if (proxy_->state().lacks_speed) return QStringLiteral("–");
  const auto& function = proxy_->state().speed;
  if (!function) return text(solver::data_speed(proxy_->parameters(), proxy_->source()->value(voxel)));
  speed_->ask({function, voxel, Index3(1)});
  return speed_->answer() ? text(speed_->answer()->front()) : QStringLiteral("…");
}

QString ValueBar::value_of(const document::CaseImage& image, glm::dvec3 place_mm) {
  const QString name = QString::fromStdString(image.name);
  const auto value = engine::value_at(image, place_mm);
  if (!value) return tr("   %1 –").arg(name);
  const QString unit = image.volume->unit.empty() ? QString() : QLatin1Char(' ') + value_unit(*image.volume);
  return tr("   %1 %2%3").arg(name, general_text(*value, 4), unit);
}

QString ValueBar::doubt_at(Index3 voxel) {
  if (proxy_->state().speed != doubted_) {
    doubted_ = proxy_->state().speed;
    doubt_map_ = solver::doubt_map(doubted_);
  }
  if (!doubt_map_) return {};
  doubt_->ask({doubt_map_, voxel, Index3(1)});
  return tr("   doubt %1")
      .arg(doubt_->answer() ? number_text(doubt_->answer()->front(), 2) : QStringLiteral("…"));
}

QString ValueBar::details_at(Index3 voxel) {
  const engine::CaseState& state = proxy_->state();
  QString values = tr("   D %1").arg(speed_at(voxel)) + doubt_at(voxel);
  if (!state.phi || !state.begun) return values;
  const solver::VoxelValues at = solver::values_at(*state.phi, voxel);
  values += tr("   φ %1").arg(number_text(at.phi, 2));
  const bool clamped = std::abs(at.phi) >= state.phi->band;
  if (!clamped)
    values += tr("   κ %1   |∇φ| %2").arg(number_text(at.curvature, 2), number_text(at.gradient, 2));
  return values;
}

}  // namespace tidemark::ui
