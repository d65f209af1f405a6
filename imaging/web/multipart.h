// Bodies of several parts (multipart/related, RFC 2046 section 5.1), as DICOMweb sends objects
// (PS3.18, 8.6.1.2).
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/result.h"

namespace tidemark::imaging {

// What a reader tells while parts come.
struct MultipartSink {
  std::function<Status()> begin;                       // a part
  std::function<Status(std::string_view bytes)> take;  // of that part
  std::function<Status()> end;
};

// Reads a body piece by piece, however it is cut. What is before the first part, after the last, and in the
// parts' headers is passed over.
class MultipartReader {
 public:
  // `content_type` is that of the whole. Fails (ErrorKind::input) where it is none of several parts.
  static Result<MultipartReader> create(std::string_view content_type, MultipartSink sink);

  // Fails (ErrorKind::input) on what is no such body, and as the sink does.
  Status read(std::string_view bytes);
  // Whether the last part has come whole.
  [[nodiscard]] bool is_complete() const { return state_ == State::after; }

 private:
  enum class State { before, delimiter, headers, body, after };

  MultipartReader(std::string delimiter, MultipartSink sink);
  Result<bool> step();  // false: more bytes are needed
  Result<bool> pass_over();
  Result<bool> read_delimiter();
  Result<bool> read_headers();
  Result<bool> read_body();

  std::string delimiter_;  // with the line's end before it, which is no part of a body
  MultipartSink sink_;
  State state_ = State::before;
  std::string left_;  // what has come and was not yet read
};

// The type, and the lines before and after the bytes of one object that is sent.
struct MultipartObject {
  std::string content_type;
  std::string before;
  std::string after;
};
[[nodiscard]] MultipartObject multipart_object();

}  // namespace tidemark::imaging
