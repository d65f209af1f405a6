// The messages that wait to be delivered, in a folder of the user's, in their order.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace tidemark::imaging {

// A file for each message, for its owner alone. A message is on the disk when add() returns, so that it
// outlives the program, however that ends. All programs of a user share the folder.
class AuditSpool {
 public:
  // Makes the folder. Fails (ErrorKind::write).
  static Result<AuditSpool> open(const std::filesystem::path& folder, std::size_t most);

  // Fails (ErrorKind::capability) where as many wait as may, and with ErrorKind::write. May be called from
  // any thread, and in a copy of this process.
  Status add(const std::string& message) const;

  // Oldest first.
  [[nodiscard]] std::vector<std::filesystem::path> waiting() const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  AuditSpool(std::filesystem::path folder, std::size_t most) : folder_(std::move(folder)), most_(most) {}

  std::filesystem::path folder_;
  std::size_t most_;
};

}  // namespace tidemark::imaging
