// The labels over a volume: what was segmented so far.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

// The outcome of accepting a mask, in voxels of the mask.
struct Acceptance {
  std::string label;
  std::int64_t taken = 0;        // of all that it has now
  std::int64_t from_others = 0;  // of `taken`: had another label before
  std::int64_t left = 0;         // stayed with other labels
};

class Labels {
 public:
  // Changes become entries of `history`, if it is not null. It must not be used after the labels are gone.
  explicit Labels(const Geometry& geometry, History* history = nullptr)
      : geometry_(geometry), history_(history) {}

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] const std::vector<Label>& list() const { return list_; }
  [[nodiscard]] const Label* find(std::uint8_t id) const;  // null: there is none
  // A label id for each voxel in voxel order; empty while no voxel has a label.
  [[nodiscard]] std::span<const std::uint8_t> voxels() const { return voxels_; }
  [[nodiscard]] std::uint64_t revision() const { return revision_; }  // another after each change of voxels

  // A new label with a colour that differs from the others'. Fails (ErrorKind::usage) when there are 255.
  Result<std::uint8_t> add(std::string name);
  Status set(const Label& label);  // everything but the voxels of the label with that id
  Status remove(std::uint8_t id);  // and clears its voxels

  // Gives the voxels of `mask` to the label. With `replace`, the label's other voxels are cleared. Fails
  // (ErrorKind::usage) when the label is locked or unknown, or the grid differs.
  Result<Acceptance> accept(const Mask& mask, std::uint8_t id, Take take = Take::free_voxels,
                            bool replace = true);
  [[nodiscard]] Mask mask(std::uint8_t id) const;

  // Other labels and other voxels, all at once. Fails as assign() does.
  Status replace(ChangeKind kind, const std::string& name, std::vector<Label> list,
                 std::vector<std::uint8_t> voxels);

  // Restores saved labels; not an entry of the history. Fails (ErrorKind::usage) when a voxel's label is not
  // in the list, an id is there twice, or the number of voxels is neither 0 nor the grid's.
  Status assign(std::vector<Label> list, std::vector<std::uint8_t> voxels);

 private:
  friend class LabelsChange;
  [[nodiscard]] Status check(const std::vector<Label>& list, const std::vector<std::uint8_t>& voxels) const;

  // Lets `edit` change the list, or the list and the voxels, and makes an entry of the difference.
  enum class Touches { list, voxels };
  Status change(ChangeKind kind, const std::string& name, Touches what, const std::function<void()>& edit);

  Geometry geometry_;
  History* history_;
  std::vector<Label> list_;
  std::vector<std::uint8_t> voxels_;
  std::uint64_t revision_ = 0;
};

}  // namespace tidemark::document
