#include "document/drive_json.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <span>

#include "core/checked.h"
#include "document/constraints_json.h"
#include "document/file_limits.h"
#include "document/packed_bytes.h"
#include "solver/speed/speed_registry.h"

namespace tidemark::document {
namespace {

constexpr std::size_t kMostTerms = 16;
constexpr std::size_t kEndless = std::numeric_limits<std::size_t>::max();

Json to_json(const solver::SpeedTerm& term) {
  Json values = Json::object();
  for (const auto& [name, value] : term.values) values[name] = value;
  return {{"function", term.function}, {"values", std::move(values)}};
}

solver::SpeedTerm read_term(const JsonField& field) {
  solver::SpeedTerm term;
  term.function = field.at("function").text(kLongestName);
  const solver::SpeedKind* kind = solver::speed_kind(term.function);
  if (kind == nullptr) {
    field.at("function").wrong("there is no such speed function");
    return term;
  }
  const JsonField values = field.at("values");
  std::vector<std::string_view> names;
  for (const solver::SpeedParameter& number : kind->parameters) {
    names.emplace_back(number.name);
    if (values.has(number.name))
      term.values[number.name] = values.at(number.name).number(number.low, number.high);
  }
  values.only(names);
  return term;
}

Json packed_offsets(const std::vector<std::int64_t>& offsets) {
  return {{"count", offsets.size()}, {"offsets", pack_bytes(std::as_bytes(std::span(offsets)))}};
}

std::vector<std::int64_t> read_offsets(const JsonField& field, std::int64_t voxels) {
  const auto count = static_cast<std::size_t>(field.at("count").integer(0, voxels));
  const std::string packed = field.at("offsets").text(kEndless);
  if (!field.good()) return {};
  const auto bytes = unpack_bytes(packed, count * sizeof(std::int64_t));
  if (!bytes) {
    field.at("offsets").wrong("does not hold as many numbers as it should");
    return {};
  }
  std::vector<std::int64_t> offsets(count);
  if (count > 0) std::memcpy(offsets.data(), bytes->data(), bytes->size());
  const bool ascends =
      std::adjacent_find(offsets.begin(), offsets.end(), std::greater_equal<>()) == offsets.end();
  if (!ascends || (count > 0 && (offsets.front() < 0 || offsets.back() >= voxels))) {
    field.at("offsets").wrong("are not voxels of the volume, each once, in their order");
  }
  return offsets;
}

solver::Strokes read_strokes(const JsonField& field, std::int64_t voxels) {
  solver::Strokes strokes{read_offsets(field.at("inside"), voxels),
                          read_offsets(field.at("outside"), voxels)};
  std::vector<std::int64_t> both;
  std::set_intersection(strokes.inside.begin(), strokes.inside.end(), strokes.outside.begin(),
                        strokes.outside.end(), std::back_inserter(both));
  if (!both.empty()) field.wrong("a voxel is both inside and outside");
  return strokes;
}

// Whether a transform is a rotation and a shift, up to the rounding of its numbers in a file.
bool is_rigid(const glm::dmat4& transform) {
  constexpr double kRounding = 1e-3;
  const glm::dmat3 turn(transform);
  const glm::dmat3 product = glm::transpose(turn) * turn;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (std::abs(product[column][row] - (row == column ? 1.0 : 0.0)) > kRounding) return false;
    }
  }
  return glm::determinant(turn) > 0.0 && glm::row(transform, 3) == glm::dvec4(0.0, 0.0, 0.0, 1.0);
}

// Notes a problem where there are more than are read.
std::int64_t voxels_of(const JsonField& field, Index3 size) {
  const auto voxels = checked_product(size.x, size.y, size.z);
  if (voxels && *voxels <= kMostVoxels) return *voxels;
  field.wrong("the volume has more voxels than are read");
  return 0;
}

}  // namespace

Json to_json(const CaseImage& image) {
  Json transform = Json::array();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) transform.push_back(image.to_case[column][row]);
  }
  return {{"name", image.name},
          {"series_uid", image.series_uid},
          {"frame_of_reference_uid", image.frame_of_reference_uid},
          {"sha256", image.checksum},
          {"to_case", std::move(transform)}};
}

CaseImage read_image(const JsonField& field) {
  CaseImage image;
  image.name = field.at("name").text(kLongestDescription);
  image.series_uid = field.at("series_uid").text(kLongestName);
  image.frame_of_reference_uid = field.at("frame_of_reference_uid").text(kLongestName);
  image.checksum = field.at("sha256").text(64);
  const JsonField transform = field.at("to_case");
  if (transform.size(16) != 16) transform.wrong("not sixteen numbers");
  for (std::size_t i = 0; i < 16 && field.good(); ++i) {
    image.to_case[static_cast<int>(i % 4)][static_cast<int>(i / 4)] = transform.at(i).number(-1e7, 1e7);
  }
  if (!field.good()) return image;
  if (!is_rigid(image.to_case)) transform.wrong("is not a rotation and a shift");
  return image;
}

Json to_json(const Drive& drive, const solver::Constraints* before) {
  Json json{{"combine", drive.setting.combine == solver::Combine::least ? "least" : "product"}};
  for (const solver::SpeedTerm& term : drive.setting.terms) json["speed"].push_back(to_json(term));
  if (drive.strokes != nullptr) {
    json["strokes"] = {{"inside", packed_offsets(drive.strokes->inside)},
                       {"outside", packed_offsets(drive.strokes->outside)}};
  }
  add_constraints(json, drive.constraints.get(), before);
  for (const auto& image : drive.images) json["images"].push_back(to_json(*image));
  if (drive.map != nullptr) json["map"] = {{"name", drive.map->name}, {"sha256", drive.map->checksum}};
  return json;
}

Drive read_drive(const JsonField& field, Index3 grid_size,
                 const std::shared_ptr<const solver::Constraints>& before) {
  Drive drive;
  drive.setting.combine =
      field.at("combine").word({"least", "product"}) == 0 ? solver::Combine::least : solver::Combine::product;
  const JsonField terms = field.at("speed");
  const std::size_t count = terms.size(kMostTerms);
  if (count == 0) terms.wrong("no speed function is named");
  drive.setting.terms.clear();
  for (std::size_t i = 0; i < count && field.good(); ++i)
    drive.setting.terms.push_back(read_term(terms.at(i)));
  const std::int64_t voxels = voxels_of(field, grid_size);
  if (field.has("strokes")) {
    drive.strokes = std::make_shared<const solver::Strokes>(read_strokes(field.at("strokes"), voxels));
  }
  if (field.good()) drive.constraints = read_constraints(field, grid_size, before);
  if (field.has("images")) {
    const JsonField images = field.at("images");
    const std::size_t images_count = images.size(kMostImages);
    for (std::size_t i = 0; i < images_count && field.good(); ++i) {
      drive.images.push_back(std::make_shared<const CaseImage>(read_image(images.at(i))));
    }
  }
  if (field.has("map")) {
    const JsonField map = field.at("map");
    drive.map = std::make_shared<const SpeedMap>(
        SpeedMap{map.at("name").text(kLongestName), map.at("sha256").text(64), nullptr, {}});
  }
  return drive;
}

}  // namespace tidemark::document
