#include "imaging/audit/syslog_frame.h"

namespace tidemark::imaging {
namespace {

// A field of the header: printable ASCII without blanks, of a limited length; "-" where nothing is left.
std::string header_field(const std::string& text, std::size_t most) {
  std::string field;
  for (const char c : text.substr(0, most)) field += c > 0x20 && c < 0x7f ? c : '_';
  return field.empty() ? "-" : field;
}

}  // namespace

std::string syslog_message(const AuditEvent& event, const AuditOrigin& origin) {
  constexpr int kFacility = 10;  // security and authorization
  constexpr int kNotice = 5;
  constexpr int kWarning = 4;
  constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";  // RFC 5424 6.4: the text is UTF-8
  return fmt::format("<{}>1 {} {} {} {} DICOM+RFC3881 - {}{}",
                     8 * kFacility + (event.failure.empty() ? kNotice : kWarning), utc_text(event.time),
                     header_field(origin.host, 255), header_field(origin.program, 48),
                     header_field(origin.process_id, 128), kByteOrderMark, audit_message(event, origin));
}

std::string counted_frame(const std::string& message) {
  return fmt::format("{} {}", message.size(), message);
}

}  // namespace tidemark::imaging
