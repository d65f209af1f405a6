#include "document/curve.h"

#include <algorithm>

namespace tidemark::document {
namespace {

// Every other point, the newest included.
void thin(Curve::Points& points) {
  std::size_t kept = 0;
  for (std::size_t index = points.size() % 2 == 0 ? 1 : 0; index < points.size(); index += 2) {
    points[kept++] = points[index];
  }
  points.resize(kept);
}

}  // namespace

void Curve::add(const CurvePoint& point) {
  if (!points_->empty() && points_->back().step >= point.step) return;
  auto longer = std::make_shared<Points>(*points_);
  longer->push_back(point);
  if (longer->size() > kMostPoints) thin(*longer);
  points_ = std::move(longer);
}

void Curve::compare_with(std::uint64_t answer) {
  if (answer_ == answer) return;
  Points points = *points_;
  for (CurvePoint& point : points) point.dice.reset();
  points_ = std::make_shared<const Points>(std::move(points));
  answer_ = answer;
}

void Curve::cut(std::int64_t step) {
  if (points_->empty() || points_->back().step < step) return;
  const auto end = std::find_if(points_->begin(), points_->end(),
                                [=](const CurvePoint& point) { return point.step >= step; });
  points_ = std::make_shared<const Points>(points_->begin(), end);
}

}  // namespace tidemark::document
