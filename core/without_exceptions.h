// The end of exceptions that libraries, or the lack of memory, throw in work that has no file to blame.
#pragma once

#include <exception>
#include <new>

#include "core/out_of_memory.h"
#include "core/result.h"

namespace tidemark {

// Calls work(), which returns a Result or a Status; an exception of it becomes an error.
template <class Work>
auto without_exceptions(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc& error) {
    return out_of_memory(error);
  } catch (const std::exception& error) {
    return fail(ErrorKind::internal, "{}", error.what());
  }
}

}  // namespace tidemark
