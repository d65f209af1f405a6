#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "imaging/dicom/separate_volumes.h"
#include "imaging/dicom/series_geometry.h"
#include "imaging/dicom/split_series.h"

namespace tidemark::imaging {
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

// The reason of images that are in no volume of their series.
std::string reason_of_rest(const Group& rest) {
  const std::string name = rest.front().file.filename().string();
  if (const std::string& problem = rest.front().problem; !problem.empty()) {
    return fmt::format("{}: {}{}", name, problem,
                       rest.size() == 1 ? "" : fmt::format(" (and {} more)", rest.size() - 1));
  }
  if (rest.size() == 1) return name + " is a single image of its kind: a volume needs at least two slices";
  return fmt::format("{} and {} more are single images of their kinds: a volume needs at least two slices",
                     name, rest.size() - 1);
}

// The images of each patient, and of each study of one, apart: some software writes one SeriesInstanceUID, or
// none, for all. An image that names nobody belongs to the only one that others name, if there is no second.
// Some anonymisers give each file a study of its own, which tells nothing apart.
std::vector<Group> by_owner(Group group) {
  std::set<std::string> patients;
  std::set<std::string> studies;
  std::set<std::filesystem::path> files;
  for (const SliceHeader& slice : group) {
    files.insert(slice.file);
    if (!slice.patient.id.empty()) patients.insert(slice.patient.id);
    if (!slice.study_uid.empty()) studies.insert(slice.study_uid);
  }
  const bool by_study = studies.size() > 1 && studies.size() < files.size();
  const auto owner_of = [&](const SliceHeader& slice) {
    return std::pair(patients.size() > 1 ? slice.patient.id : std::string(),
                     by_study ? slice.study_uid : std::string());
  };
  std::vector<Group> result;  // in order of appearance
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  for (SliceHeader& slice : group) {
    const auto [owner, is_new] = known.try_emplace(owner_of(slice), result.size());
    if (is_new) result.emplace_back();
    result[owner->second].push_back(std::move(slice));
  }
  return result;
}

// One series, or each of the volumes in it and the images left over.
std::vector<Series> arrange_parts(Group group) {
  std::vector<Group> owners = by_owner(std::move(group));
  std::vector<SeriesPart> parts;
  for (Group& one : owners) {
    auto own = split_series(std::move(one));
    std::move(own.begin(), own.end(), std::back_inserter(parts));
  }
  const auto volumes =
      std::count_if(parts.begin(), parts.end(), [](const auto& part) { return !part.is_rest; });
  const bool has_rest = std::cmp_less(volumes, parts.size());
  std::vector<Series> result;
  for (SeriesPart& part : parts) {
    const std::string rest = part.is_rest ? reason_of_rest(part.slices) : "";
    for (SliceHeader& slice : part.slices) slice.description = join_labels(slice.description, part.label);
    Series& series = result.emplace_back(arrange_series(std::move(part.slices)));
    if (parts.size() > 1) {
      series.uid += fmt::format("#{}", result.size());
      series.changes.push_back(fmt::format(
          "one part of its series, which holds {} volume{}{}{}", volumes, volumes == 1 ? "" : "s",
          has_rest ? " and images that fit into none" : "", part.label.empty() ? "" : ": " + part.label));
    }
    series.changes.insert(series.changes.end(), part.changes.begin(), part.changes.end());
    if (owners.size() > 1) {
      series.warnings.emplace_back(
          "images of another patient or study have the same SeriesInstanceUID (0020,000E), or none as well; "
          "PatientID (0010,0020) and StudyInstanceUID (0020,000D) keep them apart");
    }
    if (part.is_rest) {
      series.loadable = false;
      series.reason = rest;
      series.stack = {};  // no policy makes a grid of it
      series.grid = {};
    }
  }
  return result;
}

void append(std::vector<Series> parts, std::vector<Series>& result) {
  std::move(parts.begin(), parts.end(), std::back_inserter(result));
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
      append(arrange_parts(std::move(group)), result);
      continue;
    }
    std::map<std::filesystem::path, Group> folders;
    for (SliceHeader& slice : group) folders[slice.file.parent_path()].push_back(std::move(slice));
    for (auto& [folder, part] : folders) {
      auto parts = arrange_parts(std::move(part));
      for (Series& series : parts) {
        series.warnings.push_back(fmt::format("copies of this series lie in {} folders; this one is {}",
                                              folders.size(), folder.filename().string()));
      }
      append(std::move(parts), result);
    }
  }
  return result;
}

}  // namespace tidemark::imaging
