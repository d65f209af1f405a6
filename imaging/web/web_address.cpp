#include "imaging/web/web_address.h"

#include <curl/curl.h>
#include <fmt/format.h>

#include <cctype>
#include <cstring>
#include <memory>

namespace tidemark::imaging {
namespace {

using Text = std::unique_ptr<char, void (*)(void*)>;

class Address {
 public:
  explicit Address(const std::string& url) : parts_(curl_url(), curl_url_cleanup) {
    is_good_ = parts_ != nullptr && curl_url_set(parts_.get(), CURLUPART_URL, url.c_str(), 0) == CURLUE_OK;
  }
  [[nodiscard]] bool is_good() const { return is_good_; }
  [[nodiscard]] std::string part(CURLUPart which) const {
    char* text = nullptr;
    if (!is_good_ || curl_url_get(parts_.get(), which, &text, 0) != CURLUE_OK) return {};
    const Text owned(text, curl_free);
    return owned.get();
  }

 private:
  std::unique_ptr<CURLU, void (*)(CURLU*)> parts_;
  bool is_good_ = false;
};

}  // namespace

std::string fault_of_address(const std::string& url) {
  const Address address(url);
  if (!address.is_good()) return "is no address: https://server.example/service is one";
  const std::string scheme = address.part(CURLUPART_SCHEME);
  if (scheme != "https" && scheme != "http") return "begins with neither https:// nor http://";
  if (!address.part(CURLUPART_USER).empty() || !address.part(CURLUPART_PASSWORD).empty()) {
    return "holds a user or a password: they have fields of their own";
  }
  if (!address.part(CURLUPART_QUERY).empty() || !address.part(CURLUPART_FRAGMENT).empty()) {
    return "holds a question, or a place in a page";
  }
  return url.ends_with('/') ? "ends with a slash" : "";
}

std::string host_of(const std::string& url) {
  return Address(url).part(CURLUPART_HOST);
}

bool is_encrypted(const std::string& url) {
  return Address(url).part(CURLUPART_SCHEME) == "https";
}

bool is_on_this_machine(const std::string& url) {
  const std::string host = Address(url).part(CURLUPART_HOST);
  return host == "localhost" || host == "127.0.0.1" || host == "[::1]";
}

std::string escaped(const std::string& text, const char* kept) {
  std::string all;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain =
        byte != 0 && byte < 0x80 &&
        (std::isalnum(byte) != 0 || std::strchr("-._~", c) != nullptr || std::strchr(kept, c) != nullptr);
    all += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return all;
}

}  // namespace tidemark::imaging
