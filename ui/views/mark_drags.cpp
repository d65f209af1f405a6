#include "ui/views/mark_drags.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>

#include "solver/speed/speed_registry.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

constexpr const char* kExamples = "examples";  // in the registry of speed functions

engine::Mark mark_of(const Pointer& pressed) {
  if (pressed.modifiers.testFlag(Qt::ControlModifier)) return engine::Mark::none;
  return pressed.button == Qt::RightButton ? engine::Mark::outside : engine::Mark::inside;
}

solver::Constraint constraint_of(const Pointer& pressed) {
  if (pressed.button == Qt::RightButton) return solver::Constraint::none;
  return pressed.modifiers.testFlag(Qt::ShiftModifier) ? solver::Constraint::anchor
                                                       : solver::Constraint::wall;
}

}  // namespace

std::vector<glm::dvec3> way_between(glm::dvec3 from_mm, glm::dvec3 to_mm, double stride_mm) {
  const auto strides = static_cast<int>(std::ceil(glm::distance(from_mm, to_mm) / stride_mm));
  if (strides == 0) return {to_mm};
  std::vector<glm::dvec3> way;
  for (int stride = 1; stride <= strides; ++stride)
    way.push_back(glm::mix(from_mm, to_mm, static_cast<double>(stride) / strides));
  return way;
}

ExampleDrag::ExampleDrag(DragView view, const Pointer& pressed)
    : Drag(std::move(view)),
      mark_(mark_of(pressed)),
      radius_mm_(display().settings().stroke_voxels * this->view().slab->finest_mm()),
      last_mm_(*pressed.patient_mm) {
  dab(last_mm_, last_mm_);
}

ExampleDrag::~ExampleDrag() {
  display().set_drawn_marks(std::nullopt);
}

void ExampleDrag::dab(glm::dvec3 from_mm, glm::dvec3 to_mm) {
  for (const glm::dvec3& place : way_between(from_mm, to_mm, std::max(0.5 * radius_mm_, 0.1))) {
    const std::vector<std::int64_t> disc = view().slab->disc(place, radius_mm_);
    std::vector<std::int64_t> all;
    all.reserve(voxels_.size() + disc.size());
    std::ranges::set_union(voxels_, disc, std::back_inserter(all));
    voxels_ = std::move(all);
  }
  const document::Drive& drive = proxy().drive();
  strokes_ = engine::painted(drive.strokes.get(), voxels_, mark_);
  display().set_drawn_marks(engine::DrawnMarks{strokes_, drive.constraints});
}

void ExampleDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm || *pointer.patient_mm == last_mm_) return;
  dab(last_mm_, *pointer.patient_mm);
  last_mm_ = *pointer.patient_mm;
}

void ExampleDrag::release() {
  const auto teach = [voxels = voxels_, mark = mark_](document::Drive& drive) {
    drive = taught(drive, engine::painted(drive.strokes.get(), voxels, mark));
  };
  proxy().take_stroke(teach, voxels_, display().settings().stroke_steps);
}

QString ExampleDrag::text() const {
  const auto count = static_cast<qint64>(voxels_.size());
  switch (mark_) {
    case engine::Mark::inside:
      return tr("inside: %1 voxels", nullptr, form_of(count)).arg(count_text(count));
    case engine::Mark::outside:
      return tr("outside: %1 voxels", nullptr, form_of(count)).arg(count_text(count));
    case engine::Mark::none:
      break;
  }
  return tr("takes strokes away");
}

ConstraintDrag::ConstraintDrag(DragView view, const Pointer& pressed)
    : Drag(std::move(view)),
      what_(constraint_of(pressed)),
      radius_mm_(display().settings().brush_mm),
      last_mm_(*pressed.patient_mm),
      before_(proxy().drive().constraints),
      constraints_(before_) {
  dab(last_mm_, last_mm_);
}

ConstraintDrag::~ConstraintDrag() {
  display().set_drawn_marks(std::nullopt);
}

void ConstraintDrag::dab(glm::dvec3 from_mm, glm::dvec3 to_mm) {
  std::vector<solver::Sphere> spheres;
  for (const glm::dvec3& place : way_between(from_mm, to_mm, 0.4 * radius_mm_))
    spheres.push_back({place, radius_mm_});
  constraints_ = with_spheres(constraints_.get(), proxy().volume().geometry, spheres, what_);
  spheres_.insert(spheres_.end(), spheres.begin(), spheres.end());
  display().set_drawn_marks(engine::DrawnMarks{proxy().drive().strokes, constraints_});
}

void ConstraintDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm || *pointer.patient_mm == last_mm_) return;
  dab(last_mm_, *pointer.patient_mm);
  last_mm_ = *pointer.patient_mm;
}

void ConstraintDrag::release() {
  const auto hold = [before = before_, after = constraints_, spheres = spheres_, what = what_,
                     geometry = proxy().volume().geometry](document::Drive& drive) {
    const bool as_drawn = drive.constraints == before;
    drive.constraints = as_drawn ? after : with_spheres(drive.constraints.get(), geometry, spheres, what);
  };
  proxy().change_drive(hold, engine::CaseProxy::new_gesture());
}

document::Drive taught(document::Drive drive, std::shared_ptr<const solver::Strokes> strokes) {
  const bool could = engine::can_teach(drive.strokes.get());
  drive.strokes = std::move(strokes);
  const bool can = engine::can_teach(drive.strokes.get());
  const auto is_examples = [](const solver::SpeedTerm& term) { return term.function == kExamples; };
  auto& terms = drive.setting.terms;
  if (!can) {
    // Nothing can be learned any more.
    std::erase_if(terms, is_examples);
    if (terms.empty()) terms.push_back({});
  } else if (!could && solver::speed_kind(kExamples) && std::ranges::none_of(terms, is_examples)) {
    terms = {solver::SpeedTerm{kExamples, {}}};
  }
  return drive;
}

std::shared_ptr<const solver::Constraints> with_spheres(const solver::Constraints* constraints,
                                                        const Geometry& geometry,
                                                        const std::vector<solver::Sphere>& spheres,
                                                        solver::Constraint what) {
  auto after = constraints ? std::make_shared<solver::Constraints>(*constraints)
                           : std::make_shared<solver::Constraints>(geometry.size);
  for (const solver::Sphere& sphere : spheres) after->set(geometry, sphere, what);
  if (after->empty()) return nullptr;
  return after;
}

QString missing_examples(const solver::Strokes* strokes) {
  const bool inside = strokes && !strokes->inside.empty();
  const bool outside = strokes && !strokes->outside.empty();
  if (inside && outside) return {};
  if (inside) return tr("Paint outside, too: the right button.");
  if (outside) return tr("Paint inside, too: the left button.");
  return tr("Paint inside with the left button, outside with the right one.");
}

}  // namespace tidemark::ui
