// Copies of unsaved cases that outlive a crash: two generations each, written in turn.
//
// A generation is a session file and beside it, written after it, its SHA-256: one that was cut off does not
// match, and the older one is offered. A program that ends without finish() leaves them behind; a lock file
// tells the copies of programs that run from those of programs that have died.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/file_lock.h"
#include "document/session_contents.h"

namespace tidemark::document {

// May be used on another thread than its case's, by one thread at a time.
class Autosave {
 public:
  // Makes the folder, for its owner alone. Fails with ErrorKind::write, also when another Autosave writes the
  // case's copies, and with ErrorKind::usage on an id that is none (new_copy_id()).
  static Result<Autosave> create(const std::filesystem::path& folder, const std::string& case_id);

  // The next generation, in place of the one before the last.
  Status write(const SessionContents& contents);
  // The case was closed cleanly: removes its copies.
  void finish();

 private:
  Autosave() = default;
  std::filesystem::path folder_;
  std::string case_id_;
  std::uint64_t generation_ = 0;
  FileLock lock_;
};

// A copy that can be offered.
struct Recoverable {
  std::string case_id;
  std::uint64_t generation = 0;
  std::filesystem::path file;  // for load_session()
  StudyOrigin study;           // the origin of the copied case
};
// The newest valid copy of each case that was not closed cleanly and that no running program has open.
std::vector<Recoverable> find_recoverable(const std::filesystem::path& folder);
// Removes the half-written files of killed programs: temporary files of cases that no running program has
// locked. A case is locked before its first file is made, and no two have the same id, so none of these files
// can still be wanted. Files of other names stay.
void sweep_unfinished(const std::filesystem::path& folder);
// Removes all copies of a case, once they are recovered or not wanted.
void discard(const std::filesystem::path& folder, const std::string& case_id);

}  // namespace tidemark::document
