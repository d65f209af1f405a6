#include "document/session_file.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "core/atomic_file.h"
#include "core/bit_mask.h"
#include "document/curve_json.h"
#include "document/drive_json.h"
#include "document/field_bytes.h"
#include "document/file_limits.h"
#include "document/history_file.h"
#include "document/recipe_json.h"
#include "document/session_drives.h"
#include "document/zip_archive.h"

namespace tidemark::document {
namespace {

constexpr std::string_view kJson = "session.json";
constexpr std::string_view kTable = "phi.table";
constexpr std::string_view kPages = "phi.pages";
constexpr std::string_view kLabels = "labels";
constexpr std::string_view kTruth = "truth";
constexpr const char* kSessionFormat = "tidemark session";
constexpr std::size_t kLongestViewState = std::size_t{16} << 20;
constexpr std::size_t kMostPlaces = 1024;  // of maps, and of images: each was the user's choice once
// Some 170,000 strokes of a brush: 2 million values, in 16 MiB of places and 32 MiB of text.
constexpr JsonLimits kJsonLimits{.bytes = std::size_t{32} << 20, .values = std::size_t{2} << 20};

// A start from a saved phi is part of the recipe, and larger than its own file may be. It is deflated
// already: as letters of 6 bits each it takes no more than 4/3 of what the archive holds of it.
JsonLimits json_limits(std::size_t packed_bytes) {
  JsonLimits limits = kJsonLimits;
  limits.bytes += packed_bytes + packed_bytes / 2;
  return limits;
}

Json code_json(const imaging::Code& code) {
  return {{"value", code.value}, {"scheme", code.scheme}, {"meaning", code.meaning}};
}

imaging::Code read_code(const JsonField& field) {
  return {field.at("value").text(kLongestName), field.at("scheme").text(kLongestName),
          field.at("meaning").text(kLongestName)};
}

Json labels_json(const std::vector<Label>& labels) {
  Json list = Json::array();
  for (const Label& label : labels) {
    Json one{{"id", label.id},
             {"name", label.name},
             {"colour", label.colour},
             {"visible", label.visible},
             {"locked", label.locked}};
    if (label.meaning) {
      one["meaning"] = {{"category", code_json(label.meaning->category)},
                        {"type", code_json(label.meaning->type)}};
    }
    list.push_back(std::move(one));
  }
  return list;
}

std::vector<Label> read_labels(const JsonField& field) {
  std::vector<Label> labels;
  const std::size_t count = field.size(255);
  for (std::size_t i = 0; i < count && field.good(); ++i) {
    const JsonField one = field.at(i);
    Label label;
    label.id = static_cast<std::uint8_t>(one.at("id").integer(1, 255));
    label.name = one.at("name").text(kLongestName);
    const glm::dvec3 colour(one.at("colour").index(0, 255));
    for (int c = 0; c < 3; ++c)
      label.colour[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(colour[c]);
    label.visible = one.at("visible").boolean();
    label.locked = one.at("locked").boolean();
    if (one.has("meaning")) {
      const JsonField meaning = one.at("meaning");
      label.meaning =
          imaging::SegmentMeaning{read_code(meaning.at("category")), read_code(meaning.at("type"))};
    }
    labels.push_back(std::move(label));
  }
  return labels;
}

// Where a study or an image is found again.
void add_place(Json& json, const std::filesystem::path& path, const std::filesystem::path& session) {
  json["path"] = "";
  json["relative_path"] = "";
  if (path.empty()) return;
  std::error_code ignored;
  const auto whole = std::filesystem::absolute(path, ignored);
  json["path"] = whole.string();
  json["relative_path"] =
      std::filesystem::proximate(whole, std::filesystem::absolute(session, ignored).parent_path(), ignored)
          .string();
}

// Beside the session, if it is there, else where it was; empty: it was made here.
std::filesystem::path read_place(const JsonField& field, const std::filesystem::path& session) {
  const std::filesystem::path path = field.at("path").text();
  const std::filesystem::path relative = field.at("relative_path").text();
  for (const auto& any : {path, relative}) {
    if (any.string().find('\0') != std::string::npos) field.wrong("names no path");
  }
  if (!field.good() || relative.empty()) return path;
  std::error_code error;
  const auto beside = std::filesystem::weakly_canonical(session.parent_path() / relative, error);
  return !error && std::filesystem::exists(beside, error) ? beside : path;
}

Json study_json(const StudyOrigin& origin, const std::filesystem::path& session) {
  Json json{{"series_uid", origin.series_uid},
            {"phantom", origin.phantom},
            {"sha256", origin.checksum},
            {"slices", document::to_json(origin.policy)},
            {"name", origin.name},
            {"date", origin.date}};
  add_place(json, origin.path, session);
  return json;
}

StudyOrigin read_study(const JsonField& field, const std::filesystem::path& session) {
  StudyOrigin origin;
  origin.series_uid = field.at("series_uid").text(kLongestName);
  origin.phantom = field.at("phantom").text(kLongestName);
  origin.checksum = field.at("sha256").text(64);
  if (field.has("slices")) origin.policy = read_policy(field.at("slices"));
  if (field.has("name")) origin.name = field.at("name").text(kLongestDescription);
  if (field.has("date")) origin.date = field.at("date").text(kLongestDescription);
  origin.path = read_place(field, session);
  if (field.good() && origin.path.empty() && origin.phantom.empty()) field.wrong("names no study");
  return origin;
}

Json images_json(const SessionContents& contents, const std::filesystem::path& file) {
  Json list = Json::array();
  for (const auto& image : contents.images) {
    Json one = document::to_json(*image);
    one["slices"] = document::to_json(image->policy);
    add_place(one, image->path, file);
    list.push_back(std::move(one));
  }
  return list;
}

std::vector<std::shared_ptr<const CaseImage>> read_images(const JsonField& field,
                                                          const std::filesystem::path& file) {
  std::vector<std::shared_ptr<const CaseImage>> images;
  const std::size_t count = field.size(kMostImages);
  for (std::size_t i = 0; i < count && field.good(); ++i) {
    CaseImage image = read_image(field.at(i));
    image.policy = read_policy(field.at(i).at("slices"));
    image.path = read_place(field.at(i), file);
    images.push_back(std::make_shared<const CaseImage>(std::move(image)));
  }
  return images;
}

// Where the maps and images of drives lie, by their checksums: drives name no files.
void add_places_of_drives(Json& json, const SessionContents& contents, const std::filesystem::path& file) {
  std::map<std::string, Json> maps;
  std::map<std::string, Json> images;
  const auto add = [&](std::map<std::string, Json>& places, const auto& part, Json one) {
    if (part.path.empty() || places.contains(part.checksum) || places.size() == kMostPlaces) return;
    one["sha256"] = part.checksum;
    add_place(one, part.path, file);
    places[part.checksum] = std::move(one);
  };
  visit_drives(contents, [&](const Drive& drive) {
    if (drive.map != nullptr) add(maps, *drive.map, Json::object());
    for (const auto& image : drive.images)
      add(images, *image, Json{{"slices", document::to_json(image->policy)}});
  });
  for (auto& [checksum, one] : maps) json["maps"].push_back(std::move(one));
  for (auto& [checksum, one] : images) json["image_places"].push_back(std::move(one));
}

struct PlaceOfDrives {
  std::filesystem::path path;
  imaging::GridPolicy policy;  // of an image
};
using PlacesOfDrives = std::map<std::string, PlaceOfDrives>;  // by checksum

PlacesOfDrives read_places_of_drives(const JsonField& root, const char* name,
                                     const std::filesystem::path& file) {
  PlacesOfDrives places;
  if (!root.has(name)) return places;
  const JsonField list = root.at(name);
  const std::size_t count = list.size(kMostPlaces);
  for (std::size_t i = 0; i < count && root.good(); ++i) {
    const JsonField one = list.at(i);
    PlaceOfDrives& place = places[one.at("sha256").text(64)];
    place.path = read_place(one, file);
    if (one.has("slices")) place.policy = read_policy(one.at("slices"));
  }
  return places;
}

void put_places(SessionContents& contents, const PlacesOfDrives& of_maps, const PlacesOfDrives& of_images) {
  std::map<std::string, std::shared_ptr<const SpeedMap>> maps;
  change_drives(contents, [&](Drive& drive) {
    if (drive.map != nullptr && of_maps.contains(drive.map->checksum)) {
      auto& map = maps[drive.map->checksum];
      if (map == nullptr) {
        map = std::make_shared<const SpeedMap>(
            SpeedMap{drive.map->name, drive.map->checksum, nullptr, of_maps.at(drive.map->checksum).path});
      }
      drive.map = map;
    }
    for (auto& image : drive.images) {
      const auto place = of_images.find(image->checksum);
      if (place == of_images.end()) continue;
      auto placed = std::make_shared<CaseImage>(*image);
      placed->path = place->second.path;
      placed->policy = place->second.policy;
      image = std::move(placed);
    }
  });
}

Json session_json(const SessionContents& contents, const std::filesystem::path& file) {
  Json json{{"format", kSessionFormat}, {"version", kSessionVersion}};
  json["study"] = study_json(contents.origin, file);
  json["grid"] = document::to_json(contents.geometry);
  json["recipe"] = document::to_json(contents.recipe);
  if (contents.wanted_drive) json["wanted_drive"] = wanted_drive_json(*contents.wanted_drive);
  const Index3 shape = contents.phi->layout.page_shape();
  json["phi"] = {{"band", contents.phi->band},
                 {"page_shape", {shape.x, shape.y, shape.z}},
                 {"resident_pages", contents.phi->pages.stored()}};
  json["labels"] = labels_json(contents.labels);
  json["curve"] = curve_json(*contents.curve.points());
  json["view_state"] = contents.view_state;
  if (!contents.images.empty()) json["images"] = images_json(contents, file);
  add_places_of_drives(json, contents, file);
  return json;
}

Result<std::shared_ptr<const solver::Field>> read_phi(ZipReader& archive, const JsonField& field,
                                                      const Geometry& geometry, const std::string& file) {
  const double band = field.at("band").number(2.0, 1e6);
  const Index3 shape = field.at("page_shape").index(1, 64);
  if (!is_page_shape(shape)) field.at("page_shape").wrong("no pages have that shape");
  if (!field.good()) return pass_on(field.status());
  const PageLayout layout(geometry.size, shape);
  const std::int64_t resident = field.at("resident_pages").integer(0, layout.page_count());
  if (!field.good()) return pass_on(field.status());
  auto table = archive.read<std::int32_t>(kTable, static_cast<std::size_t>(layout.page_count()));
  if (!table) return pass_on(table);
  auto reader = FieldsReader::open(solver::Field::empty(geometry, band, shape), std::move(*table),
                                   static_cast<std::size_t>(resident), file + ": phi");
  if (!reader) return pass_on(reader);
  const auto bytes = static_cast<std::size_t>(resident * layout.voxels_per_page()) * sizeof(float);
  TIDEMARK_TRY(archive.unpack(kPages, bytes, [&](std::span<const std::uint8_t> piece) -> Status {
    reader->take(std::as_bytes(piece));
    return {};
  }));
  auto fields = reader->fields();
  if (!fields) return pass_on(fields);
  return std::move(fields->front());
}

// The slices of a grid that are read or written at a time: those of a layer of pages.
std::size_t layer_voxels(Index3 size) {
  return static_cast<std::size_t>(size.x * size.y * std::min(size.z, PagedBytes::kPageShape.z));
}

// An entry of as many bytes as the grid has voxels, of which no more than a layer is there at a time.
Result<PagedBytes> read_layers(ZipReader& archive, std::string_view name, Index3 size) {
  PagedBytes voxels(size);
  std::vector<std::uint8_t> layer;
  std::int64_t slice = 0;
  const auto put = [&] {
    const PagedBytes before = voxels;
    const std::int64_t slices = static_cast<std::int64_t>(layer.size()) / (size.x * size.y);
    voxels.write({0, 0, slice}, {size.x, size.y, slices}, layer.data());
    voxels.join_even_pages(before);
    slice += slices;
    layer.clear();
  };
  const auto bytes = static_cast<std::size_t>(size.x * size.y * size.z);
  TIDEMARK_TRY(archive.unpack(name, bytes, [&](std::span<const std::uint8_t> piece) -> Status {
    layer.reserve(layer_voxels(size));
    while (!piece.empty()) {
      const auto part = piece.first(std::min(piece.size(), layer_voxels(size) - layer.size()));
      layer.insert(layer.end(), part.begin(), part.end());
      piece = piece.subspan(part.size());
      if (layer.size() == layer_voxels(size)) put();
    }
    return {};
  }));
  if (!layer.empty()) put();
  return voxels;
}

// `read` gives the voxels of so many slices from one on.
using ReadSlices = std::function<void(std::int64_t slice, std::int64_t slices, std::span<std::uint8_t>)>;

ZipEntry layers_entry(std::string_view name, Index3 size, ReadSlices read) {
  const auto bytes = static_cast<std::size_t>(size.x * size.y * size.z);
  return {name, bytes,
          [read = std::move(read), size,
           layer = std::vector<std::uint8_t>(layer_voxels(size))](std::size_t number) mutable {
            const std::int64_t slice = static_cast<std::int64_t>(number) * PagedBytes::kPageShape.z;
            const std::int64_t slices = std::min(PagedBytes::kPageShape.z, size.z - slice);
            if (slices <= 0) return std::span<const std::byte>();
            const auto voxels = std::span(layer).first(static_cast<std::size_t>(size.x * size.y * slices));
            read(slice, slices, voxels);
            return std::as_bytes(voxels);
          }};
}

ZipEntry labels_entry(const PagedBytes& labels) {
  const Index3 size = labels.size();
  return layers_entry(
      kLabels, size,
      [&labels, size](std::int64_t slice, std::int64_t slices, std::span<std::uint8_t> voxels) {
        labels.read({0, 0, slice}, {size.x, size.y, slices}, voxels.data());
      });
}

ZipEntry truth_entry(const BitMask& truth) {
  const Geometry& grid = truth.geometry();
  return layers_entry(
      kTruth, grid.size,
      [inside = inside_of(truth)](std::int64_t slice, std::int64_t, std::span<std::uint8_t> voxels) {
        inside.read(inside.geometry.offset({0, 0, slice}), voxels);
      });
}

Status read_label_voxels(ZipReader& archive, SessionContents& contents, const std::string& file) {
  PagedBytes voxels(contents.geometry.size);
  if (archive.has(kLabels)) {
    auto read = read_layers(archive, kLabels, contents.geometry.size);
    if (!read) return pass_on(read);
    voxels = std::move(*read);
  }
  Labels trial(contents.geometry);
  if (const Status good = trial.assign(contents.labels, voxels); !good) {
    return fail(ErrorKind::input, "{}: labels: {}", file, good.error().message);
  }
  if (!voxels.empty()) contents.label_voxels = std::make_shared<const PagedBytes>(std::move(voxels));
  return {};
}

Status read_truth(ZipReader& archive, SessionContents& contents) {
  if (!archive.has(kTruth)) return {};
  std::optional<BitMask> truth;  // once it is known that the file can hold it
  std::int64_t offset = 0;
  const auto bytes = static_cast<std::size_t>(contents.geometry.voxel_count());
  TIDEMARK_TRY(archive.unpack(kTruth, bytes, [&](std::span<const std::uint8_t> piece) -> Status {
    if (!truth) truth.emplace(contents.geometry);
    for (const std::uint8_t voxel : piece) {
      if (voxel != 0) truth->add(offset);
      ++offset;
    }
    return {};
  }));
  if (truth) contents.truth = std::make_shared<const BitMask>(std::move(*truth));
  return {};
}

// A file of ours, of a version that can be read.
struct OpenedSession {
  ZipReader archive;
  std::vector<std::byte> text;
  JsonDocument json;
};

// `name`: of the file, for messages.
Result<OpenedSession> open_session(const std::filesystem::path& file, const std::string& name) {
  auto archive = ZipReader::open(file, session_entry_names());
  if (!archive) return pass_on(archive);
  const JsonLimits limits = json_limits(archive->packed_size(kJson));
  if (archive->size(kJson) > limits.bytes) {
    return fail(ErrorKind::input, "{}: {} has {} bytes, more than {} are not read", name, kJson,
                archive->size(kJson), limits.bytes);
  }
  auto text = archive->read(kJson, archive->size(kJson));
  if (!text) return pass_on(text);
  auto json = JsonDocument::parse({reinterpret_cast<const char*>(text->data()), text->size()}, name, limits);
  if (!json) return pass_on(json);
  const JsonField root = root_of(*json, name);
  root.at("format").must_be(kSessionFormat);
  const JsonField version = root.at("version");
  if (version.integer(0, 1 << 30) != kSessionVersion) version.wrong("this version cannot be read");
  if (!root.good()) return pass_on(root.status());
  return OpenedSession{std::move(*archive), std::move(*text), std::move(*json)};
}

// All that its text says; voxels are still to be read.
SessionContents read_text(const JsonField& root, const std::filesystem::path& file) {
  SessionContents contents;
  contents.origin = read_study(root.at("study"), file);
  contents.geometry = read_geometry(root.at("grid"));
  contents.recipe = read_recipe(root.at("recipe"));
  if (root.has("wanted_drive"))
    contents.wanted_drive = read_wanted_drive(root.at("wanted_drive"), contents.recipe);
  contents.labels = read_labels(root.at("labels"));
  if (root.has("curve")) contents.curve = read_curve(root.at("curve"));
  contents.view_state = root.at("view_state").text(kLongestViewState);
  if (root.has("images")) contents.images = read_images(root.at("images"), file);
  if (root.good() && contents.recipe.source.size != contents.geometry.size) {
    root.at("recipe").wrong("is of another grid");
  }
  return contents;
}

// What could not be read again is not written: its text is read as load_session() will.
Status check_written(const std::filesystem::path& written, const std::filesystem::path& file) {
  const auto again = open_session(written, file.string());
  if (!again) return pass_on(again);
  const JsonField root = root_of(again->json, file.string());
  static_cast<void>(read_text(root, file));
  return root.status();
}

}  // namespace

std::span<const std::string_view> session_entry_names() {
  static constexpr std::array<std::string_view, 8> kNames{
      kJson, kTable, kPages, kLabels, kTruth, kHistoryJson, kHistoryTables, kHistoryPages};
  return kNames;
}

Status write_session(const SessionContents& contents, const std::filesystem::path& file, InFile what) {
  const std::string json = session_json(contents, file).dump(-1, ' ', false, Json::error_handler_t::replace);
  const FieldBytes phi(*contents.phi);
  std::vector<ZipEntry> entries{
      {kJson, std::as_bytes(std::span(json))}, phi.tables_entry(kTable), phi.pages_entry(kPages)};
  if (contents.label_voxels) entries.push_back(labels_entry(*contents.label_voxels));
  if (contents.truth) entries.push_back(truth_entry(*contents.truth));
  HistoryEntries history;
  if (what == InFile::all && !contents.history.empty()) {
    history = history_entries(contents);
    for (const ZipEntry& entry : history.entries()) entries.push_back(entry);
  }
  auto whole = AtomicFile::create(file);
  if (!whole) return pass_on(whole);
  if (Status written = write_zip(whole->temporary_path(), entries); !written) {
    return fail(ErrorKind::write, "{}: {}", file.string(), written.error().message);
  }
  if (Status readable = check_written(whole->temporary_path(), file); !readable) {
    return fail(ErrorKind::write, "{}", readable.error().message);
  }
  return whole->commit();
}

Result<SessionContents> load_session(const std::filesystem::path& file) {
  const std::string name = file.string();
  auto opened = open_session(file, name);
  if (!opened) return pass_on(opened);
  const JsonField root = root_of(opened->json, name);
  SessionContents contents = read_text(root, file);
  const PlacesOfDrives maps = read_places_of_drives(root, "maps", file);
  const PlacesOfDrives images = read_places_of_drives(root, "image_places", file);
  if (!root.good()) return pass_on(root.status());
  auto phi = read_phi(opened->archive, root.at("phi"), contents.geometry, name);
  if (!phi) return pass_on(phi);
  contents.phi = std::move(*phi);
  TIDEMARK_TRY(read_label_voxels(opened->archive, contents, name));
  TIDEMARK_TRY(read_truth(opened->archive, contents));
  TIDEMARK_TRY(read_history(opened->archive, contents, name));
  put_places(contents, maps, images);
  return contents;
}

Result<StudyOrigin> load_origin(const std::filesystem::path& file) {
  const auto opened = open_session(file, file.string());
  if (!opened) return pass_on(opened);
  const JsonField root = root_of(opened->json, file.string());
  StudyOrigin origin = read_study(root.at("study"), file);
  if (!root.good()) return pass_on(root.status());
  return origin;
}

}  // namespace tidemark::document
