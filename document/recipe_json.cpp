#include "document/recipe_json.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "core/checked.h"
#include "core/json/json_text.h"
#include "document/drive_json.h"
#include "document/field_bytes.h"
#include "document/file_limits.h"
#include "document/packed_bytes.h"
#include "imaging/filters/filters.h"
#include "solver/coarse_grid.h"
#include "solver/speed/motion_limit.h"

namespace tidemark::document {
namespace {

constexpr std::int64_t kLongestAxis = 1 << 20;
constexpr std::size_t kMostEvents = 1'000'000;
constexpr std::size_t kMostStartSpheres = 100'000;
constexpr double kLargestLimit = 1e5;  // mm
constexpr const char* kRecipeFormat = "tidemark recipe";

Json vector_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}
Json index_json(const Index3& v) {
  return {v.x, v.y, v.z};
}

Json to_json(const solver::Sphere& sphere) {
  return {{"centre_mm", vector_json(sphere.centre_mm)}, {"radius_mm", sphere.radius_mm}};
}

Json to_json(const std::vector<solver::Sphere>& spheres) {
  Json list = Json::array();
  for (const solver::Sphere& sphere : spheres) list.push_back(to_json(sphere));
  return list;
}

solver::Sphere read_sphere(const JsonField& field) {
  solver::Sphere sphere;
  sphere.centre_mm = field.at("centre_mm").vector(-kFarthest_mm, kFarthest_mm);
  sphere.radius_mm = field.at("radius_mm").number(std::numeric_limits<double>::min(), kFarthest_mm);
  return sphere;
}

std::vector<solver::Sphere> read_spheres(const JsonField& field) {
  std::vector<solver::Sphere> spheres;
  const std::size_t count = field.size(kMostStartSpheres);
  for (std::size_t i = 0; i < count && field.good(); ++i) spheres.push_back(read_sphere(field.at(i)));
  return spheres;
}

std::shared_ptr<const BitMask> read_mask(const JsonField& field) {
  const Geometry grid = read_geometry(field.at("grid"));
  const std::string packed = field.at("bits").text(std::numeric_limits<std::size_t>::max());
  if (!field.good()) return nullptr;
  auto mask = unpack_mask(packed, grid);
  if (mask) return std::make_shared<const BitMask>(std::move(*mask));
  field.at("bits").wrong("does not hold the grid's voxels");
  return nullptr;
}

template <class Number>
Json packed_numbers(const std::vector<Number>& numbers) {
  return pack_bytes(std::as_bytes(std::span(numbers)));
}

template <class Number>
std::vector<Number> read_numbers(const JsonField& field, std::size_t count) {
  const std::string packed = field.text(std::numeric_limits<std::size_t>::max());
  if (!field.good()) return {};
  const auto bytes = unpack_bytes(packed, count * sizeof(Number));
  if (!bytes) {
    field.wrong("does not hold as many numbers as it should");
    return {};
  }
  std::vector<Number> numbers(count);
  std::memcpy(numbers.data(), bytes->data(), bytes->size());
  return numbers;
}

Json to_json(const solver::Field& phi) {
  const FieldBytes bytes(phi);
  std::vector<float> pages;
  for (std::size_t n = 0; n < bytes.pages(); ++n) {
    const auto page = bytes.page(n);
    pages.insert(pages.end(), page.begin(), page.end());
  }
  return {{"grid", tidemark::document::to_json(phi.geometry)}, {"band", phi.band},
          {"page_shape", index_json(phi.layout.page_shape())}, {"resident_pages", phi.pages.stored()},
          {"table", packed_numbers(bytes.tables())},           {"pages", packed_numbers(pages)}};
}

std::shared_ptr<const solver::Field> read_field(const JsonField& field) {
  const Geometry geometry = read_geometry(field.at("grid"));
  const double band = field.at("band").number(2.0, 1e6);
  const Index3 shape = field.at("page_shape").index(1, 64);
  if (field.good() && !is_page_shape(shape)) field.at("page_shape").wrong("no pages have that shape");
  if (!field.good()) return nullptr;
  const PageLayout layout(geometry.size, shape);
  const auto resident = field.at("resident_pages").integer(0, layout.page_count());
  auto table = read_numbers<std::int32_t>(field.at("table"), static_cast<std::size_t>(layout.page_count()));
  const auto pages =
      read_numbers<float>(field.at("pages"), static_cast<std::size_t>(resident * layout.voxels_per_page()));
  if (!field.good()) return nullptr;
  const auto read = [&]() -> Result<std::shared_ptr<const solver::Field>> {
    auto reader = FieldsReader::open(solver::Field::empty(geometry, band, shape), std::move(table),
                                     static_cast<std::size_t>(resident), "phi");
    if (!reader) return pass_on(reader);
    reader->take(std::as_bytes(std::span(pages)));
    auto fields = reader->fields();
    if (!fields) return pass_on(fields);
    return std::move(fields->front());
  };
  auto phi = read();
  if (phi) return std::move(*phi);
  field.wrong(phi.error().message);
  return nullptr;
}

struct FromJson {
  Json operator()(std::monostate) const { return {{"kind", "spheres"}}; }
  Json operator()(const ThresholdStart& start) const {
    return {{"kind", "threshold"}, {"low", start.low}, {"high", start.high}};
  }
  Json operator()(const FloodStart& start) const {
    return {{"kind", "flood"}, {"voxel", index_json(start.voxel)}, {"low", start.low}, {"high", start.high}};
  }
  Json operator()(const SpeedStart&) const { return {{"kind", "speed"}}; }
  Json operator()(const MaskStart& start) const {
    Json json{{"kind", "mask"},
              {"origin", start.origin},
              {"grid", tidemark::document::to_json(start.mask->geometry())},
              {"bits", pack_bytes(start.mask->bits())}};
    if (start.limit != nullptr) json["within_mm"] = start.limit->within_mm();
    return json;
  }
  Json operator()(const FieldStart& start) const {
    Json json = to_json(*start.phi);
    json["kind"] = "phi";
    json["origin"] = start.origin;
    return json;
  }
};

MaskStart read_mask_start(const JsonField& field) {
  MaskStart start{read_mask(field), field.at("origin").text()};
  if (!field.has("within_mm")) return start;
  const double within_mm = field.at("within_mm").number(std::numeric_limits<double>::min(), kLargestLimit);
  if (field.good()) start.limit = std::make_shared<const solver::MotionLimit>(start.mask, within_mm);
  return start;
}

void read_levels(const JsonField& field, Start& start) {
  if (!field.has("levels")) return;
  start.levels = static_cast<int>(field.at("levels").integer(1, solver::CoarseGrid::kMostLevels));
  if (start.levels > 1 && std::holds_alternative<FieldStart>(start.from)) {
    field.at("levels").wrong("a saved level set has no coarser levels");
  }
}

using From = decltype(Start::from);

From read_from(const JsonField& from) {
  const auto low_to_high = [&](double& low, double& high) {
    low = from.at("low").number();
    high = from.at("high").number(low);
  };
  switch (from.at("kind").word({"spheres", "threshold", "flood", "mask", "phi", "speed"})) {
    case 1: {
      ThresholdStart part;
      low_to_high(part.low, part.high);
      return part;
    }
    case 2: {
      FloodStart part;
      part.voxel = from.at("voxel").index(0, kLongestAxis);
      low_to_high(part.low, part.high);
      return part;
    }
    case 3:
      return read_mask_start(from);
    case 4:
      return FieldStart{read_field(from), from.at("origin").text()};
    case 5:
      return SpeedStart{};
    default:
      return {};
  }
}

}  // namespace

