#include "imaging/pacs/retrieval_folder.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "imaging/guard/guarded.h"
#include "imaging/pacs/checked_object.h"
#include "imaging/pacs/storage_classes.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kBytesBetweenLooks = std::int64_t{16} << 20;  // at the disk's free space
constexpr std::size_t kMostReasons = 20;

// Files of the user must not be replaced.
Status require_empty(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return {};
  if (fs::is_directory(folder, error) && fs::is_empty(folder, error)) return {};
  return fail(ErrorKind::write, "{}: cannot be filled: it is no empty folder", folder.string());
}

}  // namespace

Result<std::unique_ptr<RetrievalFolder>> RetrievalFolder::create(const RetrieveRequest& request,
                                                                 const PacsLimits& limits,
                                                                 const Progress& progress) {
  TIDEMARK_TRY(require_empty(request.folder));
  auto collected = AtomicFolder::create(request.folder);
  if (!collected) return pass_on(collected);
  std::unique_ptr<RetrievalFolder> retrieval_folder(
      new RetrievalFolder(request, limits, progress, std::move(*collected)));
  TIDEMARK_TRY(retrieval_folder->check_free_space());
  return retrieval_folder;
}

Status RetrievalFolder::check_free_space() const {
  std::error_code error;
  const fs::space_info space = fs::space(collected_.temporary_path(), error);
  if (!error && space.available >= static_cast<std::uintmax_t>(limits_.free_bytes)) return {};
  return fail(ErrorKind::write, "{}: the disk is nearly full: less than {} MiB would stay free",
              request_.folder.string(), limits_.free_bytes >> 20);
}

Result<fs::path> RetrievalFolder::next_object() {
  const std::lock_guard lock(mutex_);
  if (begun_ >= limits_.objects) {
    return fail(ErrorKind::input, "the server sends more than the {} objects that are allowed",
                limits_.objects);
  }
  const fs::path object = collected_.temporary_path() / fmt::format("{:06}.dcm", ++begun_);
  unfinished_.insert(object);
  return object;
}

Status RetrievalFolder::grown(std::int64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (excused_) excused_->completed_message();
  retrieved_.bytes += bytes;
  if (retrieved_.bytes > limits_.retrieval_bytes) {
    return fail(ErrorKind::input, "the server sends more than the {} MiB that are allowed",
                limits_.retrieval_bytes >> 20);
  }
  bytes_until_look_ -= bytes;
  if (bytes_until_look_ > 0) return {};
  bytes_until_look_ = kBytesBetweenLooks;
  return check_free_space();
}

std::string RetrievalFolder::objection_to(const ObjectIdentity& identity,
                                          const std::optional<Announced>& announced) const {
  if (!is_storage_class(identity.sop_class)) return "is of a class that was not asked for";
  if (announced &&
      (identity.sop_class != announced->sop_class || identity.sop_instance != announced->sop_instance)) {
    return "is another object than was announced";
  }
  if (identity.study != request_.study_uid) return "belongs to another study";
  if (!request_.series_uid.empty() && identity.series != request_.series_uid) {
    return "belongs to another series";
  }
  return {};
}

bool RetrievalFolder::take(const fs::path& object, const std::optional<Announced>& announced) {
  const auto identity = check_object(object);
  const std::string objection = identity ? objection_to(*identity, announced) : std::string();
  const bool is_damaged = !identity || (objection.empty() && !sync_to_disk(object));
  const std::lock_guard lock(mutex_);
  if (is_damaged) {
    // Without the file's name, which is only a number.
    const std::string told =
        note_refusal(object, identity ? "cannot be written" : without_path(identity.error().message, object));
    if (retrieved_.damaged.empty()) retrieved_.damaged = told;
    return false;
  }
  if (!objection.empty()) {
    note_refusal(object, objection);
    return false;
  }
  if (!instances_.insert(identity->sop_instance).second) {
    note_refusal(object, "came a second time");
    return true;  // the server may believe that it is here: it is
  }
  unfinished_.erase(object);
  add_study(retrieved_.studies, identity->audited);
  retrieved_.files.push_back(request_.folder / object.filename());
  const auto done = static_cast<double>(retrieved_.files.size());
  progress_(expected_ > 0 ? std::min(1.0, done / static_cast<double>(expected_)) : -1.0, "receiving objects");
  return true;
}

void RetrievalFolder::refuse(const fs::path& object, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  note_refusal(object, reason);
}

std::string RetrievalFolder::note_refusal(const fs::path& object, const std::string& reason) {
  std::error_code ignored;
  fs::remove(object, ignored);
  unfinished_.erase(object);
  // By its number among the objects that came.
  std::string told = fmt::format("object {}: {}", object.stem().string(), reason);
  if (retrieved_.refused.size() < kMostReasons) {
    retrieved_.refused.push_back(told);
  } else {
    retrieved_.refused.resize(kMostReasons + 1);
    retrieved_.refused.back() = "and others";
  }
  return told;
}

void RetrievalFolder::set_expected(std::int64_t objects) {
  const std::lock_guard lock(mutex_);
  expected_ = std::max(expected_, objects);
}

void RetrievalFolder::excuse(std::shared_ptr<ConnectionWatch> watch) {
  const std::lock_guard lock(mutex_);
  excused_ = std::move(watch);
}

Result<Retrieved> RetrievalFolder::keep(std::int64_t missing) {
  const std::lock_guard lock(mutex_);
  if (retrieved_.files.empty()) {
    if (!retrieved_.refused.empty())
      return fail(ErrorKind::input, "none of the objects that came can be taken: {}",
                  retrieved_.refused.front());
    if (missing > 0) return fail(ErrorKind::input, "none of {} objects could be sent by the server", missing);
    return fail(ErrorKind::input, "the server has nothing of the study or series that is asked for");
  }
  std::error_code ignored;
  for (const fs::path& object : unfinished_) fs::remove(object, ignored);
  TIDEMARK_TRY(require_empty(request_.folder));
  TIDEMARK_TRY(collected_.commit());
  retrieved_.missing = missing;
  std::sort(retrieved_.files.begin(), retrieved_.files.end());
  return retrieved_;
}

}  // namespace tidemark::imaging
