// The development of the surface since the start: volume, area and motion by step.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace tidemark {

struct CurvePoint {
  std::int64_t step = 0;
  double volume_ml = 0.0;
  double surface_mm2 = 0.0;
  double surface_speed = 0.0;  // root mean square, smallest spacings per unit of time (kConvergedSpeed)

  bool operator==(const CurvePoint&) const = default;
};

// Its points are made anew when one is added, which is seldom, so that whoever shows them can keep them.
class Curve {
 public:
  using Points = std::vector<CurvePoint>;
  static constexpr std::size_t kMostPoints = 2000;

  Curve() = default;
  // By growing step.
  explicit Curve(Points points) : points_(std::make_shared<const Points>(std::move(points))) {}

  [[nodiscard]] const std::shared_ptr<const Points>& points() const { return points_; }

  // A point behind the last one; nothing where the surface has not gone on. A long curve is thinned.
  void add(const CurvePoint& point);
  // Takes away the points from this step on.
  void cut(std::int64_t step);

 private:
  std::shared_ptr<const Points> points_ = std::make_shared<const Points>();
};

}  // namespace tidemark
