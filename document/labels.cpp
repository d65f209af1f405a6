#include "document/labels.h"

#include <algorithm>
#include <utility>

#include "core/label_colour.h"

namespace tidemark::document {
namespace {

// Null: there is none of that id.
const Label* label_in(const std::vector<Label>& list, std::uint8_t id) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const Label& label) { return label.id == id; });
  return found == list.end() ? nullptr : &*found;
}

Result<Label> new_label(const std::vector<Label>& list, std::string name) {
  for (int id = 1; id <= 255; ++id) {
    Label label;
    label.id = static_cast<std::uint8_t>(id);
    if (label_in(list, label.id) != nullptr) continue;
    label.name = std::move(name);
    label.colour = label_colour(label.id);
    return label;
  }
  return fail(ErrorKind::usage, "there are 255 labels already");
}

}  // namespace

// A run of voxels along i that had one label and have another one now.
struct Labels::Run {
  std::int64_t begin = 0;
  std::int64_t length = 0;
  std::uint8_t before = 0;
  std::uint8_t after = 0;
};

class LabelsChange : public Change {
 public:
  LabelsChange(Labels& labels, std::vector<Label> list_after, std::vector<Labels::Run> runs)
      : labels_(labels),
        list_before_(labels.list_),
        list_after_(std::move(list_after)),
        runs_(std::move(runs)) {}

  // The last run that was put is the first that is taken back.
  Status undo() override {
    restore(list_before_, runs_.rbegin(), runs_.rend(), &Labels::Run::before);
    return {};
  }
  Status redo() override {
    restore(list_after_, runs_.begin(), runs_.end(), &Labels::Run::after);
    return {};
  }
  [[nodiscard]] std::int64_t bytes() const override {
    return static_cast<std::int64_t>(sizeof(*this) + runs_.size() * sizeof(Labels::Run) +
                                     (list_before_.size() + list_after_.size()) * sizeof(Label));
  }

 private:
  template <class Iterator>
  void restore(std::vector<Label> list, Iterator begin, Iterator end, std::uint8_t Labels::Run::*side) {
    PagedBytes voxels = labels_.voxels_;
    for (auto run = begin; run != end; ++run)
      voxels.fill(labels_.geometry_.voxel_at(run->begin), {run->length, 1, 1}, *run.*side);
    voxels.join_even_pages(labels_.voxels_);
    labels_.list_.swap(list);
    if (runs_.empty()) return;
    std::swap(labels_.voxels_, voxels);
    ++labels_.revision_;
  }

  Labels& labels_;
  std::vector<Label> list_before_;
  std::vector<Label> list_after_;
  std::vector<Labels::Run> runs_;
};

const Label* Labels::find(std::uint8_t id) const {
  return label_in(list_, id);
}

Status Labels::change(ChangeKind kind, const std::string& name, std::vector<Label> list,
                      std::vector<Run> runs, PagedBytes voxels) {
  if (history_ != nullptr) {
    TIDEMARK_TRY(history_->close());
  }
  // All that may lack memory comes first: without an entry of the history there is no change.
  voxels.join_even_pages(voxels_);
  const bool has_runs = !runs.empty();
  runs.shrink_to_fit();
  if (history_ != nullptr)
    history_->add({kind, 0, name}, std::make_unique<LabelsChange>(*this, list, std::move(runs)));
  list_.swap(list);
  if (!has_runs) return {};
  std::swap(voxels_, voxels);
  ++revision_;
  return {};
}

Result<std::uint8_t> Labels::add(std::string name) {
  auto label = new_label(list_, std::move(name));
  if (!label) return pass_on(label);
  const std::uint8_t id = label->id;
  std::vector<Label> list = list_;
  list.push_back(*label);
  Status changed = change(ChangeKind::new_label, label->name, std::move(list), {}, voxels_);
  if (!changed) return pass_on(changed);
  return id;
}

