#include "document/prediction.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>

#include "solver/speed/tent_speed.h"

namespace tidemark::document {
namespace {

constexpr double kShape = 0.6;        // largest spacings that a ball's surface may be uneven by
constexpr double kLeastRadius = 2.0;  // largest spacings: the grid shows no smaller ball
constexpr double kShell = 1.0;        // largest spacings: how thick the shells are in which D is looked at

// What drives and holds the surface in a shell around a ball.
struct Shell {
  std::int64_t voxels = 0;
  double mean = 0.0;    // of D
  double spread = 0.0;  // root mean square of D's distance from `around`
  bool held = false;    // by a constraint
};

class Surroundings {
 public:
  Surroundings(const solver::StepInputs& inputs, const solver::Ball& ball)
      : inputs_(inputs),
        grid_(inputs.source->geometry),
        tent_(inputs.source, inputs.parameters),
        ball_(ball),
        // Without the data term nothing asks for D.
        asks_(inputs.parameters.data_term && inputs.parameters.alpha > 0.0) {}

  // Of the voxels whose distance from the ball's middle is in [from_mm, to_mm).
  Result<Shell> shell(double from_mm, double to_mm, double around, const Progress& progress) {
    Shell shell;
    double sum = 0.0;
    double squares = 0.0;
    const Index3 low = clamped(glm::ceil(ball_.centre - to_mm / grid_.spacing_mm));
    const Index3 high = clamped(glm::floor(ball_.centre + to_mm / grid_.spacing_mm));
    for (std::int64_t z = low.z; z <= high.z; ++z) {
      if (progress.cancelled()) return cancelled_error();
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        visit_row(y, z, from_mm, to_mm, [&](Index3 first, std::int64_t count) {
          look(first, count);
          for (std::int64_t i = 0; i < count; ++i) {
            const double d = speeds_[static_cast<std::size_t>(i)];
            sum += d;
            squares += (d - around) * (d - around);
            const auto& constraints = inputs_.constraints;
            shell.held = shell.held || (constraints &&
                                        constraints->at(first + Index3(i, 0, 0)) != solver::Constraint::none);
          }
          shell.voxels += count;
        });
      }
    }
    if (shell.voxels == 0) return shell;
    shell.mean = sum / static_cast<double>(shell.voxels);
    shell.spread = std::sqrt(squares / static_cast<double>(shell.voxels));
    return shell;
  }

  // Whether nothing drives or holds the surface but its curvature.
  [[nodiscard]] bool are_empty() const { return !asks_ && !inputs_.constraints; }

  // From the ball's middle to the nearest side of the volume: the outermost voxels' centres.
  [[nodiscard]] double to_border_mm() const {
    const glm::dvec3 low = ball_.centre * grid_.spacing_mm;
    const glm::dvec3 high = (glm::dvec3(grid_.size - Index3(1)) - ball_.centre) * grid_.spacing_mm;
    return std::min(glm::compMin(low), glm::compMin(high));
  }

 private:
  [[nodiscard]] Index3 clamped(glm::dvec3 voxel) const {
    return glm::clamp(Index3(voxel), Index3(0), grid_.size - Index3(1));
  }

  // Calls visit(first voxel, count) for the one or two pieces of a row that lie in the shell.
  template <class Visit>
  void visit_row(std::int64_t y, std::int64_t z, double from_mm, double to_mm, const Visit& visit) const {
    const double beside = (static_cast<double>(y) - ball_.centre.y) * grid_.spacing_mm.y;
    const double above = (static_cast<double>(z) - ball_.centre.z) * grid_.spacing_mm.z;
    const double squared = beside * beside + above * above;
    if (squared >= to_mm * to_mm) return;
    const double reach = std::sqrt(to_mm * to_mm - squared) / grid_.spacing_mm.x;
    const std::int64_t low = clamped(glm::dvec3(std::ceil(ball_.centre.x - reach))).x;
    const std::int64_t high = clamped(glm::dvec3(std::floor(ball_.centre.x + reach))).x;
    std::int64_t first = -1;
    for (std::int64_t x = low; x <= high + 1; ++x) {
      const double along = (static_cast<double>(x) - ball_.centre.x) * grid_.spacing_mm.x;
      const double distance = squared + along * along;
      const bool is_in = x <= high && distance >= from_mm * from_mm && distance < to_mm * to_mm;
      if (is_in && first < 0) first = x;
      if (is_in || first < 0) continue;
      visit(Index3(first, y, z), x - first);
      first = -1;
    }
  }

  void look(Index3 first, std::int64_t count) {
    speeds_.assign(static_cast<std::size_t>(count), 0.0);
    if (!asks_) return;
    const solver::SpeedFunction& speed = inputs_.speed ? *inputs_.speed : tent_;
    speed.evaluate({first, Index3(count, 1, 1)}, speeds_.data());
  }

