#include "document/labels.h"

#include <algorithm>
#include <utility>

#include "core/label_colour.h"

namespace tidemark::document {
namespace {

// A run of voxels that had one label and have another one now.
struct Run {
  std::int64_t begin = 0;
  std::int64_t length = 0;
  std::uint8_t before = 0;
  std::uint8_t after = 0;
};

std::uint8_t at(const std::vector<std::uint8_t>& voxels, std::size_t i) {
  return voxels.empty() ? std::uint8_t{0} : voxels[i];
}

std::vector<Run> changed_runs(const std::vector<std::uint8_t>& before,
                              const std::vector<std::uint8_t>& after) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < std::max(before.size(), after.size()); ++i) {
    const std::uint8_t old_id = at(before, i);
    const std::uint8_t new_id = at(after, i);
    if (old_id == new_id) continue;
    const auto offset = static_cast<std::int64_t>(i);
    if (!runs.empty() && runs.back().begin + runs.back().length == offset && runs.back().before == old_id &&
        runs.back().after == new_id) {
      ++runs.back().length;
    } else {
      runs.push_back({offset, 1, old_id, new_id});
    }
  }
  runs.shrink_to_fit();
  return runs;
}

}  // namespace

class LabelsChange : public Change {
 public:
  LabelsChange(Labels& labels, std::vector<Label> list_before, std::vector<Run> runs)
      : labels_(labels),
        list_before_(std::move(list_before)),
        list_after_(labels.list_),
        runs_(std::move(runs)) {}

  Status undo() override {
    labels_.list_ = list_before_;
    return put(&Run::before);
  }
  Status redo() override {
    labels_.list_ = list_after_;
    return put(&Run::after);
  }
  [[nodiscard]] std::int64_t bytes() const override {
    return static_cast<std::int64_t>(sizeof(*this) + runs_.size() * sizeof(Run) +
                                     (list_before_.size() + list_after_.size()) * sizeof(Label));
  }

 private:
  Status put(std::uint8_t Run::*side) {
    if (runs_.empty()) return {};
    labels_.voxels_.resize(static_cast<std::size_t>(labels_.geometry_.voxel_count()));
    for (const Run& run : runs_) std::fill_n(labels_.voxels_.begin() + run.begin, run.length, run.*side);
    ++labels_.revision_;
    return {};
  }

  Labels& labels_;
  std::vector<Label> list_before_;
  std::vector<Label> list_after_;
  std::vector<Run> runs_;
};

const Label* Labels::find(std::uint8_t id) const {
  const auto found = std::find_if(list_.begin(), list_.end(), [&](const Label& l) { return l.id == id; });
  return found == list_.end() ? nullptr : &*found;
}

Status Labels::change(ChangeKind kind, const std::string& name, Touches what,
                      const std::function<void()>& edit) {
  if (history_ != nullptr) {
    TIDEMARK_TRY(history_->close());
  }
  std::vector<Label> list_before = list_;
  std::vector<std::uint8_t> voxels_before;
  if (what == Touches::voxels) voxels_before = voxels_;
  try {
    edit();
    std::vector<Run> runs;
    if (what == Touches::voxels) {
      runs = changed_runs(voxels_before, voxels_);
      ++revision_;
    }
    if (history_ != nullptr) {
      history_->add({kind, 0, name}, std::make_unique<LabelsChange>(*this, list_before, std::move(runs)));
    }
  } catch (...) {  // without memory for an entry of the history there is no change
    list_ = std::move(list_before);
    if (what == Touches::voxels) voxels_ = std::move(voxels_before);
    throw;
  }
  return {};
}

Result<std::uint8_t> Labels::add(std::string name) {
  for (int id = 1; id <= 255; ++id) {
    if (find(static_cast<std::uint8_t>(id)) != nullptr) continue;
    Label label;
    label.id = static_cast<std::uint8_t>(id);
    label.name = name;
    label.colour = label_colour(label.id);
    Status changed = change(ChangeKind::new_label, name, Touches::list, [&] { list_.push_back(label); });
    if (!changed) return pass_on(changed);
    return label.id;
  }
  return fail(ErrorKind::usage, "there are 255 labels already");
}

Status Labels::set(const Label& label) {
  const Label* present = find(label.id);
  if (present == nullptr) return fail(ErrorKind::usage, "there is no label {}", label.id);
  if (*present == label) return {};
  const auto index = static_cast<std::size_t>(present - list_.data());
  return change(ChangeKind::label_settings, label.name, Touches::list, [&] { list_[index] = label; });
}

Status Labels::remove(std::uint8_t id) {
  const Label* present = find(id);
  if (present == nullptr) return fail(ErrorKind::usage, "there is no label {}", id);
  if (present->locked) return fail(ErrorKind::usage, "label {} is locked", present->name);
  return change(ChangeKind::remove_label, present->name, Touches::voxels, [&] {
    std::erase_if(list_, [&](const Label& label) { return label.id == id; });
    std::replace(voxels_.begin(), voxels_.end(), id, std::uint8_t{0});
  });
}

Result<Acceptance> Labels::accept(const Mask& mask, std::uint8_t id, Take take, bool replace) {
  const Label* label = find(id);
  if (label == nullptr) return fail(ErrorKind::usage, "there is no label {}", id);
  if (label->locked) return fail(ErrorKind::usage, "label {} is locked", label->name);
  if (mask.geometry.size != geometry_.size) {
    return fail(ErrorKind::usage, "the mask and the labels have different grids");
  }
  std::array<bool, 256> free{};  // whose voxels may be given away
  free[0] = free[id] = true;
  for (const Label& other : list_) {
    if (take == Take::others_too && !other.locked) free[other.id] = true;
  }
  Acceptance acceptance{.label = label->name};
  Status changed = change(ChangeKind::accept, label->name, Touches::voxels, [&] {
    voxels_.resize(mask.voxels.size());
    for (std::size_t i = 0; i < mask.voxels.size(); ++i) {
      std::uint8_t& voxel = voxels_[i];
      if (mask.voxels[i] != 0) {
        if (!free[voxel]) {
          ++acceptance.left;
          continue;
        }
        ++acceptance.taken;
        if (voxel != 0 && voxel != id) ++acceptance.from_others;
        voxel = id;
      } else if (replace && voxel == id) {
        voxel = 0;
      }
    }
  });
  if (!changed) return pass_on(changed);
  return acceptance;
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
  return change(kind, name, Touches::voxels, [&] {
    list_ = std::move(list);
    voxels_ = std::move(voxels);
  });
}

Status Labels::assign(std::vector<Label> list, std::vector<std::uint8_t> voxels) {
  TIDEMARK_TRY(check(list, voxels));
  list_ = std::move(list);
  voxels_ = std::move(voxels);
  ++revision_;
  return {};
}

}  // namespace tidemark::document
