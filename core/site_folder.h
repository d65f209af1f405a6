// A site's folder: where its administrator puts what holds for all users of a machine.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace tidemark {

// $TIDEMARK_SITE, else /etc/tidemark: settings of the desktop (tidemark.conf), PACS servers (pacs.json) and
// the audit log (audit.json). It need not be there.
inline std::filesystem::path site_folder() {
  const char* chosen = std::getenv("TIDEMARK_SITE");
  return chosen != nullptr && *chosen == '/' ? std::filesystem::path(chosen) : "/etc/tidemark";
}

}  // namespace tidemark
