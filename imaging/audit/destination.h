// The place that audit messages are delivered to.
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "core/result.h"
#include "imaging/audit/configuration.h"

namespace tidemark::imaging {

class AuditDestination {
 public:
  // Fails (ErrorKind::input, ErrorKind::write) naming a certificate, a key or a file that is not usable. A
  // server is called by deliver().
  static Result<std::unique_ptr<AuditDestination>> open(const AuditConfiguration& configuration);
  virtual ~AuditDestination() = default;

  // Takes as long as the server may take. A success means that the server's machine, or the file, has the
  // message; by UDP that it is on its way. Fails naming the destination, within 100 ms of a request to stop.
  virtual Status deliver(const std::string& message, const std::stop_token& stop) = 0;
};

}  // namespace tidemark::imaging
