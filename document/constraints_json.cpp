#include "document/constraints_json.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/index_walk.h"
#include "core/number_in.h"
#include "document/packed_bytes.h"

namespace tidemark::document {
namespace {

using solver::Constraint;
using solver::Constraints;

constexpr std::size_t kAnyLength = std::numeric_limits<std::size_t>::max();

// What voxels may have become, and how a file calls it.
struct Becomes {
  Constraint what;
  const char* name;
};
constexpr std::array<Becomes, 3> kBecomes{
    {{Constraint::wall, "walls"}, {Constraint::anchor, "anchors"}, {Constraint::none, "free"}}};

std::int64_t voxels_in(Index3 size) {
  return size.x * size.y * size.z;
}

// A list takes eight bytes a voxel before it is packed, and a bit for each voxel of the grid is always
// enough.
std::size_t longest_list(Index3 size) {
  return static_cast<std::size_t>(voxels_in(size)) / 64;
}

// Numbers of voxels, x fastest, that have become this or that; in ascending order.
using Changes = std::array<std::vector<std::int64_t>, kBecomes.size()>;

Changes changes_between(const Constraints& before, const Constraints& constraints) {
  Changes changes;
  const PageLayout& layout = constraints.layout();
  const Index3 size = layout.domain_size();
  Constraints::Pages::for_each_difference(before.pages(), constraints.pages(), [&](std::int64_t page) {
    const Index3 first = layout.first_voxel(page);
    for_each_index(first, first + layout.valid_shape(page), [&](Index3 voxel) {
      const Constraint now = constraints.at(voxel);
      if (now == before.at(voxel)) return;
      const auto is_it = [now](const Becomes& kind) { return kind.what == now; };
      const auto kind = std::find_if(kBecomes.begin(), kBecomes.end(), is_it) - kBecomes.begin();
      changes[static_cast<std::size_t>(kind)].push_back(number_in(size, voxel));
    });
  });
  for (auto& voxels : changes) std::sort(voxels.begin(), voxels.end());
  return changes;
}

// Each number but the first as its distance from the one before: what lies side by side packs to nearly
// nothing.
Json packed_list(const std::vector<std::int64_t>& voxels) {
  std::vector<std::int64_t> steps = voxels;
  for (std::size_t i = steps.size() - 1; i > 0; --i) steps[i] -= steps[i - 1];
  return {{"count", steps.size()}, {"steps", pack_bytes(std::as_bytes(std::span(steps)))}};
}

// Sets the voxels of a list, some at a time, so that the list is in memory once.
void read_list(const JsonField& field, Index3 size, Constraint what, Constraints& constraints) {
  const auto count = static_cast<std::size_t>(field.at("count").integer(1, voxels_in(size)));
  const std::string packed = field.at("steps").text(kAnyLength);
  if (!field.good()) return;
  const auto bytes = unpack_bytes(packed, count * sizeof(std::int64_t));
  if (!bytes) return field.at("steps").wrong("does not hold as many numbers as it should");
  constexpr std::size_t kAtOnce = 4096;
  std::vector<Index3> voxels;
  std::int64_t voxel = -1;
  for (std::size_t i = 0; i < count; ++i) {
    std::int64_t step = 0;
    std::memcpy(&step, bytes->data() + i * sizeof step, sizeof step);
    if (i == 0 && step >= 0) ++step;
    if (step < 1 || step > voxels_in(size) - 1 - voxel) {
      return field.at("steps").wrong("are not voxels of the volume, each once, in their order");
    }
    voxel += step;
    voxels.emplace_back(voxel % size.x, voxel / size.x % size.y, voxel / (size.x * size.y));
    if (voxels.size() < kAtOnce && i + 1 < count) continue;
    constraints.set(voxels, what);
    voxels.clear();
  }
}

Json packed_mask(const Constraints& constraints, Constraint what) {
  const PageLayout& layout = constraints.layout();
  Geometry grid;
  grid.size = layout.domain_size();
  BitMask mask(grid);
  for (const std::int64_t page : constraints.pages().stored_pages()) {
    const Index3 first = layout.first_voxel(page);
    for_each_index(first, first + layout.valid_shape(page), [&](Index3 voxel) {
      if (constraints.at(voxel) == what) mask.add(grid.offset(voxel));
    });
  }
  return pack_bytes(mask.bits());
}

std::optional<BitMask> read_mask(const JsonField& field, const Geometry& grid) {
  const std::string packed = field.text(kAnyLength);
  if (!field.good()) return std::nullopt;
  auto mask = unpack_mask(packed, grid);
  if (!mask) field.wrong("does not hold the volume's voxels");
  return mask;
}

std::shared_ptr<const Constraints> read_all(const JsonField& drive, Index3 size) {
  Geometry grid;
  grid.size = size;
  const auto walls = read_mask(drive.at("walls"), grid);
  const auto anchors = read_mask(drive.at("anchors"), grid);
  if (!walls || !anchors) return nullptr;
  auto constraints = std::make_shared<Constraints>(size);
  constraints->set(*walls, Constraint::wall);
  constraints->set(*anchors, Constraint::anchor);
  return constraints;
}

std::shared_ptr<const Constraints> read_changes(const JsonField& field, Index3 size,
                                                const std::shared_ptr<const Constraints>& before) {
  std::shared_ptr<Constraints> changed;
  for (const Becomes& kind : kBecomes) {
    if (!field.has(kind.name)) continue;
    if (!changed)
      changed = before ? std::make_shared<Constraints>(*before) : std::make_shared<Constraints>(size);
    read_list(field.at(kind.name), size, kind.what, *changed);
  }
  if (!field.good()) return nullptr;
  return changed ? changed : before;
}

}  // namespace

void add_constraints(Json& drive, const Constraints* constraints, const Constraints* before) {
  if (constraints == nullptr || constraints->empty()) return;
  const Index3 size = constraints->layout().domain_size();
  const Changes changes = changes_between(before != nullptr ? *before : Constraints(size), *constraints);
  std::size_t count = 0;
  for (const auto& voxels : changes) count += voxels.size();
  if (count > longest_list(size)) {
    drive["walls"] = packed_mask(*constraints, Constraint::wall);
    drive["anchors"] = packed_mask(*constraints, Constraint::anchor);
    return;
  }
  Json& lists = drive["constraints"] = Json::object();
  for (std::size_t i = 0; i < kBecomes.size(); ++i) {
    if (!changes[i].empty()) lists[kBecomes[i].name] = packed_list(changes[i]);
  }
}

std::shared_ptr<const Constraints> read_constraints(const JsonField& drive, Index3 grid_size,
                                                    const std::shared_ptr<const Constraints>& before) {
  if (drive.has("walls")) return read_all(drive, grid_size);
  if (drive.has("constraints")) return read_changes(drive.at("constraints"), grid_size, before);
  return nullptr;
}

}  // namespace tidemark::document
