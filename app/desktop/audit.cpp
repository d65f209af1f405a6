#include "app/desktop/audit.h"

#include <QCoreApplication>
#include <chrono>
#include <utility>

#include "engine/background_job.h"
#include "imaging/audit/audit_log.h"

namespace tidemark::desktop {

Status Audit::begin() {
  const auto tell = [tell = tell_](const Error& notice) {
    QMetaObject::invokeMethod(
        QCoreApplication::instance(), [tell, notice] { tell(notice); }, Qt::QueuedConnection);
  };
  auto log = imaging::AuditLog::start_if_wanted("tidemark", tell);
  if (!log) return pass_on(log);
  log_ = std::move(*log);
  imaging::set_audit_sink(log_);
  return {};
}

Audit::~Audit() {
  if (log_) engine::BackgroundJob::finish_all(std::chrono::seconds(5));
  imaging::set_audit_sink(nullptr);
  if (log_) log_->finish(std::chrono::seconds(1));
}

}  // namespace tidemark::desktop
