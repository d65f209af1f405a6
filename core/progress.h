// The progress of long work, and the request to stop it.
#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

#include "core/result.h"

namespace tidemark {

struct Progress {
  // fraction in 0..1 of the step named by `what`. May be called from any thread, one call at a time.
  std::function<void(double fraction, std::string_view what)> report;
  std::stop_token stop;

  void operator()(double fraction, std::string_view what) const {
    if (report) report(fraction, what);
  }
  // Of the index-th of `count` equal parts of this work.
  [[nodiscard]] Progress part(int index, int count) const {
    Progress one{nullptr, stop};
    if (report) {
      one.report = [all = report, index, count](double fraction, std::string_view what) {
        all((index + fraction) / count, what);
      };
    }
    return one;
  }
  [[nodiscard]] bool cancelled() const { return stop.stop_requested(); }
};

[[nodiscard]] inline tl::unexpected<Error> cancelled_error() {
  return fail(ErrorKind::cancelled, "interrupted");
}

}  // namespace tidemark
