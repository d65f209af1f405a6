#include "tests/imaging/ai/model_server.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "core/atomic_file.h"

namespace tidemark::test {
namespace {

constexpr int kLongestStart = 60'000;  // ms, also on a busy machine
constexpr std::int16_t kAirValue = -100;
constexpr std::int16_t kDim = 400;
constexpr std::int16_t kBright = 900;
constexpr double kRadius = 6.0;  // mm

}  // namespace

ModelServer::ModelServer(const std::string& protocol) {
  process_.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  process_.start("python3", {TIDEMARK_MODEL_SERVER, QString::fromStdString(protocol),
                             QString::fromStdString(requests_.path().string())});
  while (!process_.canReadLine()) {
    if (!process_.waitForReadyRead(kLongestStart)) qFatal("model_server.py does not serve");
  }
  const int port = process_.readLine().trimmed().toInt();
  server_.name = "models";
  server_.protocol =
      protocol == "monai-label" ? imaging::AiServer::Protocol::monai_label : imaging::AiServer::Protocol::dls;
  server_.access.url = fmt::format("http://127.0.0.1:{}", port);
  server_.timeout_seconds = 60;
}

ModelServer::~ModelServer() {
  process_.kill();
  process_.waitForFinished(5000);
}

std::string ModelServer::heard() const {
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(requests_.path())) files.insert(entry.path());
  std::string all;
  for (const auto& file : files) all += bytes_of(file).toStdString();
  return all;
}

void ModelServer::write_configuration(const std::filesystem::path& file) const {
  const char* protocol = server_.protocol == imaging::AiServer::Protocol::monai_label ? "monai-label" : "dls";
  std::filesystem::create_directories(file.parent_path());
  const Status written =
      write_file(file, fmt::format(R"({{"servers": [{{"name": "{}", "protocol": "{}", "url": "{}"}}]}})",
                                   server_.name, protocol, server_.access.url));
  if (!written) qFatal("%s", written.error().message.c_str());
}

imaging::AiModel model_of(const imaging::AiServer& server, const std::string& name) {
  const auto models = imaging::ai_models(server);
  if (!models) qFatal("%s", models.error().message.c_str());
  const auto found =
      std::ranges::find_if(*models, [&](const imaging::AiModel& one) { return one.name == name; });
  if (found == models->end()) qFatal("there is no model %s", name.c_str());
  return *found;
}

Volume oblique_balls() {
  Volume volume;
  volume.geometry.size = {33, 20, 11};
  volume.geometry.spacing_mm = {0.8, 1.1, 2.5};
  const glm::dmat4 turned =
      glm::rotate(glm::rotate(glm::dmat4(1.0), 0.4, {0.0, 0.0, 1.0}), 0.3, {1.0, 0.0, 0.0});
  volume.geometry.direction = glm::dmat3(turned);
  volume.geometry.origin_mm = {-31.5, 12.25, 104.0};
  volume.description = "Phantom^Paula";
  std::vector<std::int16_t> voxels;
  for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
    const glm::dvec3 here = volume.geometry.to_patient(glm::dvec3(volume.geometry.voxel_at(offset)));
    const auto is_in = [&](Index3 middle) {
      return glm::distance(here, volume.geometry.to_patient(glm::dvec3(middle))) < kRadius;
    };
    voxels.push_back(is_in(kDimBall) ? kDim : is_in(kBrightBall) ? kBright : kAirValue);
  }
  volume.voxels = std::move(voxels);
  return volume;
}

Mask voxels_of(const Volume& volume, float value) {
  Mask mask{volume.geometry, {}};
  for (const float here : volume.values()) mask.voxels.push_back(here == value ? 1 : 0);
  return mask;
}

}  // namespace tidemark::test
