#include "engine/lesson_course.h"

#include <algorithm>
#include <utility>

#include "engine/case_proxy.h"

namespace tidemark::engine {
namespace {

constexpr double kWatchedSeconds = 3.0;   // that a try is watched for, where it is quicker than that
constexpr std::int64_t kLongSteps = 600;  // a surface that is to rest mostly does so within these

}  // namespace

// A try under way. Those it goes on from come first.
struct LessonCourse::Attempt {
  std::size_t part = 0;             // that is wanted
  std::vector<std::size_t> parts;   // still to be carried out, in reverse order
  LessonCase* on = nullptr;         // null: its study is being opened
  std::int64_t first_step = 0;      // of the part that plays
  QMetaObject::Connection waiting;  // for the smoothed source
};

LessonCourse::LessonCourse(document::Lesson lesson, std::filesystem::path folder, QObject* parent)
    : QObject(parent), lesson_(std::move(lesson)), folder_(std::move(folder)), tried_(lesson_.parts.size()) {
  answers_.parts.resize(lesson_.parts.size());
  cases_.reserve(lesson_.parts.size());  // an attempt points into it
  connect(&loader_, &StudyLoader::loaded, this, [this](const std::shared_ptr<const LoadedStudy>& study) {
    auto changed = std::make_shared<LoadedStudy>(*study);
    changed->parameters = part().attempt ? part().attempt->parameters : lesson_.parameters;
    emit case_wanted(changed);
  });
  connect(&loader_, &StudyLoader::failed, this, [this](const QString& message) {
    opening_.reset();
    end_attempt();
    emit failed(message);
  });
  connect(&meter_, &LessonMeter::measured, this, &LessonCourse::take_figures);
  connect(&meter_, &LessonMeter::failed, this, [this](const QString& message) {
    measuring_ = false;
    emit failed(message);
    emit changed();
  });
}

LessonCourse::~LessonCourse() = default;

void LessonCourse::go_to(std::size_t index) {
  if (index >= lesson_.parts.size() || index == index_) return;
  stop();
  meter_.cancel();
  measuring_ = false;
  index_ = index;
  emit changed();
  open_study();
}

void LessonCourse::go_on_from(const document::LessonProgress& progress) {
  answers_.parts = progress.parts;
  tried_ = progress.tried;
  index_ = progress.part;
  emit changed();
}

bool LessonCourse::begun() const {
  const auto empty = [](const document::PartAnswers& given) { return given == document::PartAnswers{}; };
  return !std::all_of(answers_.parts.begin(), answers_.parts.end(), empty) ||
         std::any_of(tried_.begin(), tried_.end(), [](char tried) { return tried != 0; });
}

// Questions.

bool LessonCourse::can_answer() const {
  const bool chosen = !part().attempt && given().choice.has_value();
  return !tried(index_) && !attempting() && !chosen;
}

void LessonCourse::choose(std::size_t choice) {
  if (!can_answer()) return;
  answers_.parts[index_].choice = choice;
  emit changed();
}

void LessonCourse::answer(const QString& words) {
  if (!can_answer()) return;
  answers_.parts[index_].words = words.trimmed().toStdString();
  emit changed();
}

bool LessonCourse::answered(std::size_t part) const {
  const auto& question = lesson_.parts[part].question;
  if (!question) return true;
  const document::PartAnswers& given = answers_.parts[part];
  return question->choices.empty() ? !given.words.empty() : given.choice.has_value();
}

// Cases.

const LessonCourse::LessonCase* LessonCourse::case_of(std::size_t part) const {
  const document::LessonStudy& study = lesson_.study_of(lesson_.parts[part]);
  const auto found = std::find_if(cases_.begin(), cases_.end(), [&](const LessonCase& one) {
    return one.study == study && one.proxy != nullptr;
  });
  return found == cases_.end() ? nullptr : &*found;
}

LessonCourse::LessonCase* LessonCourse::case_of(std::size_t part) {
  return const_cast<LessonCase*>(std::as_const(*this).case_of(part));
}

CaseProxy* LessonCourse::proxy() const {
  const LessonCase* found = case_of(index_);
  return found ? found->proxy.data() : nullptr;
}

void LessonCourse::open_study() {
  const document::LessonStudy& study = lesson_.study_of(part());
  if (opening_ == study) return;
  close_study();
  if (case_of(index_)) return;
  opening_ = study;
  if (study.phantom.empty()) return loader_.load(folder_ / study.file, {});
  loader_.make_phantom(study.phantom);
}

void LessonCourse::close_study() {
  loader_.cancel();
  opening_.reset();
}

void LessonCourse::take_case(CaseProxy& proxy) {
  if (!opening_) return;
  const document::LessonStudy study = *std::exchange(opening_, std::nullopt);
  cases_.erase(std::remove_if(cases_.begin(), cases_.end(),
                              [&](const LessonCase& one) { return one.study == study || !one.proxy; }),
               cases_.end());
  cases_.push_back({study, &proxy, {}, 0, 0});
  // Once it is gone: those who listen look at windows, and its window is being destroyed with it.
  connect(&proxy, &QObject::destroyed, this, &LessonCourse::follow_closing, Qt::QueuedConnection);
  connect(&proxy, &CaseProxy::state_changed, this, &LessonCourse::changed);
  connect(&proxy, &CaseProxy::failed, this, [this, of = &proxy] { follow_failure(*of); });
  if (attempt_) return begin();
  emit changed();
}

void LessonCourse::follow_failure(const CaseProxy& of) {
  if (attempt_ && attempt_->on && attempt_->on->proxy == &of) break_off();
}

// A case that is gone sends no figures; those that the meter is taking still come.
void LessonCourse::follow_closing() {
  if (attempt_ && attempt_->on && !attempt_->on->proxy) end_attempt();
  if (!meter_.busy() && !case_of(measured_part_)) measuring_ = false;
  emit changed();
}

// Tries.

bool LessonCourse::can_attempt() const {
  return part().attempt.has_value() && answered(index_) && !attempting() && !measuring_;
}

void LessonCourse::attempt() {
  if (!can_attempt()) return;
  attempt_ = std::make_unique<Attempt>();
  attempt_->part = index_;
  if (case_of(index_)) {
    begin();
  } else {
    open_study();
  }
  emit changed();
}

std::size_t LessonCourse::before(std::size_t part) const {
  while (part > 0 && !lesson_.parts[--part].attempt) continue;
  return part;
}

void LessonCourse::begin() {
  attempt_->on = case_of(attempt_->part);
  const LessonCase& on = *attempt_->on;
  const CaseState& state = on.proxy->state();
  const bool untouched = on.after && state.edits == on.edits && state.step == on.step;
  std::size_t part = attempt_->part;
  attempt_->parts.push_back(part);
  while (lesson_.parts[part].attempt->goes_on) {
    part = before(part);
    if (untouched && on.after == part) break;
    attempt_->parts.push_back(part);
  }
  emit case_used(*on.proxy, *lesson_.parts[attempt_->part].attempt);
  try_next();
}

void LessonCourse::try_next() {
  const document::LessonPart& part = lesson_.parts[attempt_->parts.back()];
  CaseProxy& proxy = *attempt_->on->proxy;
  proxy.pause();
  proxy.set_drive({});
  proxy.set_parameters(part.attempt->parameters, CaseProxy::new_gesture());
  if (proxy.state().smoothed_mm == part.attempt->smoothed_mm && !proxy.state().smoothing) return play();
  proxy.smooth_source(part.attempt->smoothed_mm);
  attempt_->waiting = connect(&proxy, &CaseProxy::state_changed, this, &LessonCourse::wait_for_source);
}

void LessonCourse::wait_for_source() {
  const CaseState& state = attempt_->on->proxy->state();
  if (state.smoothing || state.smoothed_mm != lesson_.parts[attempt_->parts.back()].attempt->smoothed_mm)
    return;
  disconnect(attempt_->waiting);
  play();
}

void LessonCourse::play() {
  const document::LessonPart& part = lesson_.parts[attempt_->parts.back()];
  const document::LessonTry& wanted = *part.attempt;
  CaseProxy& proxy = *attempt_->on->proxy;
  attempt_->first_step = wanted.goes_on ? proxy.state().step : 0;
  if (!wanted.goes_on) {
    const LoadedStudy& study = proxy.study();
    const document::Start* own = lesson_.start_of(part);
    const PhantomStart known = study.start.value_or(PhantomStart{});
    proxy.begin(own ? *own : document::suggested_start(study.volume->geometry, known.seed, known.threshold));
  }
  const std::int64_t seen = wanted.until_rest ? std::min(wanted.steps, kLongSteps) : wanted.steps;
  proxy.set_pace(static_cast<double>(seen) / kWatchedSeconds);
  proxy.play_for(wanted.steps, wanted.until_rest,
                 [self = QPointer(this), mine = attempt_.get()](bool reached) {
                   if (self && self->attempt_.get() == mine) self->follow_end(reached);
                 });
}

void LessonCourse::follow_end(bool reached) {
  LessonCase& on = *attempt_->on;
  on.proxy->set_pace(0.0);
  if (!reached) return end_attempt();
  on.after = attempt_->parts.back();
  on.edits = on.proxy->state().edits;
  on.step = on.proxy->state().step;
  tried_[attempt_->parts.back()] = 1;
  attempt_->parts.pop_back();
  if (!attempt_->parts.empty()) return try_next();
  end_attempt();
}

void LessonCourse::end_attempt() {
  if (!attempt_) return;
  disconnect(attempt_->waiting);
  attempt_.reset();
  emit changed();
}

// The case is left at rest, and without the pace of the try.
void LessonCourse::break_off() {
  if (attempt_->on && attempt_->on->proxy) {
    attempt_->on->proxy->pause();
    attempt_->on->proxy->set_pace(0.0);
  }
  end_attempt();
}

void LessonCourse::stop() {
  if (!attempt_) return;
  close_study();
  break_off();
}

double LessonCourse::fraction() const {
  if (!attempt_ || !attempt_->on || attempt_->parts.empty() || !attempt_->on->proxy) return 0.0;
  const auto steps = lesson_.parts[attempt_->parts.back()].attempt->steps;
  if (steps <= 0) return 0.0;
  const std::int64_t done = attempt_->on->proxy->state().step - attempt_->first_step;
  return std::clamp(static_cast<double>(done) / static_cast<double>(steps), 0.0, 1.0);
}

// Figures.

bool LessonCourse::can_measure() const {
  const CaseProxy* on = proxy();
  return on && !part().measures.empty() && on->state().begun && !on->state().playing && tried(index_) &&
         !attempting() && !measuring_;
}

void LessonCourse::measure() {
  if (!can_measure()) return;
  measuring_ = true;
  measured_part_ = index_;
  CaseProxy* on = proxy();
  on->measure([self = QPointer(this), on = QPointer(on)] {
    if (!self || !on || !self->measuring_) return;
    self->meter_.measure(self->lesson_.parts[self->measured_part_].measures, on->state(), on->study().truth);
  });
  emit changed();
}

void LessonCourse::take_figures(const std::vector<std::optional<double>>& figures) {
  measuring_ = false;
  answers_.parts[measured_part_].figures = figures;
  emit changed();
}

bool LessonCourse::done(std::size_t part) const {
  const document::LessonPart& wanted = lesson_.parts[part];
  if (!answered(part) || (wanted.attempt && !tried_[part])) return false;
  return wanted.measures.empty() || !answers_.parts[part].figures.empty();
}

}  // namespace tidemark::engine
