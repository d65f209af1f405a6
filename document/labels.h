// The labels over a volume: what was segmented so far.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/paged_bytes.h"
#include "core/region.h"
#include "core/volume.h"
#include "document/history.h"
#include "imaging/results/segment_meaning.h"

namespace tidemark::document {

struct Label {
  std::uint8_t id = 1;  // 1 to 255; 0 is no label
  std::string name;
  std::array<std::uint8_t, 3> colour{255, 255, 0};
  bool visible = true;
  bool locked = false;                             // its voxels are not changed by others
  std::optional<imaging::SegmentMeaning> meaning;  // unset: as its name says

  [[nodiscard]] imaging::SegmentMeaning coded() const {
    return meaning ? *meaning : imaging::guess_segment_meaning(name);
  }
  bool operator==(const Label&) const = default;
};

// The voxels that a label may take when it accepts a mask. Those of locked labels stay in either case.
enum class Take { free_voxels, others_too };

// What a label is to become.
struct LabelRegion {
  std::uint8_t label = 0;  // 0: a new one
  std::string name;        // of a new one
  Region region;
};

// The outcome of accepting regions, in voxels of them.
struct Acceptance {
  std::string label;             // the name, or several
  std::string kept;              // the label that was chosen and stays as it was; mostly none
  std::int64_t taken = 0;        // of all that it has now
  std::int64_t added = 0;        // of `taken`: it had not before
  std::int64_t from_others = 0;  // of `taken`: had another label before
  std::int64_t given_up = 0;     // it had before, and has no more
  std::int64_t left = 0;         // stayed with other labels
};

class Labels {
 public:
  // Changes become entries of `history`, if it is not null. It must not be used after the labels are gone.
  // Where nothing differs after it, a call makes no entry.
  explicit Labels(const Geometry& geometry, History* history = nullptr)
      : geometry_(geometry), history_(history), voxels_(geometry.size) {}

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] const std::vector<Label>& list() const { return list_; }
  [[nodiscard]] const Label* find(std::uint8_t id) const;  // null: there is none
  // A label id for each voxel, 0 for none.
  [[nodiscard]] const PagedBytes& voxels() const { return voxels_; }
  [[nodiscard]] std::uint64_t revision() const { return revision_; }  // another after each change of voxels

  // A new label with a colour that differs from the others'. Fails (ErrorKind::usage) when there are 255.
  Result<std::uint8_t> add(std::string name);
  Status set(const Label& label);  // everything but the voxels of the label with that id
  Status remove(std::uint8_t id);  // and clears its voxels

  // Gives the voxels of `region` to the label. With `replace`, the label's other voxels are cleared. Fails
  // (ErrorKind::usage) when the label is locked or unknown, or the region reaches beyond the grid.
  Result<Acceptance> accept(const Region& region, std::uint8_t id, Take take = Take::free_voxels,
                            bool replace = true);
  // The same for a new label: one entry of the history. Fails where there is no room for it.
  Result<Acceptance> accept_as(const std::string& name, const Region& region, Take take = Take::free_voxels);
  // The labels become those regions, one after the other: one entry of the history. Fails as accept() does,
  // and where there is no room for a new label, changing nothing.
  Result<Acceptance> finish(const std::vector<LabelRegion>& regions, Take take = Take::free_voxels);
  // A stroke over a region: the label gets its voxels, or loses them. Fails as finish() does.
  enum class Stroke { adds, erases };
  Result<Acceptance> brush(LabelRegion stroke, Stroke what, Take take = Take::free_voxels);
  [[nodiscard]] Region region(std::uint8_t id) const { return {voxels_, id}; }

  // Other labels and other voxels, all at once. Fails as assign() does.
  Status replace(ChangeKind kind, const std::string& name, std::vector<Label> list, PagedBytes voxels);

  // Restores saved labels; not an entry of the history. Fails (ErrorKind::usage) when a voxel's label is not
  // in the list, an id is there twice, or the voxels are of another grid.
  Status assign(std::vector<Label> list, PagedBytes voxels);

 private:
  friend class LabelsChange;
  struct Run;
  [[nodiscard]] Status check(const std::vector<Label>& list, const PagedBytes& voxels) const;
  [[nodiscard]] Status check(const std::vector<Label>& list, const LabelRegion& wanted) const;
  enum class Giving { replaces, adds, erases };
  Result<Acceptance> give(ChangeKind kind, std::vector<LabelRegion> regions, Take take, Giving giving);
  void give_voxels(const Region& region, std::uint8_t after, const std::array<bool, 256>& free,
                   Acceptance& acceptance, std::vector<Run>& runs, PagedBytes& voxels) const;

  // Another list and other voxels, as an entry of the history. `runs` are what differs in them: put one after
  // the other, they make `voxels` of those before.
  Status change(ChangeKind kind, const std::string& name, std::vector<Label> list, std::vector<Run> runs,
                PagedBytes voxels);

  Geometry geometry_;
  History* history_;
  std::vector<Label> list_;
  PagedBytes voxels_;
  std::uint64_t revision_ = 0;
};

}  // namespace tidemark::document
