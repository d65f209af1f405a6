#include "response.h"

#include <fmt/format.h>

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QTimer>
#include <array>

#include "core/stopwatch.h"
#include "engine/case_proxy.h"
#include "engine/picture_feed.h"
#include "solver/speed/cached_speed.h"
#include "solver/speed/examples/examples_speed.h"
#include "strokes_on.h"

namespace tidemark {
namespace {

constexpr double kLongestWait = 120.0;  // seconds
constexpr renderer::PictureSize kViewSize{600, 600};
constexpr int kStrokes = 5;  // measured one after the other

// The longest time in which the thread's events had to wait, by a timer of 1 ms.
class Heartbeat {
 public:
  Heartbeat() {
    QObject::connect(&timer_, &QTimer::timeout, [this] { beat(); });
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.start(1);
    since_.start();
  }
  void begin() {
    since_.restart();
    longest_ms_ = 0.0;
  }
  [[nodiscard]] double longest_ms() {
    beat();
    return longest_ms_;
  }

 private:
  void beat() {
    longest_ms_ = std::max(longest_ms_, 1e-6 * static_cast<double>(since_.nsecsElapsed()));
    since_.restart();
  }

  QTimer timer_;
  QElapsedTimer since_;
  double longest_ms_ = 0.0;
};

// Of one stroke, in seconds after it.
struct Answer {
  double forest = 0.0;
  double maps = 0.0;
  double motion = 0.0;
  double longest_block_ms = 0.0;
};

// A case with three views of its speed map, as a window has it.
class Desktop {
 public:
  Desktop(engine::Engine& engine, Study study, int images)
      : engine_(engine), study_(std::move(study)), proxy_(engine, study_, solver::ExecutorKind::host) {
    QObject::connect(&proxy_, &engine::CaseProxy::failed,
                     [this](const QString& why) { failure_ = why.toStdString(); });
    proxy_.set_pause_at_convergence(false);
    drive_.setting.terms = {{"examples", {}}};
    for (int image = 0; image < images; ++image) {
      auto further = std::make_shared<document::CaseImage>();
      further->name = fmt::format("image {}", image + 1);
      further->volume = std::make_shared<const Volume>(*study_->volume);
      drive_.images.push_back(std::move(further));
    }
  }

  Status open() {
    const Geometry& geometry = study_->volume->geometry;
    const glm::dvec3 middle = geometry.to_patient(glm::dvec3(start_of(*study_)));
    std::size_t view_number = 0;
    for (auto& feed : feeds_) {
      feed = std::make_unique<engine::PictureFeed>(proxy_);
      renderer::SliceView view;
      view.orientation = std::array{renderer::kAxial, renderer::kCoronal, renderer::kSagittal}[view_number++];
      view.position_mm = middle;
      view.content = renderer::SliceContent::speed;
      feed->request(view, kViewSize);
    }
    document::Start start;
    start.seeds.push_back(solver::sphere_at_voxel(
        geometry, glm::dvec3(start_of(*study_)),
        4.0 * std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z})));
    proxy_.begin(start);
    proxy_.play();
    return wait_until([&] { return maps_are_newer(); });
  }

  Result<Answer> stroke(int number) {
    drive_.strokes = strokes_on(*study_, number);
    const auto former = proxy_.state().speed;
    heartbeat_.begin();
    const Stopwatch watch;
    Answer answer;
    proxy_.set_drive(drive_);
    TIDEMARK_TRY(wait_until([&] {
      return proxy_.state().speed && proxy_.state().speed != former && !proxy_.state().speed_waits;
    }));
    answer.forest = watch.seconds();
    const std::int64_t step = proxy_.state().step;
    note_pictures();
    TIDEMARK_TRY(wait_until([&] {
      if (answer.motion == 0.0 && proxy_.state().step > step) answer.motion = watch.seconds();
      if (answer.maps == 0.0 && maps_are_newer()) answer.maps = watch.seconds();
      return answer.motion > 0.0 && answer.maps > 0.0;
    }));
    answer.longest_block_ms = heartbeat_.longest_ms();
    return answer;
  }

  [[nodiscard]] std::shared_ptr<const solver::SpeedFunction> speed() const { return proxy_.state().speed; }

 private:
  template <class Condition>
  Status wait_until(const Condition& condition) {
    const Stopwatch watch;
    while (!condition()) {
      if (!failure_.empty()) return fail(ErrorKind::internal, "{}", failure_);
      if (watch.seconds() > kLongestWait) return fail(ErrorKind::internal, "nothing happened for too long");
      QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    }
    return {};
  }
  void note_pictures() {
    for (std::size_t i = 0; i < feeds_.size(); ++i) seen_[i] = feeds_[i]->shown().number;
  }
  [[nodiscard]] bool maps_are_newer() const {
    for (std::size_t i = 0; i < feeds_.size(); ++i) {
      if (feeds_[i]->shown().number <= seen_[i]) return false;
    }
    return true;
  }

  engine::Engine& engine_;
  Study study_;
  engine::CaseProxy proxy_;
  std::array<std::unique_ptr<engine::PictureFeed>, 3> feeds_;
  std::array<std::uint64_t, 3> seen_{};
  document::Drive drive_;
  Heartbeat heartbeat_;
  std::string failure_;
};

void print(const char* what, const Answer& answer) {
  fmt::print("  {:24} forest {:6.3f} s   maps {:6.3f} s   motion {:6.3f} s   longest block {:4.0f} ms\n",
             what, answer.forest, answer.maps, answer.motion, answer.longest_block_ms);
}

}  // namespace

Status measure_response(engine::Engine& engine, const Study& study, int images) {
  const Index3 size = study->volume->geometry.size;
  fmt::print("{} x {} x {}, {} images: from a stroke to forest, three speed maps, first step by it\n", size.x,
             size.y, size.z, 1 + images);
  Desktop desktop(engine, study, images);
  TIDEMARK_TRY(desktop.open());
  auto first = desktop.stroke(0);
  if (!first) return pass_on(first);
  print("first", *first);
  Answer longest;
  for (int number = 1; number <= kStrokes; ++number) {
    auto next = desktop.stroke(number);
    if (!next) return pass_on(next);
    longest.forest = std::max(longest.forest, next->forest);
    longest.maps = std::max(longest.maps, next->maps);
    longest.motion = std::max(longest.motion, next->motion);
    longest.longest_block_ms = std::max(longest.longest_block_ms, next->longest_block_ms);
  }
  print("longest of the next five", longest);
  const auto* cached = dynamic_cast<const solver::CachedSpeed*>(desktop.speed().get());
  const auto* examples =
      cached == nullptr ? nullptr : dynamic_cast<const solver::ExamplesSpeed*>(&cached->function());
  if (examples == nullptr) return fail(ErrorKind::internal, "the function is not one of examples");
  fmt::print("  memory: features {} MB, D {} MB\n", examples->features().memory() / 1'000'000,
             cached->memory() / 1'000'000);
  return {};
}

}  // namespace tidemark
