// What work on a thread of its own says to the user interface: its progress, and what it ended by.
#pragma once

#include <QString>
#include <exception>
#include <functional>
#include <new>
#include <string_view>

#include "core/progress.h"

namespace tidemark {

class BackgroundJob;

// A step as the folders below name it, in the user's language, with a capital letter. `context` is that of
// its translations.
[[nodiscard]] QString step_text(const char* context, std::string_view step);

// For the work of a job: `hear` is called on the receiver's thread, at most once in 50 ms. `job` and
// `context` must outlive the work.
[[nodiscard]] Progress job_progress(BackgroundJob& job, const char* context,
                                    std::function<void(double fraction, const QString& step)> hear);

// work(progress), which returns a Result or a Status; what it throws becomes an error.
template <class Work>
auto without_exceptions(const Work& work, const Progress& progress) -> decltype(work(progress)) {
  try {
    return work(progress);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "there is not enough memory");
  } catch (const std::exception& error) {
    return fail(ErrorKind::internal, "{}", error.what());
  }
}

}  // namespace tidemark
