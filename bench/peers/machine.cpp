#include <fmt/chrono.h>
#include <fmt/format.h>
#include <itkVersion.h>
#include <openvdb/version.h>

#include <ctime>
#include <fstream>
#include <sstream>

#include "bench/peers/measurements.h"
#include "core/thread_pool.h"

namespace tidemark::bench {
namespace {

// The value of the first line of /proc/cpuinfo with this name.
std::string cpu_field(std::string_view name) {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with(name)) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

bool has_feature(std::string_view feature) {
  std::istringstream flags(cpu_field("flags"));
  for (std::string flag; flags >> flag;) {
    if (flag == feature) return true;
  }
  return false;
}

}  // namespace

bool has_avx512() {
  // What Highway's AVX3 target asks for, as /proc/cpuinfo names it.
  return has_feature("avx512f") && has_feature("avx512bw") && has_feature("avx512dq") &&
         has_feature("avx512vl") && has_feature("avx512cd");
}

void describe_machine(Report& report) {
  std::string lacking;
  for (const auto& [flag, name] : {std::pair{"sse4_2", "SSE4"}, {"avx2", "AVX2"}}) {
    if (!has_feature(flag)) lacking += fmt::format("{} ", name);
  }
  if (!has_avx512()) lacking += "AVX-512 ";
  report.table(
      "Machine", {"what", "value"},
      {{text("processor"), text(cpu_field("model name"))},
       {text("processors available"), number(available_processors())},
       {text("instruction sets it lacks"), text(lacking.empty() ? "none of SSE4, AVX2, AVX-512" : lacking)},
       {text("date"), text(fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))))},
       {text("compiler"), text(__VERSION__)},
       {text("ITK"), text(itk::Version::GetITKVersion())},
       {text("OpenVDB"), text(openvdb::getLibraryVersionString())}});
}

}  // namespace tidemark::bench
