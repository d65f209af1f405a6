// The REST interface of MONAI Label (github.com/Project-MONAI/MONAILabel: monailabel/endpoints/info.py and
// infer.py). GET info/ lists models; POST infer/MODEL takes the image as a file of a form, with the clicks in
// its parameters, and answers with the label image.
#include <fstream>

#include "core/json/json.h"
#include "core/json/json_field.h"
#include "imaging/ai/ai_protocol.h"
#include "imaging/archive/private_folder.h"
#include "imaging/files/volume_file.h"
#include "imaging/onto_grid.h"
#include "imaging/web/clean_text.h"
#include "imaging/web/form_data.h"
#include "imaging/web/json_answer.h"
#include "imaging/web/web_address.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr int kHighestNumber = 255;
constexpr const char* kBackground = "background";
constexpr std::int64_t kBytesAVoxel = 8;  // a value is at most a double

Json to_json(const std::vector<Index3>& clicks) {
  Json list = Json::array();
  for (const Index3 v : clicks) list.push_back({v.x, v.y, v.z});
  return list;
}

// Lists have names in the order of their numbers; objects say the numbers, where they are numbers.
std::vector<AiLabel> read_labels(const JsonField& field) {
  std::vector<AiLabel> labels;
  const auto add = [&](std::int64_t number, const std::string& name) {
    std::string clean = clean_text(name);
    if (number < 1 || number > kHighestNumber || clean.empty() || clean == kBackground) return;
    labels.push_back({static_cast<int>(number), std::move(clean)});
  };
  if (field.is_list()) {
    std::int64_t number = 1;
    for (std::size_t i = 0; i < field.size(kMostLabels); ++i) {
      const std::string name = field.at(i).text(kLongestAiName);
      if (name != kBackground) add(number++, name);
    }
  } else {
    for (const std::string& name : field.names(kMostLabels)) {
      const JsonField number = field.at(name.c_str());
      if (number.is_number()) add(number.integer(0, std::int64_t{1} << 31), name);
    }
  }
  return labels;
}

// Nothing where it takes something else than a volume and clicks.
std::optional<AiModel> read_model(const std::string& name, const JsonField& info) {
  const std::string type = info.has("type") ? info.at("type").text(kLongestAiName) : std::string();
  const std::int64_t dimension = info.has("dimension") ? info.at("dimension").integer(0, 100) : 3;
  if (dimension != 3 || type == "scribbles" || type == "classification" || type == "annotation")
    return std::nullopt;
  AiModel model;
  model.name = name;
  if (info.has("description")) model.description = clean_text(info.at("description").text());
  if (info.has("labels")) model.labels = read_labels(info.at("labels"));
  if (type == "deepgrow") model.clicks = AiModel::Clicks::required;
  if (type == "deepedit" || type == "others") model.clicks = AiModel::Clicks::optional;
  return model;
}

// Of a file that is one of ours, which nobody knows by its name.
std::string without_path(const std::string& message, const fs::path& file) {
  const std::string begin = file.string() + ": ";
  return message.starts_with(begin) ? message.substr(begin.size()) : message;
}

class MonaiLabel final : public AiProtocol {
 public:
  explicit MonaiLabel(HttpConnection& connection) : connection_(connection) {}

  Result<std::vector<AiModel>> models() override;
  Result<std::vector<float>> segment(const Volume& volume, const AiRequest& request,
                                     const Progress& progress) override;

 private:
  // The answer as a file in the folder, by the suffix that its bytes call for.
  Result<fs::path> infer(const fs::path& image, const AiRequest& request, const fs::path& folder,
                         std::int64_t voxels, const Progress& progress);
  Result<std::vector<float>> read(const fs::path& file, const Geometry& grid, const Progress& progress);
  [[nodiscard]] static std::string parameters(const AiRequest& request);

  HttpConnection& connection_;
};

Result<std::vector<AiModel>> MonaiLabel::models() {
  const auto text = ask_for_json(connection_, {"info/", "application/json", kLongestList});
  if (!text) return pass_on(text);
  const auto document = JsonDocument::parse(*text, connection_.peer());
  if (!document) return pass_on(document);
  const JsonField root = root_of(*document, connection_.peer());
  const JsonField all = root.at("models");
  std::vector<AiModel> models;
  for (const std::string& name : all.names(kMostModels)) {
    if (auto model = read_model(name, all.at(name.c_str()))) models.push_back(std::move(*model));
  }
  if (!root.good()) return pass_on(root.status());
  return models;
}

