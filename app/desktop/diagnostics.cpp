#include "app/desktop/diagnostics.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string_view>
#include <thread>

namespace tidemark::desktop {
namespace {

// The rest of the first line of `path` that begins with `key`, without quotation marks; "" when there is
// none.
std::string value_in_file(const char* path, std::string_view key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    line.erase(0, key.size());
    std::erase(line, '"');
    return line;
  }
  return {};
}

std::int64_t memory_in_bytes(std::string_view key) {
  const std::string kilobytes = value_in_file("/proc/meminfo", key);
  return kilobytes.empty() ? 0 : std::strtoll(kilobytes.c_str(), nullptr, 10) * 1024;
}

std::string gigabytes(std::int64_t bytes) {
  return bytes > 0 ? fmt::format("{:.1f} GB", static_cast<double>(bytes) / 1e9) : "unknown";
}

void add(std::string& all, std::string_view name, std::string_view value) {
  fmt::format_to(std::back_inserter(all), "{:<20}{}\n", fmt::format("{}:", name),
                 value.empty() ? "unknown" : value);
}

void add_graphics(std::string& all, const Diagnostics& d) {
  add(all, "renderer", d.renderer.empty() ? "" : fmt::format("{}, as {}", d.renderer, d.renderer_reason));
  if (!d.renderer_problem.empty()) add(all, "renderer problem", d.renderer_problem);
  add(all, "graphics", d.graphics);
  if (!d.graphics_problem.empty()) add(all, "graphics problem", d.graphics_problem);
  if (!d.opengl) return;
  add(all, "opengl vendor", d.opengl->vendor);
  add(all, "opengl renderer", d.opengl->renderer);
  add(all, "opengl version", d.opengl->version);
  add(all, "largest 3d texture", fmt::format("{} voxels along an axis", d.opengl->largest_volume_texture));
  add(all, "largest 2d texture", fmt::format("{} texels along an axis", d.opengl->largest_texture));
  add(all, "compute shaders", d.opengl->at_least(4, 5) ? "yes" : "no");
  add(all, "reset reported", d.opengl->reset_reported ? "yes" : "no");
}

}  // namespace

void describe_machine(Diagnostics& diagnostics) {
  diagnostics.system = value_in_file("/etc/os-release", "PRETTY_NAME=");
  utsname names{};
  if (uname(&names) == 0) {
    diagnostics.architecture = names.machine;
    diagnostics.system +=
        fmt::format("{}{} {}", diagnostics.system.empty() ? "" : ", ", names.sysname, names.release);
  }
  diagnostics.processors = static_cast<int>(std::thread::hardware_concurrency());
  diagnostics.memory_bytes = memory_in_bytes("MemTotal:");
  diagnostics.free_memory_bytes = memory_in_bytes("MemAvailable:");
}

std::string text(const Diagnostics& d) {
  std::string all;
  add(all, "tidemark", d.version);
  add(all, "qt", d.qt_version);
  add(all, "qt platform", d.qt_platform);
  add(all, "locale", d.locale);
  add_graphics(all, d);
  add(all, "automatic executor", fmt::format("{}, as {}", d.automatic_executor, d.executor_reason));
  add(all, "instruction set", d.instruction_set);
  add(all, "system", d.system);
  add(all, "architecture", d.architecture);
  add(all, "processors", d.processors > 0 ? fmt::to_string(d.processors) : "");
  add(all, "memory", gigabytes(d.memory_bytes));
  add(all, "free memory", gigabytes(d.free_memory_bytes));
  return all;
}

}  // namespace tidemark::desktop
