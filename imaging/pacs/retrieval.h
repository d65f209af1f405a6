// The common part of both ways of retrieving.
#pragma once

#include <memory>

#include "imaging/pacs/association.h"
#include "imaging/pacs/retrieval_folder.h"

namespace tidemark::imaging {

// A server's counts of the objects that it sends.
struct SubOperations {
  std::int64_t remaining = 0;
  std::int64_t completed = 0;
  std::int64_t failed = 0;
  std::int64_t warned = 0;

  bool operator==(const SubOperations&) const = default;
  [[nodiscard]] std::int64_t total() const { return remaining + completed + failed + warned; }
};

// The identifier of a request: the objects that are wanted.
[[nodiscard]] std::unique_ptr<DcmDataset> identifier_of(const RetrieveRequest& request);

// The progress by a server's responses. Only a change counts, so that a server cannot keep us waiting by the
// same response again and again.
class ResponseReader {
 public:
  ResponseReader(Association& association, RetrievalFolder& retrieval_folder)
      : association_(association), retrieval_folder_(retrieval_folder) {}

  // A response to either way. True when it was the last. Fails (ErrorKind::input) when the server says that
  // it has failed altogether.
  Result<bool> read(const T_DIMSE_Message& message);
  // After the last: objects that the server could not send.
  [[nodiscard]] std::int64_t missing() const { return missing_; }

 private:
  Association& association_;
  RetrievalFolder& retrieval_folder_;
  SubOperations counted_;
  std::int64_t missing_ = 0;
  std::int64_t read_ = 0;
};

// Each brings the wanted objects into the retrieval_folder and returns the number of objects that the server
// could not send.
Result<std::int64_t> retrieve_by_get(const PacsServer& server, const RetrieveRequest& request,
                                     const PacsLimits& limits, RetrievalFolder& retrieval_folder,
                                     const std::stop_token& stop);
Result<std::int64_t> retrieve_by_move(const PacsServer& server, const RetrieveRequest& request,
                                      const PacsLimits& limits, RetrievalFolder& retrieval_folder,
                                      const std::stop_token& stop);

}  // namespace tidemark::imaging
