#include "app/cli/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tidemark::cli {
namespace {

constexpr int kWidth = 30;
constexpr std::size_t kLongestText = 40;  // bar and text fit a terminal of 80 columns
constexpr std::chrono::milliseconds kInterval{100};
constexpr const char* kClearLine = "\r\033[K";

}  // namespace

ProgressBar::ProgressBar() : visible_(::isatty(STDERR_FILENO) == 1) {}

std::string ProgressBar::line(double fraction, std::string_view what) {
  const double bounded = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  const auto filled = static_cast<std::size_t>(std::lround(bounded * kWidth));
  return fmt::format("[{}{}] {:3.0f} % {}", std::string(filled, '#'), std::string(kWidth - filled, '.'),
                     100.0 * bounded, what.substr(0, kLongestText));
}

void ProgressBar::show(double fraction, std::string_view what) {
  if (!visible_) return;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && now - last_ < kInterval) return;
  last_ = now;
  drawn_ = true;
  const std::string text = kClearLine + line(fraction, what);
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void ProgressBar::clear() {
  const std::lock_guard lock(mutex_);
  if (!drawn_) return;
  drawn_ = false;
  std::fputs(kClearLine, stderr);
  std::fflush(stderr);
}

}  // namespace tidemark::cli