// Deepgrow has clicks as foreground and background; DeepEdit those inside by the name of their label.
std::string MonaiLabel::parameters(const AiRequest& request) {
  std::string label = request.label;
  if (label.empty() && !request.model.labels.empty()) label = request.model.labels.front().name;
  Json json = Json::object();
  for (const AiLabel& one : request.model.labels) json[one.name] = Json::array();
  if (!label.empty()) json[label] = to_json(request.clicks.inside);
  json["foreground"] = to_json(request.clicks.inside);
  json[kBackground] = to_json(request.clicks.outside);
  json["label"] = label;
  json["result_extension"] = ".nii.gz";
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<fs::path> MonaiLabel::infer(const fs::path& image, const AiRequest& request, const fs::path& folder,
                                   std::int64_t voxels, const Progress& progress) {
  auto bytes = FileBytes::open(image);
  if (!bytes) return pass_on(bytes);
  ReportedBytes reported(*bytes, progress);
  FormData form;
  form.add("params", parameters(request));
  form.add_file("file", "image.nii", "application/octet-stream", reported);
  // The answer is the image alone, so that its body is one file.
  HttpRequest post{"infer/" + escaped(request.model.name, "") + "?output=image", "*/*",
                   voxels * kBytesAVoxel + kLongestList, form.type()};
  post.body = form.body();
  const fs::path file = folder / "answer";
  std::ofstream out(file, std::ios::binary);
  std::string begin;  // of the answer
  const auto answer = connection_.ask(post, [&](const HttpAnswer&, std::string_view more) -> Status {
    begin += more.substr(0, 4 - std::min<std::size_t>(4, begin.size()));
    out.write(more.data(), static_cast<std::streamsize>(more.size()));
    if (!out) return fail(ErrorKind::write, "{}: cannot be written: is the disk full?", folder.string());
    return {};
  });
  if (!answer) return pass_on(answer);
  if (!answer->is_good()) return tl::unexpected<Error>(refusal_of(connection_, *answer));
  out.close();
  if (!out) return fail(ErrorKind::write, "{}: cannot be written: is the disk full?", folder.string());
  if (answer->content_type.starts_with("text/") || answer->content_type.find("json") != std::string::npos) {
    return fail(ErrorKind::input, "{}: answers with '{}', which is not an image", connection_.peer(),
                clean_text(answer->content_type.substr(0, 100)));
  }
  const char* suffix = begin.starts_with("\x1f\x8b") ? ".nii.gz" : begin == "NRRD" ? ".nrrd" : ".nii";
  fs::path named = file;
  named += suffix;
  std::error_code error;
  fs::rename(file, named, error);
  if (error) return fail(ErrorKind::write, "{}: {}", named.string(), error.message());
  return named;
}

Result<std::vector<float>> MonaiLabel::read(const fs::path& file, const Geometry& grid,
                                            const Progress& progress) {
  const auto unreadable = [&](const std::string& why) {
    return fail(ErrorKind::input, "{}: its answer is no image that can be read: {}", connection_.peer(),
                without_path(why, file));
  };
  // The header comes first: of another grid no voxel is unpacked.
  const auto header = scan_volume_file(file);
  if (!header) return unreadable(header.error().message);
  if (!header->loadable) return unreadable(header->reason);
  if (header->geometry.voxel_count() != grid.voxel_count()) {
    return fail(ErrorKind::input, "{}: its answer has a grid of {}, and the image that was sent {}",
                connection_.peer(), describe(header->geometry), describe(grid));
  }
  const auto volume = read_volume_file(file, progress);
  if (!volume) {
    if (volume.error().kind == ErrorKind::cancelled) return pass_on(volume);
    return unreadable(volume.error().message);
  }
  return onto_grid(*volume, grid, connection_.peer());
}

Result<std::vector<float>> MonaiLabel::segment(const Volume& volume, const AiRequest& request,
                                               const Progress& progress) {
  progress(-1.0, "writing the image");
  const auto folder = PrivateFolder::create();
  if (!folder) return pass_on(folder);
  const fs::path image = folder->path() / "image.nii";
  TIDEMARK_TRY(write_volume_file(volume, image, UnknownSides::stated));
  const auto file = infer(image, request, folder->path(), volume.geometry.voxel_count(), progress);
  if (!file) return pass_on(file);
  progress(-1.0, "reading the answer");
  return read(*file, volume.geometry, progress);
}

}  // namespace

std::unique_ptr<AiProtocol> monai_label(HttpConnection& connection) {
  return std::make_unique<MonaiLabel>(connection);
}

}  // namespace tidemark::imaging