Status Labels::set(const Label& label) {
  const Label* present = find(label.id);
  if (present == nullptr) return fail(ErrorKind::usage, "there is no label {}", label.id);
  if (*present == label) return {};
  std::vector<Label> list = list_;
  list[static_cast<std::size_t>(present - list_.data())] = label;
  return change(ChangeKind::label_settings, label.name, std::move(list), {}, voxels_);
}

Status Labels::remove(std::uint8_t id) {
  const Label* present = find(id);
  if (present == nullptr) return fail(ErrorKind::usage, "there is no label {}", id);
  if (present->locked) return fail(ErrorKind::usage, "label {} is locked", present->name);
  std::vector<Label> list = list_;
  std::erase_if(list, [&](const Label& label) { return label.id == id; });
  std::vector<Run> runs;
  PagedBytes voxels = voxels_;
  region(id).for_each_run([&](Index3 voxel, std::int64_t length) {
    runs.push_back({geometry_.offset(voxel), length, id, 0});
    voxels.fill(voxel, {length, 1, 1}, 0);
  });
  return change(ChangeKind::remove_label, present->name, std::move(list), std::move(runs), std::move(voxels));
}

Status Labels::check(const std::vector<Label>& list, const LabelRegion& wanted) const {
  const Label* label = label_in(list, wanted.label);
  if (label == nullptr) return fail(ErrorKind::usage, "there is no label {}", wanted.label);
  if (label->locked) return fail(ErrorKind::usage, "label {} is locked", label->name);
  const VoxelRange bounds = wanted.region.bounds();
  if (bounds.empty() || (geometry_.contains(bounds.low) && geometry_.contains(bounds.high - Index3(1))))
    return {};
  return fail(ErrorKind::usage, "what is accepted reaches beyond the grid of the labels");
}

// Those voxels of the region that are free get that label.
void Labels::give_voxels(const Region& region, std::uint8_t after, const std::array<bool, 256>& free,
                         Acceptance& acceptance, std::vector<Run>& runs, PagedBytes& voxels) const {
  const std::size_t first_run = runs.size();
  std::vector<std::uint8_t> row;
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    row.resize(static_cast<std::size_t>(length));
    voxels.read(voxel, {length, 1, 1}, row.data());
    for (std::int64_t at = 0; at < length;) {
      const std::uint8_t before = row[static_cast<std::size_t>(at)];
      std::int64_t end = at + 1;
      while (end < length && row[static_cast<std::size_t>(end)] == before) ++end;
      if (!free[before]) {
        acceptance.left += end - at;
      } else {
        if (after != 0) acceptance.taken += end - at;
        if (after != 0 && before != after) acceptance.added += end - at;
        if (after != 0 && before != 0 && before != after) acceptance.from_others += end - at;
        if (before != after) runs.push_back({geometry_.offset(voxel) + at, end - at, before, after});
      }
      at = end;
    }
  });
  for (std::size_t n = first_run; n < runs.size(); ++n)
    voxels.fill(geometry_.voxel_at(runs[n].begin), {runs[n].length, 1, 1}, runs[n].after);
}

