// The output files of a command: checked before the long work, and written all or none.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/atomic_file.h"
#include "core/progress.h"
#include "core/result.h"

namespace tidemark::cli {

// The content of a file, by its suffix.
enum class FileForm { volume, mesh, recipe, segmentation, level_set };

class Outputs {
 public:
  // Announces a file. `option` is for messages; `forms` says which suffixes may be asked for. Fails with
  // ErrorKind::usage on an unknown suffix, a file named twice or one of a study, and with ErrorKind::write
  // when the folder is missing or cannot be written to.
  Status announce(const std::string& option, const std::filesystem::path& file,
                  const std::vector<FileForm>& forms);
  Status announce_json(const std::string& option, const std::filesystem::path& file);
  Status announce_png(const std::string& option, const std::filesystem::path& file);
  Status announce_gif(const std::string& option, const std::filesystem::path& file);
  Status announce_dicom(const std::string& option, const std::filesystem::path& file);
  Status announce_csv(const std::string& option, const std::filesystem::path& file);

  // Fails (ErrorKind::usage) when an announced file is this one. See spare_study() and spare_inputs().
  [[nodiscard]] Status spare(const std::filesystem::path& input) const;

  // Writes an announced file under a temporary name beside its target; `write` gets that name.
  Status stage(const std::filesystem::path& file,
               const std::function<Status(const std::filesystem::path&)>& write);

  // Gives all staged files their names, as AtomicFile::commit_all() does. Without it they are removed again.
  Status commit(const Progress& progress);

 private:
  Status announce_suffix(const std::string& option, const std::filesystem::path& file,
                         const std::string& suffix);
  Status announce_file(const std::string& option, const std::filesystem::path& file);

  std::vector<std::filesystem::path> files_;
  std::vector<AtomicFile> staged_;
};

// By the suffix of a file that was announced.
[[nodiscard]] FileForm form_of(const std::filesystem::path& file);

}  // namespace tidemark::cli
