#include "imaging/audit/event.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace tidemark::imaging {
namespace {

std::mutex sink_mutex;
std::shared_ptr<AuditSink> current_sink;

std::shared_ptr<AuditSink> audit_sink() {
  const std::lock_guard lock(sink_mutex);
  return current_sink;
}

}  // namespace

void add_study(std::vector<AuditedStudy>& studies, const AuditedStudy& study) {
  const auto known = std::find_if(studies.begin(), studies.end(),
                                  [&](const AuditedStudy& one) { return one.is_same_study(study); });
  if (known == studies.end()) return studies.push_back(study);
  for (const auto& [sop_class, count] : study.objects) known->objects[sop_class] += count;
}

void set_audit_sink(std::shared_ptr<AuditSink> sink) {
  const std::lock_guard lock(sink_mutex);
  current_sink = std::move(sink);
}

void record_audit(const AuditEvent& event) {
  if (const auto sink = audit_sink()) sink->take(event);
}

void record_audit(AuditEvent event, const std::vector<AuditedStudy>& studies) {
  for (const AuditedStudy& study : studies) {
    event.study = study;
    record_audit(event);
  }
}

std::string failure_of(const Status& status) {
  return status ? std::string() : status.error().message;
}

Status exported(Status status, const AuditedStudy& study, const std::vector<std::filesystem::path>& files) {
  AuditedStudy of_files = study;
  of_files.objects.clear();  // the files are results, not the images that they were made of
  record_audit({.kind = AuditEvent::Kind::exported,
                .study = std::move(of_files),
                .failure = failure_of(status),
                .files = files});
  return status;
}

}  // namespace tidemark::imaging