  const solver::StepInputs& inputs_;
  const Geometry& grid_;
  solver::TentSpeed tent_;
  const solver::Ball& ball_;
  bool asks_;
  std::vector<double> speeds_;
};

// How far the ball may come.
struct Room {
  double inner_mm = 0.0;
  double outer_mm = 0.0;
  Prediction::End outside = Prediction::End::border;
};

// Looks shell by shell the way that the ball goes.
Result<Room> room_for(Surroundings& surroundings, double radius_mm, bool grows, double speed, double shell_mm,
                      const Progress& progress) {
  Room room{0.0, surroundings.to_border_mm(), Prediction::End::border};
  if (surroundings.are_empty()) return room;
  for (double at = radius_mm; grows ? at < room.outer_mm : at > 0.0; at += grows ? shell_mm : -shell_mm) {
    const double from = grows ? at : std::max(at - shell_mm, 0.0);
    auto shell = surroundings.shell(from, from + shell_mm, speed, progress);
    if (!shell) return pass_on(shell);
    if (shell->voxels == 0 || (shell->spread <= kEvenSpeed && !shell->held)) continue;
    if (grows) return Room{0.0, at, Prediction::End::tissue};
    return Room{at, room.outer_mm, Prediction::End::border};
  }
  return room;
}

// As far as there is room.
void follow(Prediction& prediction, const Room& room, double radius_mm, std::int64_t step, double time_step) {
  const auto add = [&](std::int64_t after, double radius) {
    prediction.points.push_back({step + after, radius});
  };
  // The steps until it ends, first: a long way has its points farther apart.
  double radius = radius_mm;
  std::int64_t steps = 0;
  const auto ends = [&](double at) {
    if (at <= 0.0)
      prediction.end = Prediction::End::vanishes;
    else if (at >= room.outer_mm)
      prediction.end = room.outside;
    else if (at <= room.inner_mm)
      prediction.end = Prediction::End::tissue;
    else
      return false;
    return true;
  };
  add(0, radius);
  while (steps < Prediction::kFarthest) {
    radius = prediction.law.radius_after(radius, time_step);
    ++steps;
    const bool is_last = ends(radius);
    add(steps, std::clamp(radius, room.inner_mm, std::max(room.outer_mm, room.inner_mm)));
    if (is_last) break;
  }
  const std::size_t stride = (prediction.points.size() - 1) / Prediction::kMostPoints + 1;
  std::vector<PredictedPoint> kept;
  for (std::size_t i = 0; i + 1 < prediction.points.size(); i += stride) kept.push_back(prediction.points[i]);
  kept.push_back(prediction.points.back());
  prediction.points = std::move(kept);
}

}  // namespace

std::optional<double> Prediction::radius_at(std::int64_t step) const {
  if (points.empty() || step < points.front().step || step > points.back().step) return std::nullopt;
  const auto after =
      std::lower_bound(points.begin(), points.end(), step,
                       [](const PredictedPoint& point, std::int64_t at) { return point.step < at; });
  if (after->step == step) return after->radius_mm;
  const PredictedPoint& before = *(after - 1);
  const double share =
      static_cast<double>(step - before.step) / static_cast<double>(after->step - before.step);
  return glm::mix(before.radius_mm, after->radius_mm, share);
}

Result<Prediction> predict(const solver::StepInputs& inputs, std::int64_t step, const Progress& progress) {
  Prediction prediction;
  const glm::dvec3& spacing = inputs.phi->geometry.spacing_mm;
  const double smallest = glm::compMin(spacing);
  const double largest = glm::compMax(spacing);
  const auto without = [&](Prediction::Obstacle why) {
    prediction.obstacle = why;
    return prediction;
  };
  auto ball = solver::ball_of(*inputs.phi, kShape * largest, progress);
  if (!ball) return pass_on(ball);
  if (!*ball || (*ball)->radius_mm < kLeastRadius * largest) return without(Prediction::Obstacle::shape);
  const double radius_mm = (*ball)->radius_mm;
  const bool asks = inputs.parameters.data_term && inputs.parameters.alpha > 0.0;
  if (inputs.speed && (inputs.speed->advects() || (asks && inputs.speed->follows_surface())))
    return without(Prediction::Obstacle::follows);

  Surroundings surroundings(inputs, **ball);
  const double shell_mm = kShell * largest;
  auto around = surroundings.shell(std::max(radius_mm - shell_mm, 0.0), radius_mm + shell_mm, 0.0, progress);
  if (!around) return pass_on(around);
  // The spread around 0 is known; that around the mean follows.
  const double variance = around->spread * around->spread - around->mean * around->mean;
  if (variance > kEvenSpeed * kEvenSpeed) return without(Prediction::Obstacle::speed);
  if (around->held) return without(Prediction::Obstacle::held);
  prediction.data_speed = around->mean;
  prediction.law = solver::ball_law(inputs.parameters, around->mean, smallest);
  const bool grows = prediction.law.speed_at(radius_mm) > 0.0;
  auto room = room_for(surroundings, radius_mm, grows, around->mean, shell_mm, progress);
  if (!room) return pass_on(room);
  follow(prediction, *room, radius_mm, step, inputs.time_step);
  return prediction;
}

}  // namespace tidemark::document
