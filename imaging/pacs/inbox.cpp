#include "imaging/pacs/inbox.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "imaging/pacs/checked_object.h"

namespace tidemark {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kBytesBetweenLooks = std::int64_t{16} << 20;  // at the disk's free space
constexpr std::size_t kMostReasons = 20;
constexpr const char* kPart = ".part";

}  // namespace

Result<std::unique_ptr<Inbox>> Inbox::create(const RetrieveRequest& request, const PacsLimits& limits,
                                             const Progress& progress) {
  std::unique_ptr<Inbox> inbox(new Inbox(request, limits, progress));
  std::error_code error;
  const std::string folder = request.folder.string();
  if (fs::exists(request.folder, error)) {
    if (!fs::is_directory(request.folder, error) || !fs::is_empty(request.folder, error)) {
      return fail(ErrorKind::write, "{}: cannot be filled: it is no empty folder", folder);
    }
  } else {
    fs::create_directories(request.folder, error);
    inbox->made_folder_ = !error;
  }
  if (error) return fail(ErrorKind::write, "{}: cannot be made: {}", folder, error.message());
  if (Status enough = inbox->check_free_space(); !enough) return pass_on(enough);
  return inbox;
}

Inbox::~Inbox() {
  std::error_code ignored;
  for (const fs::path& part : parts_) fs::remove(part, ignored);
  if (kept_) return;
  for (const fs::path& file : retrieved_.files) fs::remove(file, ignored);
  if (made_folder_) fs::remove(request_.folder, ignored);
}

Status Inbox::check_free_space() const {
  std::error_code error;
  const fs::space_info space = fs::space(request_.folder, error);
  if (!error && space.available >= static_cast<std::uintmax_t>(limits_.free_bytes)) return {};
  return fail(ErrorKind::write, "{}: the disk is nearly full: less than {} MiB would stay free",
              request_.folder.string(), limits_.free_bytes >> 20);
}

Result<fs::path> Inbox::next_part() {
  const std::lock_guard lock(mutex_);
  if (begun_ >= limits_.objects) {
    return fail(ErrorKind::input, "the server sends more than the {} objects that are allowed",
                limits_.objects);
  }
  const fs::path part = request_.folder / fmt::format("{:06}.dcm{}", ++begun_, kPart);
  parts_.insert(part);
  return part;
}

Status Inbox::grown(std::int64_t bytes) {
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

Status Inbox::look_into(const fs::path& part, const std::string& sop_class,
                        const std::string& sop_instance) const {
  const auto identity = check_object(part);
  if (!identity) {
    // The name says nothing to anybody.
    std::string reason = identity.error().message;
    if (const std::string prefix = part.string() + ": "; reason.starts_with(prefix))
      reason.erase(0, prefix.size());
    return fail(ErrorKind::input, "{}", reason);
  }
  if (identity->sop_class != sop_class || identity->sop_instance != sop_instance) {
    return fail(ErrorKind::input, "is another object than was announced");
  }
  if (identity->study != request_.study_uid) return fail(ErrorKind::input, "belongs to another study");
  if (!request_.series_uid.empty() && identity->series != request_.series_uid) {
    return fail(ErrorKind::input, "belongs to another series");
  }
  return {};
}

bool Inbox::take(const fs::path& part, const std::string& sop_class, const std::string& sop_instance) {
  const Status sound = look_into(part, sop_class, sop_instance);
  const std::lock_guard lock(mutex_);
  if (!sound) {
    note_refusal(part, sound.error().message);
    return false;
  }
  if (!instances_.insert(sop_instance).second) {
    note_refusal(part, "came a second time");
    return true;  // the server may believe that it is here: it is
  }
  fs::path file = part;
  file.replace_extension();
  std::error_code error;
  fs::rename(part, file, error);
  if (error) {
    note_refusal(part, error.message());
    return false;
  }
  parts_.erase(part);
  retrieved_.files.push_back(std::move(file));
  const auto done = static_cast<double>(retrieved_.files.size());
  progress_(expected_ > 0 ? std::min(1.0, done / static_cast<double>(expected_)) : -1.0, "receiving objects");
  return true;
}

void Inbox::refuse(const fs::path& part, std::string reason) {
  const std::lock_guard lock(mutex_);
  note_refusal(part, std::move(reason));
}

void Inbox::note_refusal(const fs::path& part, std::string reason) {
  std::error_code ignored;
  fs::remove(part, ignored);
  parts_.erase(part);
  // Which of the objects that came: its name without .dcm.part.
  const std::string number = part.stem().stem().string();
  if (retrieved_.refused.size() < kMostReasons) {
    retrieved_.refused.push_back(fmt::format("object {}: {}", number, reason));
  } else {
    retrieved_.refused.resize(kMostReasons + 1);
    retrieved_.refused.back() = "and others";
  }
}

void Inbox::set_expected(std::int64_t objects) {
  const std::lock_guard lock(mutex_);
  expected_ = std::max(expected_, objects);
}

void Inbox::excuse(std::shared_ptr<Line> line) {
  const std::lock_guard lock(mutex_);
  excused_ = std::move(line);
}

Result<Retrieved> Inbox::keep(std::int64_t missing) {
  const std::lock_guard lock(mutex_);
  if (retrieved_.files.empty()) {
    if (!retrieved_.refused.empty())
      return fail(ErrorKind::input, "nothing of what came can be taken: {}", retrieved_.refused.front());
    if (missing > 0) return fail(ErrorKind::input, "none of {} objects could be sent by the server", missing);
    return fail(ErrorKind::input, "the server has nothing of the study or series that is asked for");
  }
  kept_ = true;
  retrieved_.missing = missing;
  std::sort(retrieved_.files.begin(), retrieved_.files.end());
  return retrieved_;
}

}  // namespace tidemark
