#include "imaging/web/web_server.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "imaging/web/web_address.h"

namespace tidemark::imaging {

std::string fault_of(const TlsFiles& tls) {
  return tls.certificate.empty() != tls.key.empty() ? "certificate and key go together" : "";
}

bool is_host(const std::string& text) {
  const auto allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_';
  };
  return !text.empty() && text.size() <= 253 && std::all_of(text.begin(), text.end(), allowed);
}

ServerFault fault_of(const WebAccess& access, bool has_tls) {
  if (std::string fault = fault_of_address(access.url); !fault.empty()) return {"url", std::move(fault)};
  if (!access.user.empty() && access.secret.empty()) return {"user", "has no secret"};
  const bool is_plain = !is_encrypted(access.url);
  if (is_plain && has_tls) return {"tls", "the url begins with http://, which is not encrypted"};
  if (is_plain && !access.secret.empty() && !is_on_this_machine(access.url)) {
    return {"secret", "would cross the network in the clear: the url must begin with https://"};
  }
  return {};
}

ServerFault fault_of_common(const std::string& name, int timeout_seconds,
                            const std::optional<TlsFiles>& tls) {
  if (name.empty()) return {"name", "is empty"};
  if (timeout_seconds < 1 || timeout_seconds > 3600) return {"timeout_seconds", "is not within 1 to 3600"};
  if (std::string fault = tls ? fault_of(*tls) : std::string(); !fault.empty())
    return {"tls", std::move(fault)};
  return {};
}

}  // namespace tidemark::imaging
