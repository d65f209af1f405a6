// The program's output: results, messages and progress, each on its stream.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "app/cli/interrupt.h"
#include "core/progress.h"
#include "core/result.h"

namespace tidemark::cli {

using Json = nlohmann::ordered_json;

class ProgressBar;

// Results go to standard output, warnings, errors and progress to standard error. With --json standard
// output carries one JSON object and nothing else.
class Console {
 public:
  explicit Console(Interrupt& interrupt);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void set_json(bool json) { json_ = json; }
  void set_verbose(bool verbose);
  [[nodiscard]] bool json() const { return json_; }

  // Verbatim to standard output.
  void print(const std::string& text);

  // A line of the result for people: standard output, or with --json and --verbose standard error.
  template <class... Args>
  void say(fmt::format_string<Args...> format, Args&&... args) {
    say_line(fmt::format(format, std::forward<Args>(args)...));
  }
  // A line about the present work, for --verbose alone.
  template <class... Args>
  void log(fmt::format_string<Args...> format, Args&&... args) {
    log_line(fmt::format(format, std::forward<Args>(args)...));
  }
  void warn(const std::string& message);

  // The command's JSON object; written only with --json.
  void result(const Json& object);

  // Draws a bar while standard error is a terminal; carries the request to stop.
  [[nodiscard]] Progress progress();
  [[nodiscard]] bool interrupted() const { return interrupt_.stop_token().stop_requested(); }

  // Ends the program: clears the bar, prints an error in one line, returns the exit code. Results that could
  // not be written to standard output count as a failed write. An interrupt that ends the program has told
  // why, and that is not said again.
  int finish(const Status& status);

 private:
  void say_line(const std::string& line);
  void log_line(const std::string& line);

  Interrupt& interrupt_;
  bool json_ = false;
  bool verbose_ = false;
  bool output_failed_ = false;
  std::unique_ptr<ProgressBar> bar_;
};

}  // namespace tidemark::cli
