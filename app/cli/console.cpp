#include "app/cli/console.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>

#include "app/cli/progress_bar.h"
#include "core/json/json_text.h"

namespace tidemark::cli {
namespace {

// Messages may hold text from files: one line, no control characters.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

void set_up_log() {
  auto logger =
      std::make_shared<spdlog::logger>("tidemark-cli", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%n: %l: %v");
  logger->set_level(spdlog::level::warn);
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace

Console::Console(Interrupt& interrupt) : interrupt_(interrupt), bar_(std::make_unique<ProgressBar>()) {
  set_up_log();
}

Console::~Console() = default;

void Console::set_verbose(bool verbose) {
  verbose_ = verbose;
  spdlog::set_level(verbose ? spdlog::level::info : spdlog::level::warn);
}

void Console::print(const std::string& text) {
  bar_->clear();
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) output_failed_ = true;
}

void Console::say_line(const std::string& line) {
  if (json_) {
    log_line(line);
  } else {
    print(one_line(line) + "\n");
    if (std::fflush(stdout) != 0) output_failed_ = true;
  }
}

void Console::log_line(const std::string& line) {
  if (verbose_) bar_->clear();
  spdlog::info("{}", one_line(line));
}

void Console::warn(const std::string& message) {
  bar_->clear();
  spdlog::warn("{}", one_line(message));
}

void Console::result(const Json& object) {
  if (json_) print(json_text(object));
}

Progress Console::progress() {
  Progress progress;
  progress.stop = interrupt_.stop_token();
  if (bar_->visible()) {
    progress.report = [this](double fraction, std::string_view what) { bar_->show(fraction, what); };
  }
  return progress;
}

int Console::finish(const Status& status) {
  bar_->clear();
  if (std::fflush(stdout) != 0) output_failed_ = true;
  if (!status) {
    if (interrupt_.take_last_word()) spdlog::error("{}", one_line(status.error().message));
    return exit_code(status.error().kind);
  }
  if (output_failed_) {
    spdlog::error("standard output: cannot write");
    return exit_code(ErrorKind::write);
  }
  return 0;
}

}  // namespace tidemark::cli
