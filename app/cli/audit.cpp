#include "app/cli/audit.h"

#include <chrono>
#include <utility>

namespace tidemark::cli {
namespace {

std::weak_ptr<CommandAudit> current_audit;

}  // namespace

Result<std::shared_ptr<CommandAudit>> CommandAudit::begin(Console& console) {
  // What waits is said at the end; what is lost, at once.
  const auto tell = [&console](const Error& notice) {
    if (notice.kind != ErrorKind::input) console.warn(notice.message);
  };
  auto log = imaging::AuditLog::start_if_wanted("tidemark-cli", tell);
  if (!log) return pass_on(log);
  if (*log == nullptr) return std::shared_ptr<CommandAudit>();
  std::shared_ptr<CommandAudit> audit(new CommandAudit(std::move(*log)));
  imaging::set_audit_sink(audit);
  current_audit = audit;
  return audit;
}

void CommandAudit::take(const imaging::AuditEvent& event) {
  using Kind = imaging::AuditEvent::Kind;
  if ((event.kind == Kind::accessed || event.kind == Kind::imported) && event.failure.empty()) {
    const std::lock_guard lock(mutex_);
    add_study(opened_, event.study);
  }
  log_->take(event);
}

std::vector<imaging::AuditedStudy> CommandAudit::opened() {
  const std::lock_guard lock(mutex_);
  return opened_;
}

std::vector<imaging::AuditedStudy> audited_studies() {
  const auto audit = current_audit.lock();
  return audit != nullptr ? audit->opened() : std::vector<imaging::AuditedStudy>();
}

Status exported(Status status, const std::vector<std::filesystem::path>& files) {
  for (const imaging::AuditedStudy& study : audited_studies()) {
    status = imaging::exported(std::move(status), study, files);
  }
  return status;
}

void CommandAudit::finish(Console& console) {
  constexpr std::chrono::seconds kPatience(2);
  const imaging::AuditLog::Left left = log_->finish(kPatience, console.progress().stop);
  imaging::set_audit_sink(nullptr);
  if (left.messages == 0 || console.interrupted()) return;
  console.warn(fmt::format("{} audit messages wait to be delivered{}{}", left.messages,
                           left.reason.empty() ? "" : ": ", left.reason));
}

}  // namespace tidemark::cli
