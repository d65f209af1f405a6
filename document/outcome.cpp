#include "document/outcome.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/index_walk.h"
#include "solver/model.h"
#include "solver/voxel_values.h"

namespace tidemark::document {
namespace {

constexpr std::int64_t kRemnant = 8;    // voxels: the grid shows curvature no less, which leaves it there
constexpr double kFilled = 0.99;        // of all voxels: noise leaves islands
constexpr double kLikeTissue = 0.15;    // of the voxels beside a surface that has stopped too early
constexpr double kLeastWidening = 1.5;  // less would change nothing to speak of
constexpr double kBeside = 0.4;  // of the band: 1 of 2.5 voxels; the holes of a ragged surface are not wide

// Calls visit(voxel, phi) for the voxels of those pages whose kind is `wanted`.
template <class Wanted, class Visit>
void visit_pages(const solver::Field& phi, const Wanted& wanted, const Visit& visit) {
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (!wanted(phi.pages.kind(page))) continue;
    const Index3 first = phi.layout.first_voxel(page);
    for_each_index(first, first + phi.layout.valid_shape(page),
                   [&](Index3 voxel) { visit(voxel, phi.at(voxel)); });
  }
}

double speed_at(const EvolvedSurface& surface, Index3 voxel) {
  if (surface.speed == nullptr) return solver::data_speed(surface.parameters, surface.source.value(voxel));
  double speed = 0.0;
  surface.speed->evaluate({voxel, Index3(1)}, &speed);
  return speed;
}

// Whether a voxel inside of what it began with draws the surface outwards.
bool is_attracted(const EvolvedSurface& surface) {
  bool any = false;
  visit_pages(
      *surface.start, [&](solver::Field::Kind kind) { return !any && kind != solver::Field::Kind::outside; },
      [&](Index3 voxel, float phi) { any = any || (phi > 0.0F && speed_at(surface, voxel) > 0.0); });
  return any;
}

// Of a voxel and its neighbours, as many as the volume has.
double mean_around(const Volume& volume, Index3 voxel) {
  const Index3 first = glm::max(voxel - Index3(1), Index3(0));
  const Index3 last = glm::min(voxel + Index3(1), volume.geometry.size - Index3(1));
  double sum = 0.0;
  int count = 0;
  for_each_index(first, last + Index3(1), [&](Index3 at) {
    sum += volume.value(at);
    ++count;
  });
  return sum / count;
}

// For people to read and type: two digits.
double rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::ceil(value / unit) * unit;
}

}  // namespace

std::string_view name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged:
      return "converged";
    case Outcome::vanished:
      return "vanished";
    case Outcome::seeded_outside:
      return "seeded_outside";
    case Outcome::filled_volume:
      return "filled_volume";
    case Outcome::unfinished:
      break;
  }
  return "unfinished";
}

bool has_surface(Outcome outcome) {
  return outcome == Outcome::unfinished || outcome == Outcome::converged;
}

Outcome outcome_of(const EvolvedSurface& surface) {
  if (surface.steps == 0) return Outcome::unfinished;
  if (surface.voxels_inside == 0 || (surface.stopped && surface.voxels_inside < kRemnant)) {
    const bool follows_data = surface.parameters.data_term && surface.parameters.alpha > 0.0;
    const bool is_outside = follows_data && surface.start != nullptr && !is_attracted(surface);
    return is_outside ? Outcome::seeded_outside : Outcome::vanished;
  }
  const auto voxels = static_cast<double>(surface.phi.geometry.voxel_count());
  if (static_cast<double>(surface.voxels_inside) >= kFilled * voxels) return Outcome::filled_volume;
  return surface.stopped ? Outcome::converged : Outcome::unfinished;
}

std::optional<double> wider_range(const EvolvedSurface& surface) {
  const solver::Parameters& parameters = surface.parameters;
  if (surface.speed != nullptr || outcome_of(surface) != Outcome::converged || !parameters.data_term) {
    return std::nullopt;
  }
  const double band = std::min(surface.phi.band, solver::default_band(surface.phi.geometry));
  std::int64_t beside = 0;
  std::int64_t alike = 0;
  double squares = 0.0;
  const auto look_at = [&](Index3 voxel, float phi) {
    if (phi <= -band || phi > -kBeside * band) return;
    if (surface.constraints != nullptr && is_upper(surface.constraints->at(voxel))) return;
    ++beside;
    if (std::abs(mean_around(surface.source, voxel) - parameters.target) >= parameters.range) return;
    ++alike;
    const double difference = surface.source.value(voxel) - parameters.target;
    squares += difference * difference;
  };
  visit_pages(
      surface.phi, [](solver::Field::Kind kind) { return kind == solver::Field::Kind::stored; }, look_at);
  if (static_cast<double>(alike) <= kLikeTissue * static_cast<double>(beside)) return std::nullopt;
  const double spread = std::sqrt(squares / static_cast<double>(alike));
  return rounded(std::max(2.0 * spread, kLeastWidening * parameters.range));
}

}  // namespace tidemark::document
