// A small volume in which a level set has something to do, and common questions of tests to it.
#pragma once

#include <QTest>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "document/case.h"
#include "tests/support/executor_rows.h"
#include "tests/support/support.h"

namespace tidemark::test {

// A lumpy ball: bright in the middle, with waves.
inline std::shared_ptr<const Volume> lumpy_volume(Index3 size = {37, 34, 29},
                                                  glm::dvec3 spacing = {1, 1, 1.3}) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = size;
  volume->geometry.spacing_mm = spacing;
  volume->geometry.origin_mm = {-12.0, 4.0, 30.5};
  const glm::dvec3 centre = volume->geometry.to_patient(0.5 * glm::dvec3(size - Index3(1)));
  std::vector<std::int16_t> voxels;
  for (std::int64_t z = 0; z < size.z; ++z) {
    for (std::int64_t y = 0; y < size.y; ++y) {
      for (std::int64_t x = 0; x < size.x; ++x) {
        const glm::dvec3 q = volume->geometry.to_patient({x, y, z}) - centre;
        const double value = 1000.0 - 25.0 * glm::length(q) +
                             150.0 * std::sin(q.x / 3.0) * std::sin(q.y / 4.0 + 1.0) * std::cos(q.z / 5.0);
        voxels.push_back(static_cast<std::int16_t>(std::lround(value)));
      }
    }
  }
  volume->voxels = std::move(voxels);
  return volume;
}

inline solver::Parameters lumpy_parameters() {
  solver::Parameters parameters;
  parameters.target = 850.0;
  parameters.range = 250.0;
  parameters.alpha = 0.7;
  return parameters;
}

// A ball of so many mm, that far from the volume's middle.
inline solver::Sphere ball_at(const Volume& volume, glm::dvec3 off_centre, double radius_mm) {
  const Geometry& geometry = volume.geometry;
  return {geometry.to_patient(0.5 * glm::dvec3(geometry.size - Index3(1))) + off_centre, radius_mm};
}

inline document::Start seed_in(const Volume& volume) {
  document::Start start;
  start.seeds = {ball_at(volume, {1.3, -0.7, 0.4}, 5.0)};
  return start;
}

inline std::unique_ptr<document::Case> make_case(std::shared_ptr<const Volume> volume,
                                                 solver::ExecutorKind kind = solver::ExecutorKind::host,
                                                 solver::ExecutorOptions options = {}) {
  if (options.threads == 0) options.threads = 1;
  auto made = document::Case::create(std::move(volume), {}, lumpy_parameters(), kind, options);
  if (!made) qFatal("%s", made.error().message.c_str());
  return std::move(*made);
}

// One that has begun.
inline std::unique_ptr<document::Case> begun_case(solver::ExecutorKind kind = solver::ExecutorKind::host,
                                                  const solver::ExecutorOptions& options = {}) {
  auto made = make_case(lumpy_volume(), kind, options);
  if (const Status begun = made->level_set().begin(seed_in(*made->volume())); !begun) {
    qFatal("%s", begun.error().message.c_str());
  }
  return made;
}

// The case's drive, with a ball as its only wall, that far from the volume's middle.
inline document::Drive with_wall(const document::Case& document, glm::dvec3 off_mm, double radius_mm) {
  const Volume& volume = *document.volume();
  auto walls = std::make_shared<solver::Constraints>(volume.geometry.size);
  walls->set(volume.geometry, ball_at(volume, off_mm, radius_mm), solver::Constraint::wall);
  document::Drive drive = document.level_set().drive();
  drive.constraints = std::move(walls);
  return drive;
}

inline std::vector<float> values_of(const document::LevelSet& level_set) {
  return level_set.executor().snapshot().value().dense();
}

inline void run(document::LevelSet& level_set, std::int64_t steps) {
  const auto report = level_set.advance({.steps = steps});
  if (!report) qFatal("%s", report.error().message.c_str());
  QCOMPARE(report->steps, steps);
}

// A level set's values, for comparisons.
struct Seen {
  std::vector<float> phi;
  solver::Parameters parameters;
  std::int64_t step = 0;
  std::size_t events = 0;
  bool begun = false;
  double smoothed_mm = 0.0;

  explicit Seen(const document::LevelSet& level_set)
      : phi(values_of(level_set)),
        parameters(level_set.parameters()),
        step(level_set.step()),
        events(level_set.recipe().events.size()),
        begun(level_set.begun()),
        smoothed_mm(level_set.smoothed_mm()) {}
  bool operator==(const Seen&) const = default;
};

// What undo would take back; empty: nothing.
inline std::string undo_text(document::Case& document) {
  const auto description = document.history().undo_description();
  return description ? document::describe(*description) : std::string();
}

inline solver::Parameters with_target(solver::Parameters parameters, double target) {
  parameters.target = target;
  return parameters;
}

}  // namespace tidemark::test
