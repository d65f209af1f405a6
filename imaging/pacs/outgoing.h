// The common part of both ways of sending.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "imaging/pacs/checked_object.h"

namespace tidemark::imaging {

// A file that was looked into and found good.
struct Outgoing {
  std::filesystem::path file;
  ObjectIdentity identity;
};

// A conversation in which objects are sent, one after the other.
class ObjectSender {
 public:
  virtual ~ObjectSender() = default;
  // `object` is what lies in the file now, with the same identity. The reason why the server did not take it;
  // empty when it did. Fails (ErrorKind::input) where the conversation cannot go on.
  virtual Result<std::string> send(const Outgoing& one, const CheckedObject& object) = 0;
  // After the last.
  virtual void end() {}
};

}  // namespace tidemark::imaging
