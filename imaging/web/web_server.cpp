#include "imaging/web/web_server.h"

#include <utility>

#include "imaging/web/web_address.h"

namespace tidemark::imaging {

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
  if (tls && tls->certificate.empty() != tls->key.empty()) return {"tls", "certificate and key go together"};
  return {};
}

}  // namespace tidemark::imaging
