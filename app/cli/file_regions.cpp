#include "app/cli/file_regions.h"

#include <algorithm>

#include "document/result_files.h"
#include "imaging/results/results.h"

namespace tidemark::cli {
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

Result<FileRegions> read_regions(const std::string& file, bool labels, std::optional<Geometry>& grid,
                                 Console& console) {
  const Geometry* const wanted = grid ? &*grid : nullptr;
  FileRegions regions{file, {}};
  if (!labels) {
    auto loaded = imaging::load_any_mask(file, wanted, console.progress());
    if (!loaded) return pass_on(loaded);
    for (const std::string& change : loaded->changes) console.warn(fmt::format("{}: {}", file, change));
    grid = loaded->mask.geometry;
    regions.list.emplace_back(std::string(), Region(loaded->mask));
    return regions;
  }
  auto segments = document::read_labels(file, wanted, console.progress());
  if (!segments) return pass_on(segments);
  for (const std::string& change : segments->changes) console.warn(fmt::format("{}: {}", file, change));
  grid = segments->geometry;
  for (const imaging::Segment& segment : segments->list)
    regions.list.emplace_back(unused_name(regions, segment.name), imaging::region_of(segment, *grid));
  return regions;
}

}  // namespace tidemark::cli
