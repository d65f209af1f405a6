#include "imaging/web/http_connection.h"

#include <curl/curl.h>
#include <strings.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "core/progress.h"
#include "core/text_file.h"
#include "core/without_exceptions.h"
#include "imaging/web/clean_text.h"
#include "imaging/web/web_address.h"

namespace tidemark::imaging {
namespace {

constexpr std::int64_t kLongestHead = std::int64_t{64} << 10;
constexpr std::size_t kLongestRefusal = std::size_t{64} << 10;
constexpr std::size_t kLongestSecret = 16'384;  // tokens with many claims have some kilobytes

// One request while libcurl works on it, which calls these functions.
struct Exchange {
  const HttpRequest& request;
  const HttpConnection::TakeBody& take;
  ConnectionWatch& watch;
  const std::stop_token& stop;
  CURL* handle;
  HttpAnswer answer = {};
  Status status = {};    // of what the caller does with the body
  std::size_t part = 0;  // of the request's body, with the place in it
  std::int64_t place = 0;
  bool knows_head = false;

  void read_head();
  bool take_body(std::string_view bytes);
  bool take_header(std::string_view line);
  std::size_t give(std::span<std::uint8_t> room);
};

void Exchange::read_head() {
  if (knows_head) return;
  knows_head = true;
  long status_code = 0;
  const char* text = nullptr;
  curl_easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &status_code);
  answer.status = static_cast<int>(status_code);
  if (curl_easy_getinfo(handle, CURLINFO_CONTENT_TYPE, &text) == CURLE_OK && text != nullptr) {
    answer.content_type = text;
  }
  if (curl_easy_getinfo(handle, CURLINFO_REDIRECT_URL, &text) == CURLE_OK && text != nullptr) {
    answer.redirection = clean_text(text);
  }
}

bool Exchange::take_body(std::string_view bytes) {
  if (!watch.received(static_cast<std::int64_t>(bytes.size()))) return false;
  read_head();
  if (!answer.is_good()) {
    answer.refusal += bytes.substr(0, kLongestRefusal - std::min(kLongestRefusal, answer.refusal.size()));
    return true;
  }
  status = without_exceptions([&] { return take(answer, bytes); });
  return status.has_value();
}

// Nothing compressed was asked for: a small answer could become a large one.
bool Exchange::take_header(std::string_view line) {
  if (!watch.received(static_cast<std::int64_t>(line.size()))) return false;
  constexpr std::string_view kName = "content-encoding:";
  if (line.size() < kName.size() || ::strncasecmp(line.data(), kName.data(), kName.size()) != 0) return true;
  if (clean_text(std::string(line.substr(kName.size()))) == "identity") return true;
  status = fail(ErrorKind::input, "{}: compresses its answer, which was not asked for", watch.peer());
  return false;
}

std::size_t Exchange::give(std::span<std::uint8_t> room) {
  while (part < request.body.size() && place == request.body[part]->size()) {
    ++part;
    place = 0;
  }
  if (part == request.body.size()) return 0;
  const std::size_t given = request.body[part]->read(place, room);
  if (given == 0) {
    status = fail(ErrorKind::input, "a file has become shorter while it was sent");
    return CURL_READFUNC_ABORT;
  }
  place += static_cast<std::int64_t>(given);
  watch.sent(static_cast<std::int64_t>(given));
  return given;
}

std::size_t on_body(char* bytes, std::size_t /*one*/, std::size_t count, void* exchange) {
  return static_cast<Exchange*>(exchange)->take_body({bytes, count}) ? count : CURL_WRITEFUNC_ERROR;
}

std::size_t on_header(char* bytes, std::size_t /*one*/, std::size_t count, void* exchange) {
  return static_cast<Exchange*>(exchange)->take_header({bytes, count}) ? count : CURL_WRITEFUNC_ERROR;
}

std::size_t on_read(char* to, std::size_t one, std::size_t count, void* exchange) {
  return static_cast<Exchange*>(exchange)->give({reinterpret_cast<std::uint8_t*>(to), one * count});
}

// A connection that was kept, and that the server has left, is made anew: the body goes from its beginning.
int on_seek(void* exchange, curl_off_t offset, int origin) {
  if (offset != 0 || origin != SEEK_SET) return CURL_SEEKFUNC_CANTSEEK;
  static_cast<Exchange*>(exchange)->part = 0;
  static_cast<Exchange*>(exchange)->place = 0;
  return CURL_SEEKFUNC_OK;
}

// At least once a second, also while there is no socket that the watch could shut.
int on_progress(void* exchange, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
  const auto& self = *static_cast<Exchange*>(exchange);
  return self.stop.stop_requested() || !self.watch.trouble() ? 1 : 0;
}

curl_socket_t on_open(void* watch, curlsocktype /*purpose*/, struct curl_sockaddr* address) {
  const int made = ::socket(address->family, address->socktype | SOCK_CLOEXEC, address->protocol);
  if (made >= 0) static_cast<ConnectionWatch*>(watch)->opened(made);
  return made;
}

int on_close(void* watch, curl_socket_t socket) {
  static_cast<ConnectionWatch*>(watch)->closing();
  return ::close(socket);
}

// One line, without the end that editors add.
Result<std::string> secret_in(const std::filesystem::path& file) {
  auto text = read_text_file(file, kLongestSecret);
  if (!text) return text;
  text->erase(text->find_last_not_of("\r\n") + 1);
  const auto is_plain = [](unsigned char c) { return c >= 0x20 && c != 0x7f; };
  if (!text->empty() && std::all_of(text->begin(), text->end(), is_plain)) return text;
  return fail(ErrorKind::input, "{}: holds no password or token: one line is wanted", file.string());
}

// Who may have signed a server's certificate; empty: those that libcurl was built with. OpenSSL heeds the
// variable by itself, libcurl does not.
std::filesystem::path authorities(const WebServer& server) {
  if (server.tls && !server.tls->ca.empty()) return server.tls->ca;
  const char* chosen = std::getenv("SSL_CERT_FILE");
  return chosen != nullptr ? chosen : "";
}

}  // namespace

