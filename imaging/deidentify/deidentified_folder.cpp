#include "imaging/deidentify/deidentified_folder.h"

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

#include "core/csv.h"
#include "core/json/json.h"
#include "core/json/json_text.h"
#include "core/lies_in.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string_view word_of(Change change) {
  return kChangeNames[static_cast<std::size_t>(change)];
}

std::string list_as_csv(const Deidentified& result) {
  std::string text = csv_line({"file", "attribute", "keyword", "change"});
  for (const DeidentifiedFile& file : result.files) {
    for (const ChangedAttribute& one : file.changes) {
      text += csv_line(
          {csv_text(file.name), csv_text(one.path), csv_text(one.keyword), std::string(word_of(one.change))});
    }
  }
  return text;
}

std::string list_as_json(const Deidentified& result) {
  Json list;
  list["files"] = Json::array();
  for (const DeidentifiedFile& file : result.files) {
    Json changes = Json::array();
    for (const ChangedAttribute& one : file.changes) {
      changes.push_back({{"attribute", one.path}, {"keyword", one.keyword}, {"change", word_of(one.change)}});
    }
    list["files"].push_back({{"file", file.name}, {"changes", std::move(changes)}});
  }
  return json_text(list);
}

std::string key_text(const Deidentified& result) {
  Json key;
  key["patients"] = Json::array();
  for (const auto& [old, pseudonym] : result.patients) {
    key["patients"].push_back(
        {{"old", old}, {"id", pseudonym.id}, {"name", pseudonym.name}, {"days", pseudonym.days}});
  }
  key["uids"] = Json::array();
  for (const auto& [old, uid] : result.uids) key["uids"].push_back({{"old", old}, {"new", uid}});
  key["files"] = Json::array();
  for (const DeidentifiedFile& file : result.files) {
    key["files"].push_back({{"old", file.source.string()}, {"new", file.name}});
  }
  return json_text(key);
}

enum class Readers { all, owner };

// To be committed. It is for its owner alone before anything is in it.
Result<AtomicFile> staged(const fs::path& file, const std::string& text, Readers readers) {
  auto made = AtomicFile::create(file);
  if (!made) return made;
  std::error_code error;
  if (readers == Readers::owner)
    fs::permissions(made->temporary_path(), fs::perms::owner_read | fs::perms::owner_write, error);
  std::ofstream out(made->temporary_path(), std::ios::binary | std::ios::trunc);
  if (!error && out.write(text.data(), static_cast<std::streamsize>(text.size())).flush()) return made;
  return fail(ErrorKind::write, "{}: cannot write", file.string());
}

}  // namespace

Status check_places(const DeidentifyPlaces& places) {
  const std::string folder = places.folder.string();
  if (lies_in(places.folder, places.source) || lies_in(places.source, places.folder)) {
    return fail(ErrorKind::usage, "{}: is the source of the copies, lies in it or holds it", folder);
  }
  std::error_code error;
  const bool is_free = !fs::exists(places.folder, error) ||
                       (fs::is_directory(places.folder, error) && fs::is_empty(places.folder, error));
  if (!is_free) return fail(ErrorKind::usage, "{}: is there and not empty", folder);
  for (const fs::path& file : {places.list, places.key}) {
    if (!file.empty() && (lies_in(file, places.folder) || lies_in(file, places.source))) {
      return fail(ErrorKind::usage, "{}: lies among the copies or in their source", file.string());
    }
  }
  if (!places.key.empty() && fs::exists(places.key, error)) {
    return fail(ErrorKind::usage, "{}: is there, and a key is not overwritten", places.key.string());
  }
  return {};
}

Result<Deidentified> write_deidentified(const std::vector<fs::path>& files, const DeidentifyPlaces& places,
                                        DeidentifyOptions options, const Progress& progress) {
  TIDEMARK_TRY(check_places(places));
  if (!places.list.empty()) options.record = RecordedChanges::each;
  auto result = deidentify(files, places.folder, options, progress);
  if (!result) return result;
  // The key first: without it there is no way back from the folder.
  std::vector<std::pair<AtomicFile, fs::path>> records;
  const auto add = [&](const fs::path& file, const std::string& text, Readers readers) -> Status {
    auto record = staged(file, text, readers);
    if (!record) return pass_on(record);
    records.emplace_back(std::move(*record), file);
    return {};
  };
  if (!places.key.empty()) {
    TIDEMARK_TRY(add(places.key, key_text(*result), Readers::owner));
  }
  if (!places.list.empty()) {
    const bool is_table = places.list.extension() == ".csv";
    TIDEMARK_TRY(add(places.list, is_table ? list_as_csv(*result) : list_as_json(*result), Readers::all));
  }
  if (progress.cancelled()) return cancelled_error();
  TIDEMARK_TRY(check_places(places));  // minutes have passed
  Status committed;
  std::vector<fs::path> written;
  for (std::size_t i = 0; i < records.size() && committed; ++i) {
    committed = records[i].first.commit();
    if (committed) written.push_back(records[i].second);
  }
  if (committed) committed = result->folder.commit();
  record_audit({.kind = AuditEvent::Kind::exported,
                .failure = failure_of(committed),
                .files = {fs::absolute(places.folder)},
                .is_deidentified = true},
               result->studies);
  if (committed) return result;
  std::error_code ignored;
  for (const fs::path& file : written) fs::remove(file, ignored);
  return pass_on(committed);
}

}  // namespace tidemark::imaging
