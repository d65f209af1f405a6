// A zip archive, unpacked as studies in one are.
#include "imaging/archive/study_archive.h"

#include <algorithm>
#include <cstdlib>

#include "tests/fuzz/scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace tidemark;
  static fuzz::ScratchFile scratch;
  const auto file = scratch.write("study.zip", bytes, count);
  // What unpacks to some megabytes, which is allowed, would take longer than an input may.
  constexpr int kMostReports = 64;
  std::stop_source stop;
  int reports = 0;
  Progress progress;
  progress.stop = stop.get_token();
  progress.report = [&](double, std::string_view) {
    if (++reports == kMostReports) stop.request_stop();
  };
  const auto archive = imaging::StudyArchive::unpack(file, progress);
  if (!archive) return 0;
  const auto is_harmless = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '-' || c == '_';
  };
  for (const auto& entry : std::filesystem::recursive_directory_iterator((*archive)->folder())) {
    const std::string name = entry.path().filename().string();
    if (!std::all_of(name.begin(), name.end(), is_harmless)) std::abort();
    if (!entry.is_directory() && !entry.is_regular_file()) std::abort();
    if (entry.is_symlink()) std::abort();
  }
  return 0;
}
