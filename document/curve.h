// The development of the surface since the start: volume, area and motion by step.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace tidemark::document {

struct CurvePoint {
  std::int64_t step = 0;
  double volume_ml = 0.0;
  double surface_mm2 = 0.0;
  double surface_speed = 0.0;  // AdvanceReport::surface_speed, smallest spacings a unit of time
  std::optional<double> dice = std::nullopt;  // against a known answer

  bool operator==(const CurvePoint&) const = default;
};

// A new point, which is seldom, makes a new list of points, so that a viewer can keep the one that it has.
class Curve {
 public:
  using Points = std::vector<CurvePoint>;
  static constexpr std::size_t kMostPoints = 2000;

  Curve() = default;
  // By growing step.
  explicit Curve(Points points) : points_(std::make_shared<const Points>(std::move(points))) {}

  [[nodiscard]] const std::shared_ptr<const Points>& points() const { return points_; }

  // Adds a point behind the last one, or nothing if no step was made. A long curve is thinned.
  void add(const CurvePoint& point);
  // Dice values are about the answer of that number: those about another one are forgotten.
  void compare_with(std::uint64_t answer);
  // Removes the points from this step on.
  void cut(std::int64_t step);

 private:
  std::shared_ptr<const Points> points_ = std::make_shared<const Points>();
  std::uint64_t answer_ = 0;
};

}  // namespace tidemark::document