HttpConnection::HttpConnection(const WebServer& server, const std::stop_token& stop)
    : server_(server),
      stop_(stop),
      watch_(fmt::format("{} ({})", server.title, server.access.url),
             std::chrono::seconds(server.timeout_seconds), stop),
      handle_(curl_easy_init(), curl_easy_cleanup) {}

Result<std::unique_ptr<HttpConnection>> HttpConnection::open(const WebServer& server,
                                                             const std::stop_token& stop) {
  if (const ServerFault fault = fault_of(server.access, server.tls.has_value()); *fault.field != '\0') {
    return fail(ErrorKind::input, "{}: {}: {}", server.title, fault.field, fault.reason);
  }
  static const CURLcode kReady = curl_global_init(CURL_GLOBAL_DEFAULT);
  std::unique_ptr<HttpConnection> connection(new HttpConnection(server, stop));
  CURL* handle = connection->handle_.get();
  if (kReady != CURLE_OK || handle == nullptr) {
    return fail(ErrorKind::capability, "libcurl cannot be used");
  }
  curl_easy_setopt(handle, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(handle, CURLOPT_QUICK_EXIT, 1L);  // not until a name is resolved
  curl_easy_setopt(handle, CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(handle, CURLOPT_USERAGENT, "Tidemark");
  curl_easy_setopt(handle, CURLOPT_CONNECTTIMEOUT, static_cast<long>(server.timeout_seconds));
  curl_easy_setopt(handle, CURLOPT_OPENSOCKETFUNCTION, on_open);
  curl_easy_setopt(handle, CURLOPT_OPENSOCKETDATA, &connection->watch_);
  curl_easy_setopt(handle, CURLOPT_CLOSESOCKETFUNCTION, on_close);
  curl_easy_setopt(handle, CURLOPT_CLOSESOCKETDATA, &connection->watch_);
  // What is on this machine no proxy can reach.
  if (is_on_this_machine(server.access.url)) curl_easy_setopt(handle, CURLOPT_PROXY, "");
  connection->encrypt();
  TIDEMARK_TRY(connection->authenticate());
  return connection;
}

Status HttpConnection::authenticate() {
  if (server_.access.secret.empty()) return {};
  const auto secret = secret_in(server_.access.secret);
  if (!secret) return pass_on(secret);
  CURL* handle = handle_.get();
  if (server_.access.user.empty()) {
    curl_easy_setopt(handle, CURLOPT_HTTPAUTH, static_cast<long>(CURLAUTH_BEARER));
    curl_easy_setopt(handle, CURLOPT_XOAUTH2_BEARER, secret->c_str());
  } else {
    curl_easy_setopt(handle, CURLOPT_HTTPAUTH, static_cast<long>(CURLAUTH_BASIC));
    curl_easy_setopt(handle, CURLOPT_USERNAME, server_.access.user.c_str());
    curl_easy_setopt(handle, CURLOPT_PASSWORD, secret->c_str());
  }
  return {};
}

void HttpConnection::encrypt() {
  CURL* handle = handle_.get();
  curl_easy_setopt(handle, CURLOPT_SSLVERSION, static_cast<long>(CURL_SSLVERSION_TLSv1_2));
  if (const auto trusted = authorities(server_); !trusted.empty()) {
    curl_easy_setopt(handle, CURLOPT_CAINFO, trusted.c_str());
    curl_easy_setopt(handle, CURLOPT_CAPATH, nullptr);  // the system's authorities
  }
  if (!server_.tls) return;
  const TlsFiles& tls = *server_.tls;
  curl_easy_setopt(handle, CURLOPT_SSL_VERIFYPEER, tls.verify ? 1L : 0L);
  curl_easy_setopt(handle, CURLOPT_SSL_VERIFYHOST, tls.verify ? 2L : 0L);
  if (tls.certificate.empty()) return;
  curl_easy_setopt(handle, CURLOPT_SSLCERT, tls.certificate.c_str());
  curl_easy_setopt(handle, CURLOPT_SSLKEY, tls.key.c_str());
  curl_easy_setopt(handle, CURLOPT_KEYPASSWD, "");  // or the library asks on the terminal
}

Result<HttpAnswer> HttpConnection::ask(const HttpRequest& request, const TakeBody& take) {
  CURL* handle = handle_.get();
  Exchange exchange{request, take, watch_, stop_, handle};
  char detail[CURL_ERROR_SIZE] = {};
  using Headers = std::unique_ptr<curl_slist, void (*)(curl_slist*)>;
  // Without "Expect" a server that does not know it costs a second an object.
  Headers headers(curl_slist_append(nullptr, ("Accept: " + request.accept).c_str()), curl_slist_free_all);
  curl_slist_append(headers.get(), "Expect:");
  if (!request.body_type.empty()) {
    std::int64_t size = 0;
    for (const ByteSource* part : request.body) size += part->size();
    curl_slist_append(headers.get(), ("Content-Type: " + request.body_type).c_str());
    curl_easy_setopt(handle, CURLOPT_POST, 1L);
    curl_easy_setopt(handle, CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(size));
  } else {
    curl_easy_setopt(handle, CURLOPT_HTTPGET, 1L);
  }
  curl_easy_setopt(handle, CURLOPT_URL, (server_.access.url + "/" + request.resource).c_str());
  curl_easy_setopt(handle, CURLOPT_HTTPHEADER, headers.get());
  curl_easy_setopt(handle, CURLOPT_ERRORBUFFER, detail);
  curl_easy_setopt(handle, CURLOPT_WRITEFUNCTION, on_body);
  curl_easy_setopt(handle, CURLOPT_WRITEDATA, &exchange);
  curl_easy_setopt(handle, CURLOPT_HEADERFUNCTION, on_header);
  curl_easy_setopt(handle, CURLOPT_HEADERDATA, &exchange);
  curl_easy_setopt(handle, CURLOPT_READFUNCTION, on_read);
  curl_easy_setopt(handle, CURLOPT_READDATA, &exchange);
  curl_easy_setopt(handle, CURLOPT_SEEKFUNCTION, on_seek);
  curl_easy_setopt(handle, CURLOPT_SEEKDATA, &exchange);
  curl_easy_setopt(handle, CURLOPT_NOPROGRESS, 0L);
  curl_easy_setopt(handle, CURLOPT_XFERINFOFUNCTION, on_progress);
  curl_easy_setopt(handle, CURLOPT_XFERINFODATA, &exchange);

  watch_.allow(request.longest_answer + kLongestHead, "an answer");
  const CURLcode code = [&] {
    const ConnectionWatch::Wait wait(watch_);
    return curl_easy_perform(handle);
  }();
  for (const CURLoption option : {CURLOPT_ERRORBUFFER, CURLOPT_HTTPHEADER}) {
    curl_easy_setopt(handle, option, nullptr);
  }
  if (stop_.stop_requested()) return cancelled_error();
  if (!exchange.status) return pass_on(exchange.status);
  TIDEMARK_TRY(watch_.trouble());
  if (code != CURLE_OK) return fail(ErrorKind::input, "{}: {}", peer(), reason(code, detail));
  watch_.completed_message();
  exchange.read_head();
  return std::move(exchange.answer);
}

std::string HttpConnection::reason(int code, const char* detail) const {
  switch (code) {
    case CURLE_COULDNT_RESOLVE_HOST:
      return "its host is not known";
    case CURLE_COULDNT_CONNECT: {
      long error = 0;
      curl_easy_getinfo(handle_.get(), CURLINFO_OS_ERRNO, &error);
      if (error == 0) return "cannot be called";
      return fmt::format("cannot be called: {}", std::generic_category().message(static_cast<int>(error)));
    }
    case CURLE_OPERATION_TIMEDOUT:
      return fmt::format("cannot be called: nothing came for {} s", server_.timeout_seconds);
    case CURLE_PEER_FAILED_VERIFICATION:
      return fmt::format("its certificate is not to be trusted: {}", clean_text(detail));
    case CURLE_SSL_CACERT_BADFILE: {
      const auto trusted = authorities(server_);
      if (trusted.empty()) return "the system has no authorities (ca-certificates): name a file by tls.ca";
      return fmt::format("{}: no certificate can be read from it", trusted.string());
    }
    case CURLE_SSL_CERTPROBLEM:
      return clean_text(detail);
    case CURLE_SSL_CONNECT_ERROR:
      return fmt::format("no encrypted conversation comes about: {}", clean_text(detail));
    case CURLE_GOT_NOTHING:
    case CURLE_PARTIAL_FILE:
    case CURLE_RECV_ERROR:
    case CURLE_SEND_ERROR:
      return "breaks off";
    case CURLE_UNSUPPORTED_PROTOCOL:
    case CURLE_WEIRD_SERVER_REPLY:
      return "does not answer as web servers do";
    default:
      return clean_text(*detail != '\0' ? detail : curl_easy_strerror(static_cast<CURLcode>(code)));
  }
}

Error HttpConnection::error(const HttpAnswer& answer) const {
  const auto say = [&](const std::string& what) {
    return Error{ErrorKind::input, fmt::format("{}: {}", peer(), what)};
  };
  if (!answer.redirection.empty()) {
    return say(
        fmt::format("sends us on to {}: enter that address, if it is the right one", answer.redirection));
  }
  if (answer.status == 401 || answer.status == 403) {
    return say(fmt::format(
        "does not let us in (HTTP {}): {}", answer.status,
        server_.access.secret.empty() ? "it wants a secret" : "the user or the secret is not the right one"));
  }
  if (answer.status == 404) return say("has nothing at this address (HTTP 404)");
  return say(fmt::format("refuses the request (HTTP {})", answer.status));
}

}  // namespace tidemark::imaging
