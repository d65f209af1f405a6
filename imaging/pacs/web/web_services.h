// The services of a PACS by DICOMweb: QIDO-RS, WADO-RS and STOW-RS (DICOM PS3.18).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/progress.h"
#include "imaging/pacs/found_answer.h"
#include "imaging/pacs/outgoing.h"
#include "imaging/pacs/retrieval_folder.h"
#include "imaging/pacs/services.h"
#include "imaging/web/http_connection.h"

namespace tidemark::imaging {

inline constexpr const char* kDicomJson = "application/dicom+json";  // PS3.18, annex F

// Fails (ErrorKind::input) naming the field or the file that is not usable. Nobody is called yet.
Result<std::unique_ptr<HttpConnection>> open_web(const PacsServer& server, const std::stop_token& stop);

Result<double> echo_by_web(const PacsServer& server, const Progress& progress);

// The request of ask_by_web(): "studies?limit=11&00100020=4711".
[[nodiscard]] std::string question(const std::string& resource, const QueryKeys& keys, std::int64_t limit);

// Asks for studies, or for the series of one, and takes answer by answer. True when the server has more
// answers than `most`, or than were taken.
Result<bool> ask_by_web(const PacsServer& server, const std::string& resource, const QueryKeys& keys,
                        std::int64_t most, const TakeAnswer& take, const Progress& progress);

// Brings the wanted objects into the retrieval_folder and returns the number of objects that the server could
// not send, as far as it says so.
Result<std::int64_t> retrieve_by_web(const PacsServer& server, const RetrieveRequest& request,
                                     const PacsLimits& limits, RetrievalFolder& retrieval_folder,
                                     const std::stop_token& stop);

// The way to a server that takes objects by STOW-RS.
Result<std::unique_ptr<ObjectSender>> open_web_sender(const PacsServer& server, const std::stop_token& stop);

}  // namespace tidemark::imaging
