#include "document/autosave.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <utility>

#include "core/atomic_file.h"
#include "core/json/json.h"
#include "core/json/json_field.h"
#include "document/checksum.h"
#include "document/recovery_folder.h"
#include "document/session_file.h"

namespace tidemark::document {
namespace {

constexpr int kGenerations = 2;
constexpr int kSealVersion = 1;
constexpr const char* kSeal = ".sha256";
constexpr std::size_t kLargestSeal = 4096;

std::filesystem::path session_file(const std::filesystem::path& folder, const std::string& case_id,
                                   int slot) {
  return folder / fmt::format("{}.{}.tidemark", case_id, slot);
}
std::filesystem::path seal_of(std::filesystem::path session) {
  return session += kSeal;
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
  const bool known = root.at("version").integer(0, 1 << 30) == kSealVersion;
  const std::int64_t generation = root.at("generation").integer(1, std::int64_t{1} << 62);
  const std::string sum = root.at("sha256").text(64);
  if (!root.good() || !known) return std::nullopt;
  const auto found = sha256_of_file(session);
  if (!found || *found != sum || sum.empty()) return std::nullopt;
  return static_cast<std::uint64_t>(generation);
}

}  // namespace

Result<Autosave> Autosave::create(const std::filesystem::path& folder, const std::string& case_id) {
  auto lock = hold_copy(folder, case_id);
  if (!lock) return pass_on(lock);
  Autosave autosave;
  autosave.folder_ = folder;
  autosave.case_id_ = case_id;
  autosave.lock_ = std::move(*lock);
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
  const Json seal{{"version", kSealVersion}, {"generation", next}, {"sha256", *sum}};
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
  for (const std::string& case_id : left_copies(folder, kSeal)) {
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
    if (!is_copy_id(case_id) || !entry.is_regular_file(error) || entry.is_symlink(error)) continue;
    if (!is_held(folder, case_id)) unfinished.push_back(entry.path());
  }
  for (const auto& file : unfinished) std::filesystem::remove(file, error);
}

void discard(const std::filesystem::path& folder, const std::string& case_id) {
  if (!is_copy_id(case_id)) return;
  std::error_code ignored;
  for (int slot = 0; slot < kGenerations; ++slot) {
    const auto file = session_file(folder, case_id, slot);
    std::filesystem::remove(seal_of(file), ignored);
    std::filesystem::remove(file, ignored);
  }
  remove_hold(folder, case_id);
}

}  // namespace tidemark::document
