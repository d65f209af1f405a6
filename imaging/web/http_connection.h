// HTTP to a server that may misbehave: nobody waits in vain, and no answer is longer than is allowed.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "imaging/guard/byte_source.h"
#include "imaging/web/connection_watch.h"
#include "imaging/web/web_server.h"

namespace tidemark::imaging {

struct HttpRequest {
  std::string resource;                // behind the server's address: "studies?limit=1"
  std::string accept;                  // the media type that is wanted
  std::int64_t longest_answer = 0;     // bytes of its body
  std::string body_type = {};          // of what is sent (POST); empty: nothing is (GET)
  std::vector<ByteSource*> body = {};  // sent one after the other
};

struct HttpAnswer {
  int status = 0;                // 200
  std::string content_type;      // as it came: "multipart/related; boundary=x"
  std::string redirection = {};  // where a status of 3xx sends to
  std::string refusal = {};      // the body where the status is none of success; its first 64 KiB

  [[nodiscard]] bool is_good() const { return status >= 200 && status < 300; }
};

// No redirection is followed, and nothing compressed is taken: a server decides neither where a secret goes
// nor how much memory its answer takes.
class HttpConnection {
 public:
  // Fails (ErrorKind::input) naming the field or the file that is not usable. The server is called by ask().
  static Result<std::unique_ptr<HttpConnection>> open(const WebServer& server, const std::stop_token& stop);

  // Gets the body of a good answer, piece by piece, with the head that came before it.
  using TakeBody = std::function<Status(const HttpAnswer& head, std::string_view bytes)>;
  // Any status is an answer. Fails (ErrorKind::input) where there is none, and as `take` does; with the
  // request to stop, within a second.
  Result<HttpAnswer> ask(const HttpRequest& request, const TakeBody& take);

  // The error of an answer that is not good.
  [[nodiscard]] Error error(const HttpAnswer& answer) const;
  // "PACS main (https://pacs.example/dicom-web)", as messages begin.
  [[nodiscard]] const std::string& peer() const { return watch_.peer(); }

 private:
  HttpConnection(const WebServer& server, const std::stop_token& stop);
  Status authenticate();
  void encrypt();
  [[nodiscard]] std::string reason(int code, const char* detail) const;

  const WebServer server_;
  const std::stop_token stop_;
  ConnectionWatch watch_;
  std::unique_ptr<void, void (*)(void*)> handle_;  // libcurl's; goes before the watch, which it tells
};

}  // namespace tidemark::imaging
