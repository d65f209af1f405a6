#include "imaging/web/name_resolution.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>

#include <array>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "core/progress.h"
#include "core/without_exceptions.h"

namespace tidemark::imaging {
namespace {

Result<std::string> ask_system(const std::string& host) {
  if (host == "localhost") return "127.0.0.1";  // whatever the system's tables say (RFC 6761 6.3)
  addrinfo hints{};
  hints.ai_family = AF_INET;  // all that DCMTK connects to by its numbers
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(host.c_str(), nullptr, &hints, &found); error != 0) {
    return fail(ErrorKind::input, "the host {} is not known: {}", host, ::gai_strerror(error));
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, ::freeaddrinfo);
  std::array<char, INET_ADDRSTRLEN> text{};
  const auto* address = reinterpret_cast<const sockaddr_in*>(found->ai_addr);
  if (::inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size()) == nullptr) {
    return fail(ErrorKind::input, "the host {} has no IPv4 address", host);
  }
  return std::string(text.data());
}

struct ResolvedName {
  std::mutex mutex;
  std::condition_variable_any came;
  std::optional<Result<std::string>> address;
};

}  // namespace

Result<std::string> resolve_host(const std::string& host, std::chrono::milliseconds patience,
                                 const std::stop_token& stop) {
  const auto answer = std::make_shared<ResolvedName>();
  std::thread([host, answer] {
    auto address = without_exceptions([&] { return ask_system(host); });
    const std::lock_guard lock(answer->mutex);
    answer->address = std::move(address);
    answer->came.notify_all();
  }).detach();
  std::unique_lock lock(answer->mutex);
  answer->came.wait_for(lock, stop, patience, [&] { return answer->address.has_value(); });
  if (answer->address) return *answer->address;
  if (stop.stop_requested()) return cancelled_error();
  return fail(ErrorKind::input, "the host {} is not known: no answer to the question for its address", host);
}

}  // namespace tidemark::imaging
