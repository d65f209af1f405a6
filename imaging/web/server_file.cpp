#include "imaging/web/server_file.h"

#include <fstream>
#include <system_error>

#include "core/site_folder.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestAddress = 2048;
constexpr std::size_t kLongestUser = 253;

}  // namespace

fs::path server_file_to_read(const fs::path& own, const char* name) {
  std::error_code error;
  const fs::path of_site = site_folder() / name;
  return !fs::exists(own, error) && fs::exists(of_site, error) ? of_site : own;
}

Result<std::string> text_of_server_file(const fs::path& file, const char* purpose) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    return fail(ErrorKind::input, "{}: no such file: {}", file.string(), purpose);
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text(kServerFileLimits.bytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad() || !stream.is_open()) return fail(ErrorKind::input, "{}: cannot be read", file.string());
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

fs::path read_path(const JsonField& parent, const char* key, const fs::path& folder) {
  if (!parent.has(key)) return {};
  const fs::path path = parent.at(key).text();
  return path.empty() ? path : (folder / path).lexically_normal();
}

void read_whole(const JsonField& parent, const char* key, int high, int& value) {
  if (parent.has(key)) value = static_cast<int>(parent.at(key).integer(1, high));
}

WebAccess read_web_access(const JsonField& field, const fs::path& folder) {
  WebAccess access;
  access.url = field.at("url").text(kLongestAddress);
  access.secret = read_path(field, "secret", folder);
  if (field.has("user")) access.user = field.at("user").text(kLongestUser);
  return access;
}

TlsFiles read_tls(const JsonField& field, const fs::path& folder) {
  field.only({"ca", "certificate", "key", "verify"});
  TlsFiles tls;
  tls.ca = read_path(field, "ca", folder);
  tls.certificate = read_path(field, "certificate", folder);
  tls.key = read_path(field, "key", folder);
  if (field.has("verify")) tls.verify = field.at("verify").boolean();
  return tls;
}

}  // namespace tidemark::imaging