Start read_start(const JsonField& field) {
  Start start;
  start.from = read_from(field.at("from"));
  start.seeds = read_spheres(field.at("seeds"));
  start.erasers = read_spheres(field.at("erasers"));
  read_levels(field, start);
  return start;
}

Start read_partial_start(const JsonField& field) {
  Start start;
  if (field.has("from")) start.from = read_from(field.at("from"));
  if (field.has("seeds")) start.seeds = read_spheres(field.at("seeds"));
  if (field.has("erasers")) start.erasers = read_spheres(field.at("erasers"));
  read_levels(field, start);
  return start;
}

Json to_json(const Start& start) {
  Json json{{"from", std::visit(FromJson{}, start.from)},
            {"seeds", to_json(start.seeds)},
            {"erasers", to_json(start.erasers)}};
  if (start.levels > 1) json["levels"] = start.levels;
  return json;
}

namespace {

Json to_json(const RecipeExecutor& executor) {
  return {{"name", executor.name},
          {"page_shape", index_json(executor.page_shape)},
          {"skip_quiet_pages", executor.skip_quiet_pages}};
}

RecipeExecutor read_executor(const JsonField& field) {
  RecipeExecutor executor;
  const std::vector<std::string_view> names{"host", "compute", "stream", "reference"};
  executor.name = names[field.at("name").word(names)];
  executor.page_shape = field.at("page_shape").index(1, 64);
  if (!is_page_shape(executor.page_shape)) field.at("page_shape").wrong("no pages have that shape");
  executor.skip_quiet_pages = field.at("skip_quiet_pages").boolean();
  return executor;
}

// `before`: the walls and anchors before the event; null: none.
Json to_json(const RecipeEvent& event, const solver::Constraints* before) {
  Json json{{"step", event.step}};
  if (const auto* paint = std::get_if<PaintEvent>(&event.what)) {
    json[paint->brush == solver::Brush::add ? "add" : "erase"] = to_json(paint->sphere);
  } else if (const auto* change = std::get_if<ParametersEvent>(&event.what)) {
    json["parameters"] = tidemark::document::to_json(change->parameters);
  } else if (const auto* smoothing = std::get_if<SmoothEvent>(&event.what)) {
    json["smoothed_mm"] = smoothing->sigma_mm;
  } else if (const auto* drive = std::get_if<DriveEvent>(&event.what)) {
    json["drive"] = tidemark::document::to_json(*drive->drive, before);
  } else if (const auto* other = std::get_if<ExecutorEvent>(&event.what)) {
    json["executor"] = to_json(other->executor);
  } else {
    json["resume"] = true;
  }
  return json;
}

RecipeEvent read_event(const JsonField& field, std::int64_t first_step, std::int64_t last_step,
                       Index3 grid_size, const std::shared_ptr<const solver::Constraints>& before) {
  RecipeEvent event;
  event.step = field.at("step").integer(first_step, last_step);
  if (field.has("add")) {
    event.what = PaintEvent{read_sphere(field.at("add")), solver::Brush::add};
  } else if (field.has("erase")) {
    event.what = PaintEvent{read_sphere(field.at("erase")), solver::Brush::erase};
  } else if (field.has("parameters")) {
    event.what = ParametersEvent{read_parameters(field.at("parameters"))};
  } else if (field.has("smoothed_mm")) {
    event.what = SmoothEvent{field.at("smoothed_mm").number(0.0, imaging::kMostSmoothing_mm)};
  } else if (field.has("drive")) {
    event.what = DriveEvent{std::make_shared<const Drive>(read_drive(field.at("drive"), grid_size, before))};
  } else if (field.has("executor")) {
    event.what = ExecutorEvent{read_executor(field.at("executor"))};
  } else if (field.has("resume")) {
    event.what = ResumeEvent{};
  } else {
    field.wrong("an event of an unknown kind");
  }
  return event;
}

}  // namespace

