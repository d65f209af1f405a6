// How long DICOM takes: a folder of many small files to be listed, and a large CT to be loaded, against ITK
// with GDCM. Each measurement is a process of its own, so that processor time and the peak of memory are its
// own. See docs/performance.md.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <stdexcept>

#include "bench/dicom_bench/itk_reader.h"
#include "bench/dicom_bench/studies.h"
#include "core/stopwatch.h"
#include "imaging/load_study.h"

using namespace tidemark;
namespace fs = std::filesystem;

namespace {

struct Cost {
  double wall = 0.0;       // s
  double processor = 0.0;  // s, user and system
  double peak = 0.0;       // bytes
};

constexpr const char* kNothing = "nothing";
constexpr const char* kTidemark = "tidemark";
constexpr const char* kItk = "itk";
constexpr const char* kList = "list";

// The work of a process of its own.
int measure(const std::string& what, const fs::path& folder) {
  std::int64_t sum = 0;
  if (what == kItk) sum = bench::read_with_itk(folder);
  if (what == kTidemark) {
    const auto volume = imaging::load_volume(folder);
    if (!volume) throw std::runtime_error(volume.error().message);
    const auto& voxels = std::get<std::vector<std::int16_t>>(volume->voxels);
    sum = std::accumulate(voxels.begin(), voxels.end(), std::int64_t{0});
  }
  if (what == kList) {
    // The longest time without a word.
    Stopwatch watch;
    double silence = 0.0;
    Progress progress;
    progress.report = [&](double, std::string_view) {
      silence = std::max(silence, watch.seconds());
      watch.restart();
    };
    const auto found = imaging::find_series(folder, progress);
    if (!found) throw std::runtime_error(found.error().message);
    fmt::print("{} series, {:.0f} ms at most without progress\n", found->series.size(), 1e3 * silence);
    return 0;
  }
  if (what != kNothing) fmt::print("  {}: sum of voxels {}\n", what, sum);
  return 0;
}

Cost run(const char* program, const std::string& what, const fs::path& folder) {
  std::fflush(stdout);
  const Stopwatch watch;
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl(program, program, "--measure", what.c_str(), "--folder", folder.c_str(), nullptr);
    std::_Exit(127);
  }
  int status = 0;
  rusage used{};
  if (child < 0 || ::wait4(child, &status, 0, &used) != child || status != 0) {
    throw std::runtime_error(what + " did not end well");
  }
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {watch.seconds(), seconds(used.ru_utime) + seconds(used.ru_stime),
          1024.0 * static_cast<double>(used.ru_maxrss)};
}

// The least of several rounds: the first one also reads the disk.
Cost best_of(int rounds, const char* program, const std::string& what, const fs::path& folder) {
  Cost best = run(program, what, folder);
  for (int round = 1; round < rounds; ++round) {
    const Cost cost = run(program, what, folder);
    best = {std::min(best.wall, cost.wall), std::min(best.processor, cost.processor),
            std::min(best.peak, cost.peak)};
  }
  return best;
}

void compare(const char* program, const char* title, const fs::path& folder, int slices, int rounds) {
  const double volume = 512.0 * 512.0 * 2.0 * slices;
  const double base = run(program, kNothing, folder).peak;
  const Cost ours = best_of(rounds, program, kTidemark, folder);
  const Cost itk = best_of(rounds, program, kItk, folder);
  fmt::print("{}, 512 x 512 x {}\n", title, slices);
  for (const auto& [name, cost] : {std::pair{"Tidemark", ours}, {"ITK and GDCM", itk}}) {
    fmt::print("  {:<13} {:6.2f} s, {:6.2f} s of processor time, memory beyond the volume {:4.0f} %\n", name,
               cost.wall, cost.processor, 100.0 * (cost.peak - base - volume) / volume);
  }
  fmt::print("  ratio         {:6.2f}    {:6.2f}\n", itk.wall / ours.wall, itk.processor / ours.processor);
}

struct Options {
  std::string measured;
  std::string folder;
  int files = 20'000;
  int slices = 400;
  int rounds = 3;
};

int compare_all(const char* program, const Options& options) {
  std::string pattern = (fs::temp_directory_path() / "dicom-bench-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error(pattern + ": cannot be made");
  const fs::path folder = pattern;
  try {
    bench::write_small_files(folder / "small", options.files);
    const Cost listed = best_of(options.rounds, program, kList, folder / "small");
    fmt::print("{} files listed: {:.2f} s, {:.2f} s of processor time\n", options.files, listed.wall,
               listed.processor);
    bench::write_ct(folder / "plain", options.slices);
    compare(program, "uncompressed", folder / "plain", options.slices, options.rounds);
    bench::write_compressed(folder / "plain", folder / "jpeg");
    fs::remove_all(folder / "plain");
    compare(program, "JPEG lossless", folder / "jpeg", options.slices, options.rounds);
  } catch (...) {
    fs::remove_all(folder);
    throw;
  }
  fs::remove_all(folder);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How long DICOM takes, against ITK with GDCM");
  Options options;
  app.add_option("--files", options.files, "Small files that are listed");
  app.add_option("--slices", options.slices, "Of the CT");
  app.add_option("--rounds", options.rounds, "The best of which counts");
  app.add_option("--measure", options.measured)->group("");
  app.add_option("--folder", options.folder)->group("");
  CLI11_PARSE(app, argc, argv);
  try {
    if (options.measured.empty()) return compare_all("/proc/self/exe", options);
    return measure(options.measured, options.folder);
  } catch (const std::exception& error) {
    fmt::print(stderr, "dicom_bench: {}\n", error.what());
    return 1;
  }
}
