// The audit log of one command.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "app/cli/console.h"
#include "imaging/audit/audit_log.h"

namespace tidemark::cli {

// What a command writes is of the studies that it has opened: an export that names no study is one of each of
// them.
class CommandAudit final : public imaging::AuditSink {
 public:
  // Null where nothing is audited. Fails where it is wanted and does not work. It ends with finish().
  static Result<std::shared_ptr<CommandAudit>> begin(Console& console);

  void take(const imaging::AuditEvent& event) override;

  // Waits at most two seconds for the deliveries, and warns of messages that wait. Not after an interrupt.
  void finish(Console& console);

 private:
  explicit CommandAudit(std::shared_ptr<imaging::AuditLog> log) : log_(std::move(log)) {}

  const std::shared_ptr<imaging::AuditLog> log_;
  std::mutex mutex_;
  std::vector<imaging::AuditedStudy> opened_;
};

}  // namespace tidemark::cli
