// The folder that a retrieval fills.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "imaging/pacs/line.h"
#include "imaging/pacs/pacs.h"

namespace tidemark {

// Objects get names by a counter, nothing of which comes from the peer: 000001.dcm.part while they are
// written, and 000001.dcm once they are found to be sound and of what was asked for. Several connections may
// fill it at once.
class Inbox {
 public:
  // Makes the folder, or takes an empty one. Fails (ErrorKind::write).
  static Result<std::unique_ptr<Inbox>> create(const RetrieveRequest& request, const PacsLimits& limits,
                                               const Progress& progress);
  ~Inbox();  // what was not kept goes away, and the folder with it if it was made here
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;

  // The name for the next object. These fail (ErrorKind::input: the peer sends too much; ErrorKind::write:
  // the disk is full) where the retrieval has to end.
  Result<std::filesystem::path> next_part();
  Status grown(std::int64_t bytes);  // of any object, since the last time

  // An object that is complete. False, with the reason noted, when it is not what was asked for.
  bool take(const std::filesystem::path& part, const std::string& sop_class, const std::string& sop_instance);
  // One that is not to be taken.
  void refuse(const std::filesystem::path& part, std::string reason);

  void set_expected(std::int64_t objects);  // for the progress
  // While objects come on other connections, the one on which they were asked for may be silent.
  void excuse(std::shared_ptr<Line> line);
  // What came; it stays. Fails (ErrorKind::input) when nothing did. `missing` objects could not be sent.
  [[nodiscard]] Result<Retrieved> keep(std::int64_t missing);

 private:
  Inbox(const RetrieveRequest& request, const PacsLimits& limits, const Progress& progress)
      : request_(request), limits_(limits), progress_(progress) {}
  Status check_free_space() const;
  Status look_into(const std::filesystem::path& part, const std::string& sop_class,
                   const std::string& sop_instance) const;
  void note_refusal(const std::filesystem::path& part, std::string reason);

  const RetrieveRequest request_;
  const PacsLimits limits_;
  const Progress progress_;
  std::mutex mutex_;  // guards what follows
  bool made_folder_ = false;
  bool kept_ = false;
  std::int64_t begun_ = 0;
  std::int64_t expected_ = 0;
  std::int64_t bytes_until_look_ = 0;
  std::shared_ptr<Line> excused_;
  std::set<std::filesystem::path> parts_;  // begun and neither taken nor refused
  std::set<std::string> instances_;        // SOP Instance UIDs of what was taken
  Retrieved retrieved_;
};

}  // namespace tidemark
