#include "document/autosave.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <utility>

#include "core/atomic_file.h"
#include "core/json/json.h"
#include "core/json/json_field.h"
#include "document/checksum.h"
#include "document/session_file.h"

namespace tidemark::document {
namespace {

constexpr int kGenerations = 2;
constexpr int kVersion = 1;
constexpr const char* kSeal = ".sha256";
constexpr std::size_t kLargestSeal = 4096;

std::filesystem::path lock_file(const std::filesystem::path& folder, const std::string& case_id) {
  return folder / (case_id + ".lock");
}
std::filesystem::path session_file(const std::filesystem::path& folder, const std::string& case_id,
                                   int slot) {
  return folder / fmt::format("{}.{}.tidemark", case_id, slot);
}
std::filesystem::path seal_of(std::filesystem::path session) {
  return session += kSeal;
}

bool is_case_id(const std::string& id) {
  const auto allowed = [](unsigned char c) { return c < 128 && (std::isalnum(c) != 0 || c == '-'); };
  return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), allowed);
}

Status make_private_folder(const std::filesystem::path& folder) {
  const auto refuse = [&](const char* why) {
    return fail(ErrorKind::write, "{}: cannot be used for recovery: {}", folder.string(), why);
  };
  std::error_code error;
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path(), error);
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) return refuse(std::strerror(errno));
  struct stat found {};
  if (::lstat(folder.c_str(), &found) != 0) return refuse(std::strerror(errno));
  if (!S_ISDIR(found.st_mode)) return refuse("not a folder");
  if (found.st_uid != ::geteuid()) return refuse("it is somebody else's");
  if ((found.st_mode & 0777U) != 0700U && ::chmod(folder.c_str(), 0700) != 0)
    return refuse(std::strerror(errno));
  return {};
}

bool is_locked(const std::filesystem::path& file) {
  return std::filesystem::exists(std::filesystem::symlink_status(file)) && !FileLock::take(file);
}

// The generation of a copy that is whole.
std::optional<std::uint64_t> valid_generation(const std::filesystem::path& session) {
  std::ifstream stream(seal_of(session), std::ios::binary);
  std::string text(kLargestSeal + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  const auto json = JsonDocument::parse(text, session.string(), {.bytes = kLargestSeal, .depth = 2});
  if (!json) return std::nullopt;
  const JsonField root = root_of(*json, session.string());
  const bool known = root.at("version").integer(0, 1 << 30) == kVersion;
  const std::int64_t generation = root.at("generation").integer(1, std::int64_t{1} << 62);
  const std::string sum = root.at("sha256").text(64);
  if (!root.good() || !known) return std::nullopt;
  const auto found = sha256_of_file(session);
  if (!found || *found != sum || sum.empty()) return std::nullopt;
  return static_cast<std::uint64_t>(generation);
}

}  // namespace

std::string Autosave::new_case_id() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

Result<Autosave> Autosave::create(const std::filesystem::path& folder, const std::string& case_id) {
  if (!is_case_id(case_id)) return fail(ErrorKind::usage, "'{}' names no case", case_id);
  TIDEMARK_TRY(make_private_folder(folder));
  Autosave autosave;
  autosave.folder_ = folder;
  autosave.case_id_ = case_id;
  autosave.lock_ = FileLock::take(lock_file(folder, case_id), FileLock::Missing::make);
  if (!autosave.lock_) {
    return fail(ErrorKind::write, "{}: cannot be locked", lock_file(folder, case_id).string());
  }
  for (int slot = 0; slot < kGenerations; ++slot) {
    const auto there = valid_generation(session_file(folder, case_id, slot));
    autosave.generation_ = std::max(autosave.generation_, there.value_or(0));
  }
  return autosave;
}

Status Autosave::write(const SessionContents& contents) {
  const std::uint64_t next = generation_ + 1;
  const auto file = session_file(folder_, case_id_, static_cast<int>(next % kGenerations));
  TIDEMARK_TRY(write_session(contents, file, InFile::no_history));
  auto sum = sha256_of_file(file);
  if (!sum) return pass_on(sum);
  const Json seal{{"version", kVersion}, {"generation", next}, {"sha256", *sum}};
  TIDEMARK_TRY(write_file(seal_of(file), seal.dump()));
  generation_ = next;
  return {};
}

void Autosave::finish() {
  discard(folder_, case_id_);
  lock_ = FileLock();
}

std::vector<Recoverable> find_recoverable(const std::filesystem::path& folder) {
  std::vector<Recoverable> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const std::string case_id = name.substr(0, name.find('.'));
    const auto same = [&](const Recoverable& one) { return one.case_id == case_id; };
    if (!is_case_id(case_id) || !name.ends_with(kSeal)) continue;
    if (std::any_of(found.begin(), found.end(), same) || is_locked(lock_file(folder, case_id))) continue;
    Recoverable newest{case_id, 0, {}, {}};
    for (int slot = 0; slot < kGenerations; ++slot) {
      const auto file = session_file(folder, case_id, slot);
      const auto generation = valid_generation(file);
      if (generation && *generation > newest.generation) newest = {case_id, *generation, file, {}};
    }
    if (newest.generation == 0) continue;
    if (auto study = load_origin(newest.file)) newest.study = std::move(*study);
    found.push_back(std::move(newest));
  }
  return found;
}

void sweep_unfinished(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> unfinished;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string target = AtomicFile::target_of(entry.path());
    const std::string case_id = target.substr(0, target.find('.'));
    if (!is_case_id(case_id) || !entry.is_regular_file(error) || entry.is_symlink(error)) continue;
    if (!is_locked(lock_file(folder, case_id))) unfinished.push_back(entry.path());
  }
  for (const auto& file : unfinished) std::filesystem::remove(file, error);
}

void discard(const std::filesystem::path& folder, const std::string& case_id) {
  if (!is_case_id(case_id)) return;
  std::error_code ignored;
  for (int slot = 0; slot < kGenerations; ++slot) {
    const auto file = session_file(folder, case_id, slot);
    std::filesystem::remove(seal_of(file), ignored);
    std::filesystem::remove(file, ignored);
  }
  std::filesystem::remove(lock_file(folder, case_id), ignored);
}

}  // namespace tidemark::document
