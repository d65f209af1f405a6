#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "imaging/dicom/series_geometry.h"

namespace tidemark {
namespace {

using Group = std::vector<SliceHeader>;

// Whether an image occurs again in another folder.
bool has_copies_elsewhere(const Group& group) {
  std::map<std::string, std::filesystem::path> seen;
  return std::any_of(group.begin(), group.end(), [&](const SliceHeader& slice) {
    if (slice.sop_instance_uid.empty()) return false;
    const auto folder = slice.file.parent_path();
    const auto [known, is_new] = seen.emplace(slice.sop_instance_uid, folder);
    return !is_new && known->second != folder;
  });
}

}  // namespace

std::string series_key(const SliceHeader& slice) {
  if (!slice.series_uid.empty()) return slice.series_uid;
  // UIDs hold digits and dots, so that such a key is none.
  return fmt::format("{}\n{}\n{}", slice.file.parent_path().string(), slice.modality, slice.description);
}

std::vector<Series> group_series(std::vector<SliceHeader> slices) {
  // In the order in which the files were listed, so that the result does not depend on UIDs.
  std::vector<std::string> order;
  std::map<std::string, Group> groups;
  for (SliceHeader& slice : slices) {
    const std::string key = series_key(slice);
    Group& group = groups[key];
    if (group.empty()) order.push_back(key);
    group.push_back(std::move(slice));
  }

  std::vector<Series> result;
  for (const std::string& key : order) {
    Group& group = groups[key];
    if (!has_copies_elsewhere(group)) {
      result.push_back(arrange_series(std::move(group)));
      continue;
    }
    std::map<std::filesystem::path, Group> folders;
    for (SliceHeader& slice : group) folders[slice.file.parent_path()].push_back(std::move(slice));
    for (auto& [folder, part] : folders) {
      result.push_back(arrange_series(std::move(part)));
      result.back().warnings.push_back(fmt::format("copies of this series lie in {} folders; this one is {}",
                                                   folders.size(), folder.filename().string()));
    }
  }
  return result;
}

}  // namespace tidemark
