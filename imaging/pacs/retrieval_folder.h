// The folder that a retrieval fills.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/atomic_file.h"
#include "core/progress.h"
#include "core/result.h"
#include "imaging/pacs/checked_object.h"
#include "imaging/pacs/services.h"
#include "imaging/web/connection_watch.h"

namespace tidemark::imaging {

// Objects are collected beside the folder under a temporary name, and are in it when all have come: a program
// that is killed before leaves no series that lacks slices. Their names are counted, 000001.dcm, and
// hold nothing from the peer. Several connections may fill it at once.
class RetrievalFolder {
 public:
  // For a folder that is not there yet, or empty. Fails (ErrorKind::write).
  static Result<std::unique_ptr<RetrievalFolder>> create(const RetrieveRequest& request,
                                                         const PacsLimits& limits, const Progress& progress);

  // The folder's name in messages.
  [[nodiscard]] const std::filesystem::path& folder() const { return request_.folder; }

  // Where the next object is written to. These fail (ErrorKind::input: the peer sends too much;
  // ErrorKind::write: the disk is full) where the retrieval has to end.
  Result<std::filesystem::path> next_object();
  Status grown(std::int64_t bytes);  // of any object, since the last time

  // Takes an object that is complete. False, with the reason noted, when it was not asked for, or is another
  // than was announced (where it was).
  struct Announced {
    std::string sop_class;
    std::string sop_instance;
  };
  bool take(const std::filesystem::path& object, const std::optional<Announced>& announced = {});
  // Refuses an object.
  void refuse(const std::filesystem::path& object, const std::string& reason);

  void set_expected(std::int64_t objects);  // for the progress
  // While objects come on other connections, the one on which they were asked for may be silent.
  void excuse(std::shared_ptr<ConnectionWatch> watch);
  // Puts the objects in place. Fails when none has come (ErrorKind::input), or they cannot be put there
  // (ErrorKind::write). `missing` objects could not be sent.
  [[nodiscard]] Result<Retrieved> keep(std::int64_t missing);

 private:
  RetrievalFolder(const RetrieveRequest& request, const PacsLimits& limits, const Progress& progress,
                  AtomicFolder collected)
      : request_(request), limits_(limits), progress_(progress), collected_(std::move(collected)) {}
  Status check_free_space() const;
  // Why an object is not wanted; empty: it is.
  [[nodiscard]] std::string objection_to(const ObjectIdentity& identity,
                                         const std::optional<Announced>& announced) const;
  // Returns the line that says so.
  std::string note_refusal(const std::filesystem::path& object, const std::string& reason);

  const RetrieveRequest request_;
  const PacsLimits limits_;
  const Progress progress_;
  AtomicFolder collected_;
  std::mutex mutex_;  // guards what follows
  std::int64_t begun_ = 0;
  std::int64_t expected_ = 0;
  std::int64_t bytes_until_look_ = 0;
  std::shared_ptr<ConnectionWatch> excused_;
  std::set<std::filesystem::path> unfinished_;  // begun and neither taken nor refused
  std::set<std::string> instances_;             // SOP Instance UIDs of the objects taken
  Retrieved retrieved_;
};

}  // namespace tidemark::imaging
