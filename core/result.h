// Errors as values with a reason.
#pragma once

#include <fmt/format.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace tidemark {

// Whose fault it is; the command line turns it into an exit code (exit_code()).
enum class ErrorKind {
  internal,    // a defect of ours
  usage,       // an argument makes no sense
  input,       // a file cannot be read or contradicts itself
  capability,  // the machine or the memory budget does not allow it
  write,       // a result could not be written
  cancelled,   // the user asked to stop
};

struct Error {
  ErrorKind kind = ErrorKind::internal;
  std::string message;  // one line; names the file and the field where there is one
};

template <class T>
using Result = tl::expected<T, Error>;
using Status = Result<void>;

// return fail(ErrorKind::input, "{}: no pixel data", path);
template <class... Args>
[[nodiscard]] tl::unexpected<Error> fail(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
  return tl::unexpected<Error>(Error{kind, fmt::format(format, std::forward<Args>(args)...)});
}

// Hands a failed result's error on: if (!volume) return pass_on(volume);
template <class T>
[[nodiscard]] tl::unexpected<Error> pass_on(Result<T>& failed) {
  return tl::unexpected<Error>(std::move(failed.error()));
}

// The same for a result that stays: its error is copied.
template <class T>
[[nodiscard]] tl::unexpected<Error> pass_on(const Result<T>& failed) {
  return tl::unexpected<Error>(failed.error());
}

// Returns the error of a Result or Status from the function around it:
//   TIDEMARK_TRY(file.write(bytes));
#define TIDEMARK_TRY(...)                                                                                 \
  do {                                                                                                    \
    if (auto tidemark_tried = (__VA_ARGS__); !tidemark_tried) return ::tidemark::pass_on(tidemark_tried); \
  } while (false)

// The command line's contract: 1 internal, 2 usage, 3 input, 4 capability, 5 write, 130 interrupted.
int exit_code(ErrorKind kind);

}  // namespace tidemark
