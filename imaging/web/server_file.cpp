#include "imaging/web/server_file.h"

#include <fstream>
#include <system_error>

#include "core/site_folder.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestAddress = 2048;
constexpr std::size_t kLongestUser = 253;

// One that cannot be read may say so: what is wrong with it is to be seen.
bool is_locked(const fs::path& of_site) {
  std::error_code error;
  if (!fs::exists(of_site, error)) return false;
  const auto text = text_of_server_file(of_site, "");
  if (!text) return true;
  const auto json = JsonDocument::parse(*text, of_site.string(), kServerFileLimits);
  if (!json) return true;
  const JsonField root = root_of(*json, of_site.string());
  return read_locked(root) || !root.good();
}

}  // namespace

fs::path server_file_to_read(const fs::path& own, const char* name) {
  std::error_code error;
  const fs::path of_site = site_folder() / name;
  if (is_locked(of_site)) return of_site;
  return !fs::exists(own, error) && fs::exists(of_site, error) ? of_site : own;
}

Result<fs::path> chosen_server_file(const fs::path& chosen, const fs::path& own, const char* name) {
  if (chosen.empty()) return server_file_to_read(own, name);
  const fs::path of_site = site_folder() / name;
  if (!is_locked(of_site)) return chosen;
  return fail(ErrorKind::usage, "{}: is not read: the site has locked its servers, {}", chosen.string(),
              of_site.string());
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

bool read_locked(const JsonField& root) {
  return root.has("locked") && root.at("locked").boolean();
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
