// The end of exceptions that libraries, or the lack of memory, throw while a file is read or written.
#pragma once

#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "core/result.h"

namespace tidemark::imaging {

// Runs `work`, which returns a Result or a Status; an exception of it becomes an error that names the path.
template <class Work>
auto guarded(const std::filesystem::path& path, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "{}: there is not enough memory", path.string());
  } catch (const std::exception& error) {
    return fail(ErrorKind::input, "{}: cannot be read: {}", path.string(), error.what());
  }
}

// The same for work that writes the file.
template <class Work>
auto guarded_writing(const std::filesystem::path& path, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "{}: cannot write: there is not enough memory", path.string());
  } catch (const std::exception& error) {
    return fail(ErrorKind::write, "{}: cannot write: {}", path.string(), error.what());
  }
}

// A reason without the path at its begin, for places that show the path beside it.
inline std::string without_path(std::string reason, const std::filesystem::path& path) {
  if (const std::string start = path.string() + ": "; reason.starts_with(start))
    reason.erase(0, start.size());
  return reason;
}

}  // namespace tidemark::imaging
