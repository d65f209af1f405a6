// Studies in zip archives.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "imaging/archive/private_folder.h"
#include "imaging/series.h"

namespace tidemark::imaging {

// By its first bytes.
[[nodiscard]] bool is_zip_archive(const std::filesystem::path& file);

// The files of an archive, unpacked for as long as the object lives.
class StudyArchive {
 public:
  // The largest studies have some 20,000 images. The archive's end says how many entries there are, so that
  // more are refused before one is looked at.
  static constexpr std::int64_t kMostEntries = 50'000;
  // An archive that unpacks to more than a gibibyte may not unpack to so many times its own size.
  static constexpr std::int64_t kMostTimes = 200;

  // Every entry becomes a file whose name is made here: of its number, and of those characters of its own
  // name that mean nothing to a file system. Archives within it are left out. Fails (ErrorKind::input) when
  // the archive is damaged, encrypted, or would unpack to what no study is; ErrorKind::write when there is
  // no room for it.
  static Result<std::shared_ptr<const StudyArchive>> unpack(const std::filesystem::path& file,
                                                            const Progress& progress = {});

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }
  [[nodiscard]] const std::vector<SkippedFile>& left_out() const { return left_out_; }
  // A message with the archive's name where the folder's stood.
  [[nodiscard]] std::string name_archive_in(std::string message) const;

 private:
  StudyArchive(std::filesystem::path file, PrivateFolder folder);

  std::filesystem::path file_;
  PrivateFolder folder_;
  std::vector<SkippedFile> left_out_;
};

}  // namespace tidemark::imaging
