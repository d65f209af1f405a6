// The text of an audit message (DICOM PS3.15 A.5, Audit Trail Message Format Profile).
#pragma once

#include <string>

#include "imaging/audit/event.h"

namespace tidemark::imaging {

// Who audits: the same for all messages of a program.
struct AuditOrigin {
  std::string program;     // "tidemark-cli"
  std::string process_id;  // "4711"
  std::string login;       // of the user
  std::string user_name;   // as the system knows it: "Jane Doe"; may be empty
  std::string host;        // of this machine
  std::string site;        // AuditEnterpriseSiteID; may be empty
  std::string source;      // AuditSourceID

  // Of this process. Login and host have a word of their own where the system has none.
  static AuditOrigin of_this_process(std::string program);
};

// The element AuditMessage, on one line, in UTF-8. No message has more than 32 KiB, which repositories have
// to take (A.6): longer values are cut.
[[nodiscard]] std::string audit_message(const AuditEvent& event, const AuditOrigin& origin);

// Any text as the value of an attribute of XML 1.0: in UTF-8, escaped. Characters that XML cannot hold, and
// bytes that are no UTF-8, become U+FFFD.
[[nodiscard]] std::string xml_text(const std::string& text);

// "2026-07-31T12:00:00.000000Z"
[[nodiscard]] std::string utc_text(std::chrono::system_clock::time_point time);

}  // namespace tidemark::imaging
