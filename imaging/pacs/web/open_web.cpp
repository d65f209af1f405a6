#include "imaging/pacs/web/web_services.h"

namespace tidemark::imaging {

Result<std::unique_ptr<HttpConnection>> open_web(const PacsServer& server, const std::stop_token& stop) {
  TIDEMARK_TRY(check_pacs_server(server));
  return HttpConnection::open({"PACS " + server.name, *server.web, server.tls, server.timeout_seconds}, stop);
}

}  // namespace tidemark::imaging
