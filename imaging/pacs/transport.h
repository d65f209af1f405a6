// DCMTK's transport with a ConnectionWatch under it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/result.h"
#include "imaging/pacs/configuration.h"
#include "imaging/web/connection_watch.h"

class DcmTransportLayer;

namespace tidemark::imaging {

enum class TransportRole { caller, called };

// Makes connections, by TLS when `tls` is set; each gets the watch that `next_watch` returns at that moment.
// As a caller the peer's certificate must be one for `host`. Fails (ErrorKind::input) naming the file of a
// key or certificate that is not usable.
Result<std::unique_ptr<DcmTransportLayer>> make_transport(
    const std::optional<TlsFiles>& tls, TransportRole role, const std::string& host,
    std::function<std::shared_ptr<ConnectionWatch>()> next_watch);

}  // namespace tidemark::imaging
