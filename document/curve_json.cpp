#include "document/curve_json.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tidemark::document {
namespace {

// A list a quantity, so that other programs can plot them.
constexpr std::array<std::pair<const char*, double CurvePoint::*>, 3> kCurveQuantities{
    {{"volume_ml", &CurvePoint::volume_ml},
     {"surface_mm2", &CurvePoint::surface_mm2},
     {"surface_speed", &CurvePoint::surface_speed}}};
constexpr const char* kDice = "dice";  // where any point has it
constexpr double kNoDice = -1.0;       // of a point that has none

}  // namespace

Json curve_json(const Curve::Points& points) {
  Json json{{"step", Json::array()}};
  for (const CurvePoint& point : points) json["step"].push_back(point.step);
  for (const auto& [name, quantity] : kCurveQuantities) {
    Json& list = json[name] = Json::array();
    for (const CurvePoint& point : points) list.push_back(point.*quantity);
  }
  const bool compared = std::any_of(points.begin(), points.end(),
                                    [](const CurvePoint& point) { return point.dice.has_value(); });
  if (!compared) return json;
  Json& list = json[kDice] = Json::array();
  for (const CurvePoint& point : points) list.push_back(point.dice.value_or(kNoDice));
  return json;
}

Curve read_curve(const JsonField& field) {
  const JsonField steps = field.at("step");
  Curve::Points points(steps.size(Curve::kMostPoints));
  std::int64_t next = 0;
  for (std::size_t i = 0; i < points.size() && field.good(); ++i) {
    points[i].step = steps.at(i).integer(next, std::int64_t{1} << 62);
    next = points[i].step + 1;
  }
  for (const auto& [name, quantity] : kCurveQuantities) {
    const JsonField list = field.at(name);
    if (list.size(Curve::kMostPoints) != points.size())
      list.wrong("has not as many entries as there are steps");
    for (std::size_t i = 0; i < points.size() && field.good(); ++i)
      points[i].*quantity = list.at(i).number(0.0);
  }
  if (field.has(kDice)) {
    const JsonField list = field.at(kDice);
    if (list.size(Curve::kMostPoints) != points.size())
      list.wrong("has not as many entries as there are steps");
    for (std::size_t i = 0; i < points.size() && field.good(); ++i) {
      const double dice = list.at(i).number(kNoDice, 1.0);
      if (dice >= 0.0) points[i].dice = dice;
    }
  }
  return Curve(std::move(points));
}

}  // namespace tidemark::document
