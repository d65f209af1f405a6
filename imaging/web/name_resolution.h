// The address of a host by its name.
#pragma once

#include <chrono>
#include <stop_token>
#include <string>

#include "core/result.h"

namespace tidemark::imaging {

// The first IPv4 address of a host, as text. The system's resolver cannot be interrupted, so it runs on a
// thread of its own, which is abandoned when `stop` or `patience` comes first.
Result<std::string> resolve_host(const std::string& host, std::chrono::milliseconds patience,
                                 const std::stop_token& stop);

}  // namespace tidemark::imaging
