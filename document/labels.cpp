#include "document/labels.h"

#include <algorithm>
#include <optional>
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

// Room for the voxels of a grid, which goes again unless something is put there.
class Room {
 public:
  Room(std::vector<std::uint8_t>& voxels, std::int64_t count) : voxels_(voxels), was_empty_(voxels.empty()) {
    voxels_.resize(static_cast<std::size_t>(count));
  }
  ~Room() {
    if (was_empty_ && !kept_) std::vector<std::uint8_t>().swap(voxels_);
  }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;
  void keep() { kept_ = true; }

 private:
  std::vector<std::uint8_t>& voxels_;
  bool was_empty_;
  bool kept_ = false;
};

}  // namespace

// A run of voxels that had one label and have another one now.
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
    labels_.list_ = list_before_;
    put(runs_.rbegin(), runs_.rend(), &Labels::Run::before);
    return {};
  }
  Status redo() override {
    labels_.list_ = list_after_;
    put_runs();
    return {};
  }
  void put_runs() { put(runs_.begin(), runs_.end(), &Labels::Run::after); }
  [[nodiscard]] std::int64_t bytes() const override {
    return static_cast<std::int64_t>(sizeof(*this) + runs_.size() * sizeof(Labels::Run) +
                                     (list_before_.size() + list_after_.size()) * sizeof(Label));
  }

 private:
  template <class Iterator>
  void put(Iterator begin, Iterator end, std::uint8_t Labels::Run::*side) {
    if (runs_.empty()) return;
    for (auto run = begin; run != end; ++run) labels_.put(*run, side);
    ++labels_.revision_;
  }

  Labels& labels_;
  std::vector<Label> list_before_;
  std::vector<Label> list_after_;
  std::vector<Labels::Run> runs_;
};

void Labels::put(const Run& run, std::uint8_t Run::*side) {
  std::fill_n(voxels_.begin() + run.begin, run.length, run.*side);
}

const Label* Labels::find(std::uint8_t id) const {
  return label_in(list_, id);
}

Status Labels::change(ChangeKind kind, const std::string& name, std::vector<Label> list,
                      std::vector<Run> runs) {
  if (history_ != nullptr) {
    TIDEMARK_TRY(history_->close());
  }
  // All that may lack memory comes first: without an entry of the history there is no change.
  std::optional<Room> room;
  if (!runs.empty()) room.emplace(voxels_, geometry_.voxel_count());
  runs.shrink_to_fit();
  auto made = std::make_unique<LabelsChange>(*this, list, std::move(runs));
  LabelsChange& change = *made;
  if (history_ != nullptr) history_->add({kind, 0, name}, std::move(made));
  list_.swap(list);
  change.put_runs();
  if (room) room->keep();
  return {};
}

Result<std::uint8_t> Labels::add(std::string name) {
  auto label = new_label(list_, std::move(name));
  if (!label) return pass_on(label);
  const std::uint8_t id = label->id;
  std::vector<Label> list = list_;
  list.push_back(*label);
  Status changed = change(ChangeKind::new_label, label->name, std::move(list), {});
  if (!changed) return pass_on(changed);
  return id;
}

Status Labels::set(const Label& label) {
  const Label* present = find(label.id);
  if (present == nullptr) return fail(ErrorKind::usage, "there is no label {}", label.id);
  if (*present == label) return {};
  std::vector<Label> list = list_;
  list[static_cast<std::size_t>(present - list_.data())] = label;
  return change(ChangeKind::label_settings, label.name, std::move(list), {});
}

