// A progress bar on the terminal.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace tidemark::cli {

// Drawn on standard error, and only while that is a terminal; at most ten times a second.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  [[nodiscard]] bool visible() const { return visible_; }
  void show(double fraction, std::string_view what);  // fraction in 0..1; any thread
  void clear();

  // The line that show() draws: a bar of 30 characters, per cent, and what is being done.
  [[nodiscard]] static std::string line(double fraction, std::string_view what);

 private:
  std::mutex mutex_;
  bool visible_ = false;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace tidemark::cli
