// ITK-SNAP's Deep Learning Segmentation server (github.com/pyushkevich/itksnap-dls: itksnap_dls/server.py). A
// session gets the image, then click by click; each click is answered with the whole mask. Its newer paths
// begin with v2/ and know several models; servers without them have the one model nnInteractive.
#include <algorithm>

#include "core/base64.h"
#include "core/json/json.h"
#include "core/json/json_field.h"
#include "imaging/ai/ai_protocol.h"
#include "imaging/ai/packed_bytes.h"
#include "imaging/archive/private_folder.h"
#include "imaging/web/clean_text.h"
#include "imaging/web/form_data.h"
#include "imaging/web/json_answer.h"
#include "imaging/web/web_address.h"

namespace tidemark::imaging {
namespace {

constexpr const char* kJson = "application/json";
constexpr const char* kOnlyModel = "nnInteractive";
constexpr std::size_t kLongestSession = 100;
constexpr std::size_t kLongestReason = 200;
constexpr int kSecondsToEnd = 2;  // what is asked for when all is over

AiModel model_of(const std::string& name) {
  return {name, {}, {{1, clean_text(name)}}, AiModel::Clicks::required};
}

// Becomes part of an address.
bool is_session(const std::string& id) {
  return !id.empty() && id.size() <= kLongestSession && std::ranges::all_of(id, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
}

// Its image stays on the server until it is told that the session is over, whatever has become of it.
class Session {
 public:
  Session(WebServer server, std::string path) : server_(std::move(server)), path_(std::move(path)) {}
  ~Session() {
    server_.timeout_seconds = kSecondsToEnd;
    const auto connection = HttpConnection::open(server_, {});
    if (!connection) return;
    static_cast<void>(
        (*connection)->ask({path_, kJson, kLongestList}, [](const HttpAnswer&, std::string_view) -> Status {
          return {};
        }));
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  WebServer server_;
  std::string path_;
};

class Dls final : public AiProtocol {
 public:
  Dls(HttpConnection& connection, const WebServer& server) : connection_(connection), server_(server) {}

  Result<std::vector<AiModel>> models() override;
  Result<std::vector<float>> segment(const Volume& volume, const AiRequest& request,
                                     const Progress& progress) override;

 private:
  // By the newer paths; nothing where the server does not have them.
  Result<std::optional<std::vector<AiModel>>> listed_models();
  Result<std::string> begin(const std::string& model);
  Status upload(const std::string& session, const Volume& volume, const Progress& progress);
  Result<std::vector<float>> click(const std::string& session, Index3 at, bool inside, std::int64_t voxels);
  // The member `key` of an answer, which the server has unless it refuses.
  Result<std::string> member_of(const std::string& text, const char* key, std::size_t longest);
  Result<std::vector<float>> mask_in(const std::string& text, std::int64_t voxels);
  [[nodiscard]] std::string path(const std::string& behind) const { return prefix_ + behind; }

  HttpConnection& connection_;
  const WebServer server_;
  std::string prefix_ = "v2/";
};

Result<std::optional<std::vector<AiModel>>> Dls::listed_models() {
  std::string text;
  const auto answer = connection_.ask({"v2/models", kJson, kLongestList},
                                      [&](const HttpAnswer&, std::string_view bytes) -> Status {
                                        text += bytes;
                                        return {};
                                      });
  if (!answer) return pass_on(answer);
  constexpr int kNotFound = 404;
  if (answer->status == kNotFound) return std::optional<std::vector<AiModel>>();
  if (!answer->is_good()) return tl::unexpected<Error>(refusal_of(connection_, *answer));
  const auto document = JsonDocument::parse(text, connection_.peer());
  if (!document) return pass_on(document);
  const JsonField root = root_of(*document, connection_.peer());
  const JsonField list = root.at("models");
  std::vector<AiModel> models;
  for (std::size_t i = 0; i < list.size(kMostModels); ++i) {
    const JsonField one = list.at(i);
    const std::string name = one.at("id").text(kLongestAiName);
    if (one.has("dimensions") && one.at("dimensions").integer(0, 100) != 3) continue;
    bool takes_points = false;
    const JsonField ways = one.at("interactions");
    for (std::size_t way = 0; way < ways.size(kMostLabels); ++way) {
      takes_points = takes_points || ways.at(way).text(kLongestAiName) == "point";
    }
    if (takes_points) models.push_back(model_of(name));
  }
  if (!root.good()) return pass_on(root.status());
  return std::optional(std::move(models));
}

Result<std::vector<AiModel>> Dls::models() {
  auto listed = listed_models();
  if (!listed) return pass_on(listed);
  if (*listed) return std::move(**listed);
  const auto text = ask_for_json(connection_, {"status", kJson, kLongestList});
  if (!text) return pass_on(text);
  const auto status = member_of(*text, "status", kLongestAiName);
  if (!status) return pass_on(status);
  return std::vector<AiModel>{model_of(kOnlyModel)};
}

Result<std::string> Dls::member_of(const std::string& text, const char* key, std::size_t longest) {
  JsonLimits limits;
  limits.bytes = std::max(limits.bytes, text.size());
  const auto document = JsonDocument::parse(text, connection_.peer(), limits);
  if (!document) return pass_on(document);
  const JsonField root = root_of(*document, connection_.peer());
  if (root.has("error")) {
    return fail(ErrorKind::input, "{}: refuses: {}", connection_.peer(),
                clean_text(root.at("error").text(kLongestReason)));
  }
  std::string member = root.at(key).text(longest);
  if (!root.good()) return pass_on(root.status());
  return member;
}

Result<std::string> Dls::begin(const std::string& model) {
  const std::string start = prefix_.empty() ? "start_session" : "v2/start_session/" + escaped(model, "");
  const auto text = ask_for_json(connection_, {start, kJson, kLongestList});
  if (!text) return pass_on(text);
  auto session = member_of(*text, "session_id", kLongestSession);
  if (session && !is_session(*session)) {
    return fail(ErrorKind::input, "{}: begins a session by a name that is none", connection_.peer());
  }
  return session;
}

// The sizes stand in the order i, j, k; i runs fastest in the bytes.
Status Dls::upload(const std::string& session, const Volume& volume, const Progress& progress) {
  const auto folder = PrivateFolder::create();
  if (!folder) return pass_on(folder);
  const std::filesystem::path file = folder->path() / "image.gz";
  TIDEMARK_TRY(pack_values(volume, file, progress));
  auto bytes = FileBytes::open(file);
  if (!bytes) return pass_on(bytes);
  ReportedBytes reported(*bytes, progress);
  const Geometry& grid = volume.geometry;
  const Json metadata{{"dimensions", {grid.size.x, grid.size.y, grid.size.z}},
                      {"spacing", {grid.spacing_mm.x, grid.spacing_mm.y, grid.spacing_mm.z}},
                      {"components_per_pixel", 1},
                      {"component_type", "float32"}};
  FormData form;
  form.add("metadata", metadata.dump());
  form.add_file("file", "image.gz", "application/gzip", reported);
  HttpRequest post{path("upload_raw/" + session), kJson, kLongestList, form.type()};
  post.body = form.body();
  const auto text = ask_for_json(connection_, post);
  if (!text) return pass_on(text);
  const auto taken = member_of(*text, "message", kLongestReason);
  if (!taken) return pass_on(taken);
  return {};
}

// A byte a voxel, packed, as Base64.
Result<std::vector<float>> Dls::mask_in(const std::string& text, std::int64_t voxels) {
  const auto result = member_of(text, "result", text.size());
  if (!result) return pass_on(result);
  const auto packed = from_base64(*result);
  const auto mask = packed ? unpacked(*packed, voxels) : std::nullopt;
  if (!mask) {
    return fail(ErrorKind::input, "{}: its answer is no mask of {} voxels packed by gzip", connection_.peer(),
                voxels);
  }
  return std::vector<float>(mask->begin(), mask->end());
}

Result<std::vector<float>> Dls::click(const std::string& session, Index3 at, bool inside,
                                      std::int64_t voxels) {
  const std::string where = prefix_.empty() ? fmt::format("x={}&y={}&z={}", at.x, at.y, at.z)
                                            : fmt::format("point={}&point={}&point={}", at.x, at.y, at.z);
  const std::string resource =
      path(fmt::format("process_point_interaction/{}?{}&foreground={}", session, where, inside));
  const auto text = ask_for_json(connection_, {resource, kJson, 2 * voxels + kLongestList});
  if (!text) return pass_on(text);
  return mask_in(*text, voxels);
}

Result<std::vector<float>> Dls::segment(const Volume& volume, const AiRequest& request,
                                        const Progress& progress) {
  const auto listed = listed_models();
  if (!listed) return pass_on(listed);
  if (!*listed) prefix_.clear();
  const auto id = begin(request.model.name);
  if (!id) return pass_on(id);
  const Session session(server_, path("end_session/" + *id));
  TIDEMARK_TRY(upload(*id, volume, progress));
  const std::int64_t voxels = volume.geometry.voxel_count();
  const AiClicks& clicks = request.clicks;
  const auto count = static_cast<double>(clicks.inside.size() + clicks.outside.size());
  double done = 0.0;
  Result<std::vector<float>> mask = std::vector<float>();
  for (const bool inside : {true, false}) {
    for (const Index3 at : inside ? clicks.inside : clicks.outside) {
      progress(done++ / count, "waiting for the model");
      mask = click(*id, at, inside, voxels);
      if (!mask) return mask;
    }
  }
  return mask;
}

}  // namespace

std::unique_ptr<AiProtocol> dls(HttpConnection& connection, const WebServer& server) {
  return std::make_unique<Dls>(connection, server);
}

}  // namespace tidemark::imaging
