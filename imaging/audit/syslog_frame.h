// Syslog messages (RFC 5424) with an audit message in them.
#pragma once

#include <string>

#include "imaging/audit/message.h"

namespace tidemark::imaging {

// HEADER, no STRUCTURED-DATA, and the message: facility 10 and severity 5, or 4 after a failure (DICOM PS3.15
// A.6 and A.7), MSGID "DICOM+RFC3881".
[[nodiscard]] std::string syslog_message(const AuditEvent& event, const AuditOrigin& origin);

// For a stream: the number of bytes, and the message (RFC 5425 4.3).
[[nodiscard]] std::string counted_frame(const std::string& message);

}  // namespace tidemark::imaging