Json to_json(const Geometry& geometry) {
  Json direction = Json::array();
  for (int a = 0; a < 3; ++a) direction.push_back(vector_json(geometry.direction[a]));
  Json json = {{"size", index_json(geometry.size)},
               {"spacing_mm", vector_json(geometry.spacing_mm)},
               {"origin_mm", vector_json(geometry.origin_mm)},
               {"direction", direction}};
  if (!geometry.oriented) json["oriented"] = false;
  return json;
}

Geometry read_geometry(const JsonField& field) {
  Geometry geometry;
  geometry.size = field.at("size").index(1, kLongestAxis);
  geometry.spacing_mm = field.at("spacing_mm").vector(1e-6, 1e6);
  geometry.origin_mm = field.at("origin_mm").vector(-kFarthest_mm, kFarthest_mm);
  const JsonField direction = field.at("direction");
  if (direction.size(3) != 3) direction.wrong("not three vectors");
  for (std::size_t a = 0; a < 3; ++a) {
    geometry.direction[static_cast<int>(a)] = direction.at(a).vector(-1.001, 1.001);
  }
  if (field.has("oriented")) geometry.oriented = field.at("oriented").boolean();
  if (!field.good()) return {};
  const auto voxels = checked_product(geometry.size.x, geometry.size.y, geometry.size.z);
  if (!voxels || *voxels > kMostVoxels) field.at("size").wrong("more voxels than are read");
  if (std::abs(std::abs(glm::determinant(geometry.direction)) - 1.0) > 1e-3) {
    direction.wrong("the axes are not at right angles");
  }
  return field.good() ? geometry : Geometry();
}

Json to_json(const imaging::GridPolicy& policy) {
  return {{"tilt", policy.tilt == imaging::GridPolicy::Tilt::keep ? "keep" : "correct"},
          {"gaps", policy.gaps == imaging::GridPolicy::Gaps::fill ? "fill" : "refuse"}};
}

imaging::GridPolicy read_policy(const JsonField& field) {
  imaging::GridPolicy policy;
  if (field.at("tilt").word({"correct", "keep"}) == 1) policy.tilt = imaging::GridPolicy::Tilt::keep;
  if (field.at("gaps").word({"refuse", "fill"}) == 1) policy.gaps = imaging::GridPolicy::Gaps::fill;
  return policy;
}

namespace {

std::shared_ptr<const solver::Constraints> constraints_of(const std::shared_ptr<const Drive>& drive) {
  return drive == nullptr ? nullptr : drive->constraints;
}

int version_of(const Recipe& recipe) {
  const bool goes_elsewhere = std::any_of(recipe.events.begin(), recipe.events.end(), [](const auto& event) {
    return std::holds_alternative<ExecutorEvent>(event.what);
  });
  if (goes_elsewhere) return Recipe::kVersion;
  if (recipe.start.levels > 1) return Recipe::kVersionOfLevels;
  return recipe.has_drive() || recipe.start.limit() ? Recipe::kVersionOfDrives : Recipe::kVersionOfTents;
}

}  // namespace

