// The text of `tidemark --diagnostics`: the facts about the machine that a report of a problem needs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "gpu/capabilities.h"

namespace tidemark::desktop {

// Holds nothing about patients, users or files, so that it can be sent to anyone unchanged.
struct Diagnostics {
  std::string version;      // of Tidemark
  std::string qt_version;   // the one that runs, not the one that was built with
  std::string qt_platform;  // "xcb", "wayland"
  std::string locale;

  std::string graphics;          // the outcome: "hardware", "software" or "none"
  std::string graphics_problem;  // why not more; may be empty
  std::optional<gpu::Capabilities> opengl;
  std::string renderer;          // who draws: "gl" or "host"
  std::string renderer_reason;   // why
  std::string renderer_problem;  // what is wrong with how it was asked for; may be empty

  std::string automatic_executor;  // the choice of `auto` here: "compute" or "host"
  std::string executor_reason;     // why
  std::string instruction_set;     // of the host executor

  std::string system;  // from here on: see describe_machine()
  std::string architecture;
  int processors = 0;
  std::int64_t memory_bytes = 0;  // 0: not known
  std::int64_t free_memory_bytes = 0;
};

// Fills in the facts of the operating system; never the machine's name.
void describe_machine(Diagnostics& diagnostics);

// One "name: value" a line, in English whatever the locale.
std::string text(const Diagnostics& diagnostics);

}  // namespace tidemark::desktop
