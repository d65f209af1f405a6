// Keeps exceptions of libraries inside.
#pragma once

#include <exception>
#include <new>

#include "core/result.h"

namespace tidemark {

template <class Work>
auto whole_call(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "there is not enough memory");
  } catch (const std::exception& error) {
    return fail(ErrorKind::internal, "{}", error.what());
  }
}

}  // namespace tidemark
