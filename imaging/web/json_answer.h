// An answer of a web server that must be JSON.
#pragma once

#include <string>

#include "imaging/web/http_connection.h"

namespace tidemark::imaging {

// The whole body of a good answer; empty where the server has nothing (HTTP 204). Fails (ErrorKind::input) as
// HttpConnection::ask() does, on an answer that is not good, and on one of another type.
Result<std::string> ask_for_json(HttpConnection& connection, const HttpRequest& request);

}  // namespace tidemark::imaging
