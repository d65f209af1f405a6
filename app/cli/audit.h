// The audit log of one command.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "app/cli/console.h"
#include "imaging/audit/audit_log.h"

namespace tidemark::cli {

// It remembers the studies that the command has opened: what the command writes is of them.
class CommandAudit final : public imaging::AuditSink {
 public:
  // Null where nothing is audited. Fails where it is wanted and does not work. It ends with finish().
  static Result<std::shared_ptr<CommandAudit>> begin(Console& console);

  void take(const imaging::AuditEvent& event) override;
  [[nodiscard]] std::vector<imaging::AuditedStudy> opened();

  // Waits at most two seconds for the deliveries, and warns of messages that wait. Not after an interrupt.
  void finish(Console& console);

 private:
  explicit CommandAudit(std::shared_ptr<imaging::AuditLog> log) : log_(std::move(log)) {}

  const std::shared_ptr<imaging::AuditLog> log_;
  std::mutex mutex_;
  std::vector<imaging::AuditedStudy> opened_;
};

// The studies that the command has opened, where it is audited.
std::vector<imaging::AuditedStudy> audited_studies();

// Records that files were written, or could not be, of all studies that the command has opened, and hands
// `status` on.
Status exported(Status status, const std::vector<std::filesystem::path>& files);

}  // namespace tidemark::cli
