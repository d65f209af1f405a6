#include "imaging/pacs/tls_files.h"

#include <algorithm>
#include <cctype>

#include "core/json/json_field.h"

namespace tidemark::imaging {

namespace fs = std::filesystem;

fs::path read_path(const JsonField& parent, const char* key, const fs::path& folder) {
  if (!parent.has(key)) return {};
  const fs::path path = parent.at(key).text();
  return path.empty() ? path : (folder / path).lexically_normal();
}

PacsTls read_tls(const JsonField& field, const fs::path& folder) {
  field.only({"ca", "certificate", "key", "verify"});
  PacsTls tls;
  tls.ca = read_path(field, "ca", folder);
  tls.certificate = read_path(field, "certificate", folder);
  tls.key = read_path(field, "key", folder);
  if (field.has("verify")) tls.verify = field.at("verify").boolean();
  return tls;
}

std::string fault_of(const PacsTls& tls) {
  return tls.certificate.empty() != tls.key.empty() ? "certificate and key go together" : "";
}

bool is_host(const std::string& text) {
  const auto allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_';
  };
  return !text.empty() && text.size() <= 253 && std::all_of(text.begin(), text.end(), allowed);
}

}  // namespace tidemark::imaging
