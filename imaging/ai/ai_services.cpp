#include "imaging/ai/ai_services.h"

#include <algorithm>
#include <cmath>

#include "core/json/json_field.h"
#include "imaging/ai/ai_protocol.h"
#include "imaging/web/clean_text.h"
#include "imaging/web/web_address.h"

namespace tidemark::imaging {
namespace {

constexpr float kHighestLabel = 255.0F;
constexpr float kInside = 0.5F;  // of a probability
constexpr std::size_t kLongestDetail = 200;

WebServer web_server_of(const AiServer& server) {
  return {"AI server " + server.name, server.access, server.tls, server.timeout_seconds};
}

// The connection, and who speaks on it.
struct Conversation {
  std::unique_ptr<HttpConnection> connection;
  std::unique_ptr<AiProtocol> protocol;
};

Result<Conversation> open(const AiServer& server, const std::stop_token& stop) {
  TIDEMARK_TRY(check_ai_server(server));
  const WebServer web = web_server_of(server);
  auto connection = HttpConnection::open(web, stop);
  if (!connection) return pass_on(connection);
  Conversation conversation{std::move(*connection), nullptr};
  conversation.protocol = server.protocol == AiServer::Protocol::dls ? dls(*conversation.connection, web)
                                                                     : monai_label(*conversation.connection);
  return conversation;
}

Status check_clicks(const AiRequest& request, const Geometry& grid) {
  for (const auto* clicks : {&request.clicks.inside, &request.clicks.outside}) {
    for (const Index3 v : *clicks) {
      if (grid.contains(v)) continue;
      return fail(ErrorKind::usage, "the click at voxel {}, {}, {} is outside of the volume of {} x {} x {}",
                  v.x, v.y, v.z, grid.size.x, grid.size.y, grid.size.z);
    }
  }
  if (request.model.clicks == AiModel::Clicks::required && request.clicks.inside.empty()) {
    return fail(ErrorKind::usage, "the model {} needs a click inside of what it is to find",
                request.model.name);
  }
  return {};
}

// Whether the values are a probability. Fails on what is neither that nor labels.
Result<bool> check_values(const AiAnswer& answer, const std::string& peer, const std::string& model) {
  bool has_labels = true;
  bool is_probability = true;
  bool is_empty = true;
  for (std::size_t at = 0; at < answer.values.size(); ++at) {
    const float value = answer.values[at];
    has_labels = has_labels && value >= 0.0F && value <= kHighestLabel && value == std::floor(value);
    is_probability = is_probability && value >= 0.0F && value <= 1.0F;
    is_empty = is_empty && value == 0.0F;
    if (has_labels || is_probability) continue;
    const Index3 v = answer.geometry.voxel_at(static_cast<std::int64_t>(at));
    return fail(ErrorKind::input,
                "{}: answers with {} at voxel {}, {}, {}: the values are neither labels nor a probability",
                peer, value, v.x, v.y, v.z);
  }
  if (is_empty) return fail(ErrorKind::input, "{}: the model {} has found nothing", peer, model);
  return !has_labels;
}

}  // namespace

std::size_t ReportedBytes::read(std::int64_t offset, std::span<std::uint8_t> room) {
  const std::size_t got = bytes_.read(offset, room);
  const std::int64_t sent = offset + static_cast<std::int64_t>(got);
  if (sent >= size()) {
    progress_(-1.0, "waiting for the model");
  } else {
    progress_(static_cast<double>(sent) / static_cast<double>(size()), "sending the image");
  }
  return got;
}

Error refusal_of(const HttpConnection& connection, const HttpAnswer& answer) {
  Error error = connection.error(answer);
  const auto document = JsonDocument::parse(answer.refusal, connection.peer());
  if (!document) return error;
  const JsonField root = root_of(*document, connection.peer());
  if (!root.has("detail") || !root.at("detail").is_text()) return error;
  const std::string detail =
      clean_text(root.at("detail").text(answer.refusal.size()).substr(0, kLongestDetail));
  if (!detail.empty()) error.message += ": " + detail;
  return error;
}

Result<std::vector<AiModel>> ai_models(const AiServer& server, const Progress& progress) {
  progress(-1.0, "asking the server");
  const auto conversation = open(server, progress.stop);
  if (!conversation) return pass_on(conversation);
  return conversation->protocol->models();
}

Result<AiAnswer> ai_segment(const AiServer& server, const Volume& volume, const AiRequest& request,
                            const Progress& progress) {
  TIDEMARK_TRY(check_clicks(request, volume.geometry));
  progress(-1.0, "calling the server");
  const auto conversation = open(server, progress.stop);
  if (!conversation) return pass_on(conversation);
  auto values = conversation->protocol->segment(volume, request, progress);
  const std::string& url = server.access.url;
  record_audit({.kind = AuditEvent::Kind::exported,
                .failure = values ? std::string() : values.error().message,
                .peer = {host_of(url), url, {}, {}},
                .is_deidentified = true},
               request.studies);
  if (!values) return pass_on(values);
  AiAnswer answer{volume.geometry, std::move(*values), false, request.model.labels};
  const auto is_probability = check_values(answer, conversation->connection->peer(), request.model.name);
  if (!is_probability) return pass_on(is_probability);
  answer.is_probability = *is_probability;
  return answer;
}

Result<Segments> segments_of(const AiAnswer& answer, const std::string& name) {
  if (answer.is_probability) return segments_of(mask_of(answer), name);
  auto segments = segments_of_numbers(answer.geometry, answer.values, name);
  if (!segments) return segments;
  if (answer.labels.empty() && segments->list.size() == 1) segments->list.front().name = name;
  for (Segment& segment : segments->list) {
    for (const AiLabel& label : answer.labels) {
      if (segment.name == fmt::format("Segment {}", label.number)) {
        segment.name = label.name;
        break;
      }
    }
  }
  return segments;
}

std::vector<float> map_of(const AiAnswer& answer, int label) {
  if (answer.is_probability) return answer.values;
  std::vector<float> map(answer.values.size());
  std::transform(answer.values.begin(), answer.values.end(), map.begin(), [label](float value) {
    return (label == 0 ? value > 0.0F : value == static_cast<float>(label)) ? 1.0F : 0.0F;
  });
  return map;
}

Mask mask_of(const AiAnswer& answer, int label) {
  const std::vector<float> map = map_of(answer, label);
  Mask mask{answer.geometry, std::vector<std::uint8_t>(map.size())};
  std::transform(map.begin(), map.end(), mask.voxels.begin(),
                 [](float value) { return static_cast<std::uint8_t>(value >= kInside ? 1 : 0); });
  return mask;
}

}  // namespace tidemark::imaging
