// A peer that follows a test's script, however wrong.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include "imaging/pacs/configuration.h"

namespace tidemark::test {

// The peer's end of one connection. Writing stops at the first failure: the other side has hung up.
class PeerEnd {
 public:
  explicit PeerEnd(int socket, const std::atomic<bool>& quit) : socket_(socket), quit_(quit) {}

  bool write(const std::string& bytes);
  // The body of the next PDU; empty when the other side has hung up.
  std::string read_pdu(int* type = nullptr);
  // Reads the call and accepts all that it proposes.
  void accept_call();
  [[nodiscard]] int context(const std::string& abstract_syntax) const;
  // The next command, with its data read and dropped; empty when the other side has ended the conversation,
  // to which it agrees.
  std::string read_command();
  bool send_command(int context, const std::string& command);
  bool send_data(int context, const std::string& data, bool is_last = true);
  // The head of an HTTP request; its body is dropped where nobody wants it.
  std::string read_request(std::string* wanted_body = nullptr);
  // Until the other side hangs up, or the test ends.
  void say_nothing();
  [[nodiscard]] bool quits() const { return quit_; }

 private:
  bool read_exactly(std::string& bytes);

  int socket_;
  const std::atomic<bool>& quit_;
  std::map<std::string, int> contexts_;
};

// Listens on a port of the loopback interface and has `behave` for each connection, one after the other.
class ScriptedPeer {
 public:
  using Behaviour = std::function<void(PeerEnd&)>;
  explicit ScriptedPeer(Behaviour behave);
  ~ScriptedPeer();
  ScriptedPeer(const ScriptedPeer&) = delete;
  ScriptedPeer& operator=(const ScriptedPeer&) = delete;

  // With a time-out of one second.
  [[nodiscard]] imaging::PacsServer server() const;
  [[nodiscard]] imaging::PacsServer web_server() const;  // by DICOMweb

 private:
  void serve();

  Behaviour behave_;
  int listening_ = -1;
  int port_ = 0;
  std::atomic<bool> quit_{false};
  std::thread thread_;
};

}  // namespace tidemark::test
