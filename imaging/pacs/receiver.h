// The receiver of a server's own calls while a retrieval by move runs.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "core/result.h"
#include "imaging/pacs/association.h"
#include "imaging/pacs/retrieval_folder.h"

namespace tidemark::imaging {

// Listens on a server's move_port, for calls to our AE title alone, and takes objects into the
// retrieval_folder. Up to four calls at once; each conversation has a thread and a watch of its own.
class Receiver {
 public:
  static Result<std::unique_ptr<Receiver>> start(const PacsServer& server, RetrievalFolder& retrieval_folder,
                                                 const PacsLimits& limits);
  ~Receiver();  // ends all conversations
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  // The first thing that made a conversation end early and the retrieval with it: too many bytes, a full
  // disk.
  [[nodiscard]] Status trouble();

 private:
  Receiver(const PacsServer& server, RetrievalFolder& retrieval_folder, const PacsLimits& limits);
  void listen(const std::stop_token& quit);
  void accept(const std::stop_token& quit);
  Status greet(T_ASC_Association& association) const;
  Status converse(Association& association);
  void note(const Error& error);

  const PacsServer server_;
  RetrievalFolder& retrieval_folder_;
  const PacsLimits limits_;
  std::unique_ptr<DcmTransportLayer> transport_;
  T_ASC_Network* network_ = nullptr;
  std::shared_ptr<ConnectionWatch> next_watch_;  // of the call that is being accepted
  std::stop_source stop_;                        // of all watches
  std::mutex mutex_;                             // guards trouble_
  std::optional<Error> trouble_;
  struct Conversation {
    std::shared_ptr<std::atomic<bool>> ended;
    std::jthread thread;
  };
  std::vector<Conversation> conversations_;  // of the listening thread
  std::jthread listener_;                    // last: it uses the others
};

}  // namespace tidemark::imaging