Status Labels::remove(std::uint8_t id) {
  const Label* present = find(id);
  if (present == nullptr) return fail(ErrorKind::usage, "there is no label {}", id);
  if (present->locked) return fail(ErrorKind::usage, "label {} is locked", present->name);
  std::vector<Label> list = list_;
  std::erase_if(list, [&](const Label& label) { return label.id == id; });
  std::vector<Run> runs;
  region(id).for_each_run([&](Index3 voxel, std::int64_t length) {
    runs.push_back({geometry_.offset(voxel), length, id, 0});
  });
  return change(ChangeKind::remove_label, present->name, std::move(list), std::move(runs));
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

// Those voxels of the region that are free get that label; `runs` were put already.
void Labels::add_runs(const Region& region, std::uint8_t after, const std::array<bool, 256>& free,
                      Acceptance& acceptance, std::vector<Run>& runs) const {
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    const std::int64_t begin = geometry_.offset(voxel);
    for (std::int64_t at = begin; at < begin + length;) {
      const std::uint8_t before = voxels_[static_cast<std::size_t>(at)];
      std::int64_t end = at + 1;
      while (end < begin + length && voxels_[static_cast<std::size_t>(end)] == before) ++end;
      if (!free[before]) {
        acceptance.left += end - at;
      } else {
        if (after != 0) acceptance.taken += end - at;
        if (after != 0 && before != 0 && before != after) acceptance.from_others += end - at;
        if (before != after) runs.push_back({at, end - at, before, after});
      }
      at = end;
    }
  });
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
  Room room(voxels_, geometry_.voxel_count());
  std::vector<Run> runs;
  // Each region is found on top of those before it. Then they are taken back: change() puts them.
  std::size_t put_so_far = 0;
  const auto put_new = [&] {
    for (; put_so_far < runs.size(); ++put_so_far) put(runs[put_so_far], &Run::after);
  };
  const auto take_back = [&] {
    while (put_so_far > 0) put(runs[--put_so_far], &Run::before);
  };
  try {
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
        add_runs(wanted.region, 0, own, erased, runs);
      } else if (giving == Giving::replaces) {
        Acceptance cleared;
        add_runs(difference(region(wanted.label), wanted.region), 0, free, cleared, runs);
        put_new();
      }
      if (giving != Giving::erases) add_runs(wanted.region, wanted.label, free, acceptance, runs);
      put_new();
    }
  } catch (...) {
    take_back();
    throw;
  }
  take_back();
  Status changed = change(kind, acceptance.label, std::move(list), std::move(runs));
  if (!changed) return pass_on(changed);
  room.keep();
  return acceptance;
}

Result<Acceptance> Labels::accept(const Region& region, std::uint8_t id, Take take, bool replace) {
  if (find(id) == nullptr) return fail(ErrorKind::usage, "there is no label {}", id);
  return give(ChangeKind::accept, {{id, {}, region}}, take, replace ? Giving::replaces : Giving::adds);
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

Mask Labels::mask(std::uint8_t id) const {
  Mask mask{geometry_, std::vector<std::uint8_t>(static_cast<std::size_t>(geometry_.voxel_count()))};
  std::transform(voxels_.begin(), voxels_.end(), mask.voxels.begin(),
                 [&](std::uint8_t voxel) { return std::uint8_t(voxel == id); });
  return mask;
}

Status Labels::check(const std::vector<Label>& list, const std::vector<std::uint8_t>& voxels) const {
  std::array<bool, 256> known{true};
  for (const Label& label : list) {
    if (label.id == 0 || known[label.id]) {
      return fail(ErrorKind::usage, "label {} is in the list twice, or none", label.id);
    }
    known[label.id] = true;
  }
  if (!voxels.empty() && static_cast<std::int64_t>(voxels.size()) != geometry_.voxel_count()) {
    return fail(ErrorKind::usage, "{} labelled voxels, the volume has {}", voxels.size(),
                geometry_.voxel_count());
  }
  const auto stray = std::find_if(voxels.begin(), voxels.end(), [&](std::uint8_t id) { return !known[id]; });
  if (stray != voxels.end())
    return fail(ErrorKind::usage, "a voxel has label {}, which is not in the list", *stray);
  return {};
}

Status Labels::replace(ChangeKind kind, const std::string& name, std::vector<Label> list,
                       std::vector<std::uint8_t> voxels) {
  TIDEMARK_TRY(check(list, voxels));
  std::vector<Run> runs;
  for (std::size_t i = 0; i < std::max(voxels.size(), voxels_.size()); ++i) {
    const std::uint8_t before = i < voxels_.size() ? voxels_[i] : std::uint8_t{0};
    const std::uint8_t after = i < voxels.size() ? voxels[i] : std::uint8_t{0};
    if (before == after) continue;
    const auto at = static_cast<std::int64_t>(i);
    if (!runs.empty() && runs.back().begin + runs.back().length == at && runs.back().before == before &&
        runs.back().after == after) {
      ++runs.back().length;
    } else {
      runs.push_back({at, 1, before, after});
    }
  }
  return change(kind, name, std::move(list), std::move(runs));
}

Status Labels::assign(std::vector<Label> list, std::vector<std::uint8_t> voxels) {
  TIDEMARK_TRY(check(list, voxels));
  list_ = std::move(list);
  voxels_ = std::move(voxels);
  ++revision_;
  return {};
}

}  // namespace tidemark::document
