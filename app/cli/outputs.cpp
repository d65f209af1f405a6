#include "app/cli/outputs.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <system_error>

#include "app/cli/audit.h"
#include "imaging/files/volume_file.h"
#include "imaging/results/results.h"
#include "imaging/surface/surface.h"

namespace tidemark::cli {
namespace {

std::string lower_suffix(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return suffix;
}

bool has_form(const std::filesystem::path& file, FileForm form) {
  switch (form) {
    case FileForm::volume:
      return imaging::is_writable_volume_file(file);
    case FileForm::mesh:
      return imaging::is_writable_mesh_file(file);
    case FileForm::recipe:
      return lower_suffix(file) == ".json";
    case FileForm::segmentation:
      return lower_suffix(file) == ".dcm";
    case FileForm::level_set:
      return lower_suffix(file) == ".vdb";
  }
  return false;
}

std::string suffixes(const std::vector<FileForm>& forms) {
  std::string text;
  for (const FileForm form : forms) {
    text += text.empty() ? "" : " ";
    constexpr const char* kSuffixes[] = {".nii .nii.gz .nrrd .mha", ".stl .ply .obj", ".json", ".dcm",
                                         ".vdb"};
    text += kSuffixes[static_cast<int>(form)];
  }
  return text;
}

std::filesystem::path whole_path(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::weakly_canonical(file, ignored);
}

// Keeps what the libraries that write volumes print on standard error (nifti, MetaIO) off it: an error is one
// line, and ours says the same. No progress is seen while it lives.
class StandardErrorAside {
 public:
  StandardErrorAside() : kept_(::dup(STDERR_FILENO)) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) ::close(nowhere);
  }
  ~StandardErrorAside() {
    if (kept_ < 0) return;
    ::dup2(kept_, STDERR_FILENO);
    ::close(kept_);
  }
  StandardErrorAside(const StandardErrorAside&) = delete;
  StandardErrorAside& operator=(const StandardErrorAside&) = delete;

 private:
  int kept_;
};

// Errors name the file that the user asked for, not the temporary one.
void rename_in_message(std::string& message, const std::string& from, const std::string& to) {
  for (std::size_t at = message.find(from); at != std::string::npos;
       at = message.find(from, at + to.size())) {
    message.replace(at, from.size(), to);
  }
}

}  // namespace

FileForm form_of(const std::filesystem::path& file) {
  for (const FileForm form :
       {FileForm::mesh, FileForm::recipe, FileForm::segmentation, FileForm::level_set}) {
    if (has_form(file, form)) return form;
  }
  return FileForm::volume;
}

Status Outputs::announce_file(const std::string& option, const std::filesystem::path& file) {
  const std::filesystem::path whole = whole_path(file);
  if (std::find(files_.begin(), files_.end(), whole) != files_.end()) {
    return fail(ErrorKind::usage, "{} {}: this file is asked for twice", option, file.string());
  }
  TIDEMARK_TRY(imaging::spare_study_file(file));
  // Tried out and removed again at once: a run that is killed leaves nothing behind.
  auto trial = AtomicFile::create(file);
  if (!trial) return pass_on(trial);
  files_.push_back(whole);
  return {};
}

Status Outputs::announce(const std::string& option, const std::filesystem::path& file,
                         const std::vector<FileForm>& forms) {
  if (std::none_of(forms.begin(), forms.end(), [&](FileForm form) { return has_form(file, form); })) {
    return fail(ErrorKind::usage, "{} {}: the name must end in one of {}", option, file.string(),
                suffixes(forms));
  }
  return announce_file(option, file);
}

Status Outputs::announce_suffix(const std::string& option, const std::filesystem::path& file,
                                const std::string& suffix) {
  if (lower_suffix(file) != suffix) {
    return fail(ErrorKind::usage, "{} {}: the name must end in {}", option, file.string(), suffix);
  }
  return announce_file(option, file);
}

Status Outputs::announce_json(const std::string& option, const std::filesystem::path& file) {
  return announce_suffix(option, file, ".json");
}

Status Outputs::announce_png(const std::string& option, const std::filesystem::path& file) {
  return announce_suffix(option, file, ".png");
}

Status Outputs::announce_gif(const std::string& option, const std::filesystem::path& file) {
  return announce_suffix(option, file, ".gif");
}

Status Outputs::announce_dicom(const std::string& option, const std::filesystem::path& file) {
  return announce_suffix(option, file, ".dcm");
}

Status Outputs::announce_csv(const std::string& option, const std::filesystem::path& file) {
  return announce_suffix(option, file, ".csv");
}

Status Outputs::spare(const std::filesystem::path& input) const {
  const std::filesystem::path whole = whole_path(input);
  if (std::find(files_.begin(), files_.end(), whole) == files_.end()) return {};
  return fail(ErrorKind::usage, "{}: is read and written at once; choose another name for the result",
              input.string());
}

Status Outputs::stage(const std::filesystem::path& file,
                      const std::function<Status(const std::filesystem::path&)>& write) {
  auto staged = AtomicFile::create(file);
  if (!staged) return pass_on(staged);
  Status written;
  {
    std::optional<StandardErrorAside> quiet;
    if (has_form(file, FileForm::volume)) quiet.emplace();
    written = write(staged->temporary_path());
  }
  if (!written) {
    rename_in_message(written.error().message, staged->temporary_path().string(), file.string());
    rename_in_message(written.error().message, staged->temporary_path().filename().string(),
                      file.filename().string());
    return written;
  }
  staged_.push_back(std::move(*staged));
  return {};
}

Status Outputs::commit(const Progress& progress) {
  Status committed = AtomicFile::commit_all(staged_, progress);
  if (!committed && committed.error().kind == ErrorKind::cancelled) return committed;
  if (committed) staged_.clear();
  return exported(std::move(committed), files_);
}

}  // namespace tidemark::cli