Json to_json(const Recipe& recipe) {
  Json json{{"format", kRecipeFormat}, {"version", version_of(recipe)}};
  json["source"] = {{"size", index_json(recipe.source.size)},
                    {"spacing_mm", vector_json(recipe.source.spacing_mm)},
                    {"series_uid", recipe.source.series_uid},
                    {"sha256", recipe.source.checksum},
                    {"slices", to_json(recipe.source.policy)}};
  json["executor"] = to_json(recipe.executor);
  json["smoothed_mm"] = recipe.smoothed_mm;
  json["start"] = to_json(recipe.start);
  json["parameters"] = to_json(recipe.parameters);
  if (recipe.drive != nullptr) json["drive"] = to_json(*recipe.drive, nullptr);
  const solver::Constraints* held = constraints_of(recipe.drive).get();
  Json events = Json::array();
  for (const RecipeEvent& event : recipe.events) {
    events.push_back(to_json(event, held));
    if (const auto* change = std::get_if<DriveEvent>(&event.what)) held = constraints_of(change->drive).get();
  }
  json["events"] = std::move(events);
  json["steps"] = recipe.steps;
  return json;
}

Recipe read_recipe(const JsonField& field) {
  Recipe recipe;
  field.at("format").must_be(kRecipeFormat);
  const JsonField version = field.at("version");
  const std::int64_t number = version.integer(0, 1 << 30);
  if (number < Recipe::kVersionOfTents || number > Recipe::kVersion)
    version.wrong("this version cannot be read");
  if (!field.good()) return recipe;
  const JsonField source = field.at("source");
  recipe.source.size = source.at("size").index(1, kLongestAxis);
  recipe.source.spacing_mm = source.at("spacing_mm").vector(1e-6, 1e6);
  recipe.source.series_uid = source.at("series_uid").text(256);
  recipe.source.checksum = source.at("sha256").text(64);
  if (source.has("slices")) recipe.source.policy = read_policy(source.at("slices"));
  recipe.executor = read_executor(field.at("executor"));
  recipe.smoothed_mm = field.at("smoothed_mm").number(0.0, imaging::kMostSmoothing_mm);
  recipe.start = read_start(field.at("start"));
  recipe.parameters = read_parameters(field.at("parameters"));
  if (field.has("drive")) {
    recipe.drive = std::make_shared<const Drive>(read_drive(field.at("drive"), recipe.source.size, nullptr));
  }
  recipe.steps = field.at("steps").integer(0, kMostSteps);
  const JsonField events = field.at("events");
  const std::size_t count = events.size(kMostEvents);
  std::int64_t step = 0;
  std::shared_ptr<const solver::Constraints> held = constraints_of(recipe.drive);
  for (std::size_t i = 0; i < count && field.good(); ++i) {
    recipe.events.push_back(read_event(events.at(i), step, recipe.steps, recipe.source.size, held));
    step = recipe.events.back().step;
    if (const auto* change = std::get_if<DriveEvent>(&recipe.events.back().what))
      held = constraints_of(change->drive);
  }
  return recipe;
}

Json wanted_drive_json(const Drive& drive) {
  Drive without = drive;
  without.constraints.reset();
  return to_json(without, nullptr);
}

std::shared_ptr<const Drive> read_wanted_drive(const JsonField& field, const Recipe& recipe) {
  Drive drive = read_drive(field, recipe.source.size, nullptr);
  drive.constraints = value_of(recipe.final_drive()).constraints;
  return std::make_shared<const Drive>(std::move(drive));
}

Result<std::string> Recipe::to_text() const {
  std::string text = json_text(tidemark::document::to_json(*this), 1);
  if (text.size() <= kLargestFile) {
    TIDEMARK_TRY(JsonDocument::parse(text, "the recipe"));  // what could not be read again is not written
    return text;
  }
  return fail(ErrorKind::usage,
              "the recipe has {} MB, and files of at most {} MB are read again: its start is too large",
              text.size() >> 20U, kLargestFile >> 20U);
}

Result<Recipe> Recipe::parse(std::string_view text, const std::string& file) {
  const auto json = JsonDocument::parse(text, file, {.bytes = kLargestFile});
  if (!json) return pass_on(json);
  const JsonField root = root_of(*json, file);
  Recipe recipe = read_recipe(root);
  if (!root.good()) return pass_on(root.status());
  return recipe;
}

}  // namespace tidemark::document
