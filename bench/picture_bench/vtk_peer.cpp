#include "bench/picture_bench/vtk_peer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

extern char** environ;

namespace tidemark::bench {
namespace {

constexpr int kPoints = 1000;  // of a transfer function

// VTK's own form of a transfer function: opacity of a mm and colour at values, and one opacity by gradient
// for all. Primitives whose gradients differ cannot be told apart there: the first one's counts.
nlohmann::json points_of(const renderer::TransferFunction& function, double low, double high) {
  nlohmann::json points = nlohmann::json::array();
  for (int i = 0; i <= kPoints; ++i) {
    const double value = low + (high - low) * i / kPoints;
    glm::dvec3 colour(0.0);
    double opacity = 0.0;
    for (const renderer::SourcePrimitive& one : function.source) {
      const double share = one.opacity * one.value.at(value);
      colour += share * glm::dvec3(one.colour);
      opacity += share;
    }
    if (opacity > 0.0) colour /= opacity;
    points.push_back({value, opacity, colour.r, colour.g, colour.b});
  }
  return points;
}

nlohmann::json gradients_of(const renderer::TransferFunction& function) {
  nlohmann::json points = nlohmann::json::array();
  for (const renderer::SourcePrimitive& one : function.source) {
    if (one.gradient.kind != renderer::TransferFactor::Kind::ramp) continue;
    // With 0 over a range VTK 9.1 leaves out what should show.
    points.push_back({0.0, 0.01});
    points.push_back({one.gradient.start, 0.01});
    points.push_back({one.gradient.end, 1.0});
    break;
  }
  return points;
}

}  // namespace

Result<std::unique_ptr<VtkPeer>> VtkPeer::start(Mapper mapper, const Volume& volume,
                                                const std::filesystem::path& folder,
                                                const std::string& python) {
  const std::vector<float> values = volume.values();
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low < -32768.0F || *high > 32767.0F) {
    return fail(ErrorKind::usage, "the peer draws whole numbers of 16 bits: {} to {} are not", *low, *high);
  }
  std::vector<std::int16_t> voxels(values.size());
  std::transform(values.begin(), values.end(), voxels.begin(),
                 [](float value) { return static_cast<std::int16_t>(std::lround(value)); });
  const std::filesystem::path file = folder / "volume.raw";
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(voxels.data()), static_cast<std::streamsize>(voxels.size() * 2));
  int to[2];
  int from[2];
  if (pipe2(to, O_CLOEXEC) != 0 || pipe2(from, O_CLOEXEC) != 0) return fail(ErrorKind::internal, "no pipe");
  std::vector<std::string> words{python, TIDEMARK_VTK_PEER, mapper == Mapper::opengl ? "opengl" : "processor",
                                 file.string()};
  for (int axis = 0; axis < 3; ++axis) words.push_back(fmt::to_string(volume.geometry.size[axis]));
  for (int axis = 0; axis < 3; ++axis) words.push_back(fmt::to_string(volume.geometry.spacing_mm[axis]));
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, from[1], STDOUT_FILENO);
  std::unique_ptr<VtkPeer> peer(new VtkPeer);
  peer->low_ = *low;
  peer->high_ = *high;
  const int failed =
      posix_spawnp(&peer->process_, python.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(to[0]);
  close(from[1]);
  peer->to_peer_ = to[1];
  peer->from_peer_ = from[0];
  if (failed != 0) return fail(ErrorKind::capability, "{} cannot be started", python);
  const auto hello = peer->ask("");
  if (!hello) return fail(ErrorKind::capability, "{} has no VTK (Debian's python3-vtk9)", python);
  peer->version_ = nlohmann::json::parse(*hello)["version"];
  return peer;
}

VtkPeer::~VtkPeer() {
  if (to_peer_ >= 0) close(to_peer_);
  if (from_peer_ >= 0) close(from_peer_);
  if (process_ > 0) waitpid(process_, nullptr, 0);
}

// Sends a line and returns the next one.
Result<std::string> VtkPeer::ask(const std::string& line) {
  if (!line.empty() && write(to_peer_, line.data(), line.size()) != static_cast<ssize_t>(line.size())) {
    return fail(ErrorKind::internal, "VTK's process has ended");
  }
  std::string answer;
  for (char c = 0; read(from_peer_, &c, 1) == 1;) {
    if (c == '\n') return answer;
    answer += c;
  }
  return fail(ErrorKind::internal, "VTK's process has ended");
}

Result<VtkPeer::Drawing> VtkPeer::draw(const renderer::TransferFunction& function, std::int64_t side,
                                       double step_mm, double half_height_mm, const renderer::Camera& camera,
                                       const std::filesystem::path& file) {
  nlohmann::json command{{"values", points_of(function, low_, high_)},
                         {"gradients", gradients_of(function)},
                         {"side", side},
                         {"step", step_mm},
                         {"azimuth", camera.azimuth},
                         {"elevation", camera.elevation},
                         {"half_height", half_height_mm},
                         {"file", file.string()}};
  const auto answer = ask(command.dump() + "\n");
  if (!answer) return pass_on(answer);
  const nlohmann::json times = nlohmann::json::parse(*answer);
  return Drawing{times["seconds"], times["first"]};
}

}  // namespace tidemark::bench
