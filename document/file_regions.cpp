#include "document/file_regions.h"

#include <algorithm>

#include "document/result_files.h"

namespace tidemark::document {
namespace {

// A name that is there already gets a number.
std::string unused_name(const FileRegions& regions, const std::string& name) {
  std::string unused = name;
  for (int n = 2; regions.find(unused) != nullptr; ++n) unused = fmt::format("{} ({})", name, n);
  return unused;
}

}  // namespace

const Region* FileRegions::find(const std::string& name) const {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const auto& region) { return region.first == name; });
  return found == list.end() ? nullptr : &found->second;
}

Region FileRegions::all() const {
  Region all;
  for (const auto& [name, region] : list) all = united(all, region);
  return all;
}

Result<FileRegions> read_regions(const std::filesystem::path& file, bool labels,
                                 std::optional<Geometry>& grid, const Progress& progress) {
  const Geometry* const wanted = grid ? &*grid : nullptr;
  FileRegions regions{file, {}, {}};
  if (!labels) {
    auto loaded = imaging::load_any_mask(file, wanted, progress);
    if (!loaded) return pass_on(loaded);
    regions.changes = std::move(loaded->changes);
    regions.frames_of_reference = std::move(loaded->frames_of_reference);
    grid = loaded->mask.geometry;
    regions.list.emplace_back(std::string(), Region(loaded->mask));
    return regions;
  }
  auto segments = read_labels(file, wanted, progress);
  if (!segments) return pass_on(segments);
  regions.changes = std::move(segments->changes);
  regions.frames_of_reference = std::move(segments->frames_of_reference);
  grid = segments->geometry;
  for (const imaging::Segment& segment : segments->list) {
    if (progress.cancelled()) return cancelled_error();
    regions.list.emplace_back(unused_name(regions, segment.name), imaging::region_of(segment, *grid));
  }
  return regions;
}

}  // namespace tidemark::document
