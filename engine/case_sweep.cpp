#include "engine/case_sweep.h"

#include "document/sweep_picture.h"
#include "engine/case_proxy.h"

namespace tidemark::engine {
namespace {

constexpr int kPictureSide = 128;  // pixels
// Of what a solver may take: the case's own executor has the other half.
constexpr std::int64_t kBudgetShare = 2;

QImage image_of(const document::SweepPicture& picture) {
  return QImage(picture.pixels.data(), picture.side, picture.side, QImage::Format_RGBA8888).copy();
}

// On a grid of its own: the box that holds all of it.
std::shared_ptr<const Volume> volume_of(const document::Agreement& agreement, const Geometry& grid) {
  if (agreement.size().x == 0) return nullptr;
  auto volume = std::make_shared<Volume>();
  volume->geometry = grid;
  volume->geometry.size = agreement.size();
  volume->geometry.origin_mm = grid.to_patient(glm::dvec3(agreement.first()));
  const auto counts = agreement.counts();
  volume->voxels = std::vector<std::uint16_t>(counts.begin(), counts.end());
  return volume;
}

ShownImage shown_agreement(const document::Agreement& agreement, const Geometry& grid) {
  auto image = std::make_shared<document::CaseImage>();
  image->volume = volume_of(agreement, grid);
  const double all = agreement.surfaces();
  ShownImage shown;
  shown.colours = ImageColours::heat;
  shown.opacity = 0.6;
  shown.window = {0.5 * all, all};
  shown.used = false;
  shown.image = std::move(image);
  return shown;
}

Result<std::shared_ptr<const SweepOutcome>> computed(const document::SweepStart& start,
                                                     document::SweepOptions options, const BitMask* truth,
                                                     const WindowLevel& window, const Progress& progress) {
  if (truth != nullptr) options.truth = std::make_shared<const Region>(*truth);
  auto sweep = document::run_sweep(start, options, progress);
  if (!sweep) return pass_on(sweep);
  auto outcome = std::make_shared<SweepOutcome>();
  outcome->start = start;
  outcome->sweep = std::move(*sweep);
  const Geometry& grid = start.source->geometry;
  const document::SweepCut cut = document::sweep_cut(outcome->sweep.agreement, grid);
  for (const document::SweepRun& run : outcome->sweep.runs) {
    outcome->pictures.push_back(
        image_of(document::picture_of(run.inside, *start.source, window, cut, kPictureSide)));
  }
  outcome->agreement = shown_agreement(outcome->sweep.agreement, grid);
  return std::shared_ptr<const SweepOutcome>(std::move(outcome));
}

}  // namespace

CaseSweep::CaseSweep(CaseProxy& proxy) : proxy_(proxy) {
  connect(this, &JobRunner::failed, this, &CaseSweep::changed);
  connect(this, &JobRunner::cancelled, this, &CaseSweep::changed);
}

void CaseSweep::start(const std::vector<document::SweepAxis>& axes) {
  document::SweepOptions options;
  options.axes = axes;
  options.memory_budget_bytes /= kBudgetShare;
  waiting_ = true;
  proxy_.prepare_sweep([this, options, this_time = ++asked_](const Result<document::SweepStart>& start) {
    if (this_time != asked_ || !waiting_) return;
    waiting_ = false;
    if (start) return compute(*start, options);
    end_by(start.error());
  });
  emit changed();
}

void CaseSweep::compute(const document::SweepStart& start, const document::SweepOptions& options) {
  run([start, options, truth = proxy_.truth(), window = proxy_.display().settings().window](
          const Progress& progress) { return computed(start, options, truth.get(), window, progress); },
      [this](std::shared_ptr<const SweepOutcome> outcome) {
        outcome_ = std::move(outcome);
        emit changed();
      });
  emit changed();
}

void CaseSweep::cancel() {
  if (std::exchange(waiting_, false)) emit cancelled();
  give_up();
}

std::shared_ptr<const document::Agreement> CaseSweep::agreement() const {
  if (!outcome_ || outcome_->sweep.agreement.not_empty() == 0) return nullptr;
  return {outcome_, &outcome_->sweep.agreement};
}

void CaseSweep::take(int column, int row) {
  if (outcome_) proxy_.take_run({outcome_, &outcome_->start}, outcome_->sweep.at(column, row));
}

}  // namespace tidemark::engine
