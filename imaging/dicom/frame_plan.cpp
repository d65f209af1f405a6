#include "imaging/dicom/frame_plan.h"

#include <map>
#include <utility>

namespace tidemark::imaging {

FramePlan::FramePlan(const Series& series) : series_(series), files_(series.files.size()) {
  std::map<std::filesystem::path, std::size_t> file_index;
  for (std::size_t f = 0; f < series.files.size(); ++f) file_index.emplace(series.files[f], f);
  std::map<std::pair<std::size_t, std::int64_t>, std::size_t> known;
  for (std::size_t k = 0; k < series.sources.size(); ++k) {
    const SliceSource& source = series.sources[k];
    const std::size_t file = file_index.at(source.file);
    const auto [place, is_new] = known.emplace(std::pair(file, source.frame), work_.size());
    if (is_new) {
      work_.push_back({file, source.frame, {}});
      ++files_[file].frames_left;
    }
    work_[place->second].slices.push_back(static_cast<std::int64_t>(k));
  }
}

Result<std::shared_ptr<const FrameReader>> FramePlan::open(const FrameWork& work) {
  File& file = files_[work.file];
  const std::lock_guard lock(file.mutex);
  if (!file.reader) {
    auto reader = FrameReader::open(series_.files[work.file]);
    if (!reader) return pass_on(reader);
    file.reader = std::make_shared<const FrameReader>(std::move(*reader));
  }
  return file.reader;
}

void FramePlan::is_done(const FrameWork& work) {
  File& file = files_[work.file];
  const std::lock_guard lock(file.mutex);
  if (--file.frames_left <= 0) file.reader.reset();
}

}  // namespace tidemark::imaging
