#include "document/case.h"

#include <utility>

#include "document/checksum.h"
#include "solver/inside_region.h"

namespace tidemark::document {

Case::Case(std::shared_ptr<const Volume> volume, StudyOrigin origin)
    : volume_(std::move(volume)), origin_(std::move(origin)), labels_(volume_->geometry, &history_) {
  checksum_ = std::async(std::launch::async, [volume = volume_, stop = checksum_stop_.get_token()] {
    return checksum_of(*volume, stop);
  });
}

Case::~Case() {
  checksum_stop_.request_stop();  // else the future would wait for it
}

Result<std::unique_ptr<Case>> Case::create(std::shared_ptr<const Volume> volume, StudyOrigin origin,
                                           const solver::Parameters& parameters, solver::ExecutorKind kind,
                                           const solver::ExecutorOptions& options) {
  std::unique_ptr<Case> made(new Case(std::move(volume), std::move(origin)));
  auto level_set = LevelSet::create(made->volume_, parameters, kind, options, made->history_);
  if (!level_set) return pass_on(level_set);
  made->level_set_ = std::move(*level_set);
  return made;
}

StudyOrigin Case::origin() const {
  StudyOrigin origin = origin_;
  origin.checksum = checksum_.get();
  return origin;
}

Status Case::smooth_source(double sigma_mm) {
  return level_set_->smooth_source(sigma_mm);
}

Result<Acceptance> Case::accept_surface(std::uint8_t label, Take take, const std::string& another) {
  if (!level_set_->begun()) return fail(ErrorKind::usage, "there is no surface to accept");
  TIDEMARK_TRY(level_set_->end_run());
  const auto phi = level_set_->checkpoint();
  if (!phi) return pass_on(phi);
  const Region inside = solver::inside_region(**phi);
  if (inside.empty()) return fail(ErrorKind::usage, "the surface has no inside: there is nothing to accept");
  if (label == 0) return labels_.accept_as(another, inside, take);
  const Label* const chosen = labels_.find(label);
  if (chosen != nullptr && !another.empty()) {
    const Region there = labels_.region(label);
    if (!there.empty() && common_count(there, inside) == 0) {
      std::string kept = chosen->name;
      auto accepted = labels_.accept_as(another, inside, take);
      if (accepted) accepted->kept = std::move(kept);
      return accepted;
    }
  }
  return labels_.accept(inside, label, take);
}

Status Case::begin_from_label(std::uint8_t label, std::optional<double> within_mm, int levels) {
  const Label* known = labels_.find(label);
  if (known == nullptr) return fail(ErrorKind::usage, "there is no label {}", label);
  MaskStart from{std::make_shared<const BitMask>(labels_.geometry(), labels_.region(label)),
                 "label " + known->name};
  if (within_mm) {
    auto refined = limited(std::move(from), *within_mm);
    if (!refined) return pass_on(refined);
    from = std::move(*refined);
  }
  Start start;
  start.from = std::move(from);
  start.levels = levels;
  return level_set_->begin(start);
}

}  // namespace tidemark::document
