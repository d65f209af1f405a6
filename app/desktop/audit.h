// The audit log of the desktop.
#pragma once

#include <functional>
#include <memory>

#include "core/result.h"

namespace tidemark::imaging {
class AuditLog;
}

namespace tidemark::desktop {

// Audits while it lives, if that is wanted. There is a QCoreApplication all the time.
class Audit {
 public:
  // Gets a sentence for the user, on the thread of the user interface: messages wait, or are lost.
  using Tell = std::function<void(const Error& notice)>;
  explicit Audit(Tell tell) : tell_(std::move(tell)) {}
  // Waits at most 5 s for jobs of the background: what they still write is audited, too. Then it waits at
  // most a second for the deliveries; the rest waits for the next start.
  ~Audit();
  Audit(const Audit&) = delete;
  Audit& operator=(const Audit&) = delete;

  // Fails where it is wanted and does not work.
  Status begin();

 private:
  const Tell tell_;
  std::shared_ptr<imaging::AuditLog> log_;
};

}  // namespace tidemark::desktop
