#include "ui/views/probe_drags.h"

#include <algorithm>

#include "ui/views/overlay.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

// A voxel beside the mouse counts too: a drag over a thin structure then has enough of them.
double reach_mm(const Geometry& geometry) {
  const glm::dvec3 spacing = geometry.spacing_mm;
  return 1.1 * std::min({spacing.x, spacing.y, spacing.z});
}

double range_of(const engine::CaseProxy& proxy, const engine::ValueProbe::Spread& values) {
  const engine::SourceSummary& summary = proxy.summary();
  return std::max(values.deviation, engine::least_probed_range(summary.low, summary.high));
}

// Of the values that are probed.
int probed_decimals(const engine::CaseProxy& proxy) {
  return value_decimals(proxy.summary().high - proxy.summary().low);
}

void set_speed(engine::CaseProxy& proxy, const engine::ValueProbe::Spread& values, std::uint64_t gesture) {
  const auto set = [target = values.mean, range = range_of(proxy, values)](solver::Parameters& parameters) {
    parameters.target = target;
    parameters.range = range;
  };
  proxy.change_parameters(set, gesture);
}

}  // namespace

ProbeDrag::ProbeDrag(DragView view, const Pointer& pressed, std::shared_ptr<const Volume> volume)
    : Drag(std::move(view)), probe_(std::move(volume)), last_mm_(*pressed.patient_mm) {
  probe_.add(last_mm_, last_mm_, reach_mm(proxy().volume().geometry));
  way_mm_.push_back(last_mm_);
}

void ProbeDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm) return;
  probe_.add(last_mm_, *pointer.patient_mm, reach_mm(proxy().volume().geometry));
  last_mm_ = *pointer.patient_mm;
  way_mm_.push_back(last_mm_);
  if (probe_.count() >= kEnough) set();
}

void ProbeDrag::paint(QPainter& painter) const {
  QPolygonF line;
  for (const glm::dvec3& point : way_mm_) line << view().position_of(point);
  paint_line(painter, line);
}

SpeedProbeDrag::SpeedProbeDrag(DragView view, const Pointer& pressed)
    : ProbeDrag(view, pressed, view.proxy.source()) {}

void SpeedProbeDrag::set() {
  set_speed(proxy(), probe().values(), gesture_);
}

void probe_speed_at(engine::CaseProxy& proxy, glm::dvec3 place_mm) {
  constexpr double kVoxels = 3.0;
  engine::ValueProbe probe(proxy.source());  // as D sees it
  probe.add(place_mm, place_mm, kVoxels * reach_mm(proxy.volume().geometry));
  if (probe.count() > 0) set_speed(proxy, probe.values(), engine::CaseProxy::new_gesture());
}

QString SpeedProbeDrag::text() const {
  const engine::ValueProbe::Spread values = probe().values();
  const int decimals = probed_decimals(proxy());
  return tr("T %1   ε %2   (%3 voxels)", nullptr, form_of(probe().count()))
      .arg(number_text(values.mean, decimals), number_text(range_of(proxy(), values), decimals),
           count_text(probe().count()));
}

TransferProbeDrag::TransferProbeDrag(DragView view, const Pointer& pressed)
    : ProbeDrag(view, pressed, view.proxy.study().volume) {}

void TransferProbeDrag::set() {
  const engine::SourceSummary& summary = proxy().summary();
  const engine::ValueProbe::Spread values = probe().values();
  const engine::ValueProbe::Spread gradients = probe().gradients();
  display().change([&](engine::DisplaySettings& settings) {
    settings.transfer = settings.transfer.for_range(summary.low, summary.high);
    auto& primitives = settings.transfer.source;
    if (primitives.empty()) primitives.push_back({});
    const auto chosen =
        std::min(static_cast<std::size_t>(std::max(settings.chosen_primitive, 0)), primitives.size() - 1);
    renderer::SourcePrimitive& primitive = primitives[chosen];
    // A Gaussian here falls to 1/e at its width, which is sqrt(2) standard deviations.
    constexpr double kWidth = 1.4142135623730951;
    const double least = engine::least_probed_range(summary.low, summary.high);
    primitive.value = {renderer::TransferFactor::Kind::gaussian, values.mean,
                       std::max(kWidth * values.deviation, least)};
    if (primitive.gradient.kind == renderer::TransferFactor::Kind::gaussian) {
      primitive.gradient.start = gradients.mean;
      primitive.gradient.end =
          std::max(kWidth * gradients.deviation, 0.01 * static_cast<double>(summary.steepest));
    }
    settings.chosen_primitive = static_cast<int>(chosen);
    settings.show_source = true;
  });
}

QString TransferProbeDrag::text() const {
  const engine::ValueProbe::Spread values = probe().values();
  const engine::ValueProbe::Spread gradients = probe().gradients();
  const int decimals = probed_decimals(proxy());
  const int of_gradients = value_decimals(proxy().summary().steepest);
  return tr("value %1 ± %2   gradient %3 ± %4")
      .arg(number_text(values.mean, decimals), number_text(values.deviation, decimals),
           number_text(gradients.mean, of_gradients), number_text(gradients.deviation, of_gradients));
}

}  // namespace tidemark::ui