Result<Acceptance> Labels::give(ChangeKind kind, std::vector<LabelRegion> regions, Take take, Giving giving) {
  std::vector<Label> list = list_;
  Acceptance acceptance;
  for (LabelRegion& wanted : regions) {
    if (wanted.label == 0) {
      auto label = new_label(list, wanted.name);
      if (!label) return pass_on(label);
      wanted.label = label->id;
      list.push_back(std::move(*label));
    }
    TIDEMARK_TRY(check(list, wanted));
    acceptance.label += (acceptance.label.empty() ? "" : ", ") + label_in(list, wanted.label)->name;
  }
  std::vector<Run> runs;
  PagedBytes voxels = voxels_;  // each region is found on top of those before it
  for (const LabelRegion& wanted : regions) {
    std::array<bool, 256> free{};  // whose voxels may be given away
    free[0] = free[wanted.label] = true;
    for (const Label& other : list) {
      if (take == Take::others_too && !other.locked) free[other.id] = true;
    }
    if (giving == Giving::erases) {
      Acceptance erased;
      std::array<bool, 256> own{};
      own[wanted.label] = true;
      give_voxels(wanted.region, 0, own, erased, runs, voxels);
      continue;
    }
    if (giving == Giving::replaces) {
      Acceptance cleared;
      const Region beside = difference(Region(voxels, wanted.label), wanted.region);
      acceptance.given_up += beside.count();
      give_voxels(beside, 0, free, cleared, runs, voxels);
    }
    give_voxels(wanted.region, wanted.label, free, acceptance, runs, voxels);
  }
  if (runs.empty() && list == list_) return acceptance;  // no entry of the history, which would end redo
  Status changed = change(kind, acceptance.label, std::move(list), std::move(runs), std::move(voxels));
  if (!changed) return pass_on(changed);
  return acceptance;
}

Result<Acceptance> Labels::accept(const Region& region, std::uint8_t id, Take take, bool replace) {
  if (find(id) == nullptr) return fail(ErrorKind::usage, "there is no label {}", id);
  return give(ChangeKind::accept, {{id, {}, region}}, take, replace ? Giving::replaces : Giving::adds);
}

Result<Acceptance> Labels::accept_as(const std::string& name, const Region& region, Take take) {
  return give(ChangeKind::accept, {{0, name, region}}, take, Giving::adds);
}

Result<Acceptance> Labels::finish(const std::vector<LabelRegion>& regions, Take take) {
  return give(ChangeKind::finish, regions, take, Giving::replaces);
}

Result<Acceptance> Labels::brush(LabelRegion stroke, Stroke what, Take take) {
  std::vector<LabelRegion> regions;
  regions.push_back(std::move(stroke));
  return give(ChangeKind::label_brush, std::move(regions), take,
              what == Stroke::adds ? Giving::adds : Giving::erases);
}

Status Labels::check(const std::vector<Label>& list, const PagedBytes& voxels) const {
  std::array<bool, 256> known{true};
  for (const Label& label : list) {
    if (label.id == 0 || known[label.id]) {
      return fail(ErrorKind::usage, "label {} is in the list twice, or none", label.id);
    }
    known[label.id] = true;
  }
  if (voxels.size() != geometry_.size) {
    const Index3 size = voxels.size();
    return fail(ErrorKind::usage, "{} labelled voxels, the volume has {}", size.x * size.y * size.z,
                geometry_.voxel_count());
  }
  const std::array<std::int64_t, 256> counts = voxels.counts();
  for (std::size_t id = 0; id < counts.size(); ++id) {
    if (counts[id] > 0 && !known[id])
      return fail(ErrorKind::usage, "a voxel has label {}, which is not in the list", id);
  }
  return {};
}

Status Labels::replace(ChangeKind kind, const std::string& name, std::vector<Label> list, PagedBytes voxels) {
  TIDEMARK_TRY(check(list, voxels));
  std::vector<Run> runs;
  PagedBytes::for_each_difference(
      voxels_, voxels, [&](Index3 voxel, std::int64_t length, std::uint8_t before, std::uint8_t after) {
        const std::int64_t begin = geometry_.offset(voxel);
        const bool goes_on = voxel.x > 0 && !runs.empty() &&
                             runs.back().begin + runs.back().length == begin &&
                             runs.back().before == before && runs.back().after == after;
        if (goes_on) {
          runs.back().length += length;
        } else {
          runs.push_back({begin, length, before, after});
        }
      });
  return change(kind, name, std::move(list), std::move(runs), std::move(voxels));
}

Status Labels::assign(std::vector<Label> list, PagedBytes voxels) {
  TIDEMARK_TRY(check(list, voxels));
  list_ = std::move(list);
  voxels_ = std::move(voxels);
  ++revision_;
  return {};
}

}  // namespace tidemark::document
