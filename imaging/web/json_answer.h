// An answer of a web server that must be JSON.
#pragma once

#include <string>

#include "imaging/web/http_connection.h"

namespace tidemark::imaging {

// The whole body of a good answer; empty where the server has nothing (HTTP 204). `what` ends the sentence
// about another type: "... which is not JSON". Fails (ErrorKind::input) as HttpConnection::ask() does, and on
// an answer that is not good.
Result<std::string> ask_for_json(HttpConnection& connection, const HttpRequest& request,
                                 const std::string& what = "JSON");

}  // namespace tidemark::imaging
