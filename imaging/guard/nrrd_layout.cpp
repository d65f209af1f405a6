// The NRRD header: lines "field: value" up to an empty one (http://teem.sourceforge.net/nrrd/format.html).
#include <algorithm>
#include <bit>
#include <set>
#include <utility>

#include "core/checked.h"
#include "imaging/guard/pixel_layout.h"
#include "imaging/guard/text_header.h"

namespace tidemark::imaging::files {
namespace {

// By NRRD's type names; nothing for "block" and unknown ones.
std::optional<Scalar> nrrd_scalar(const std::string& type) {
  static const std::map<std::string, Scalar> kScalars = {{"signed char", Scalar::int8},
                                                         {"int8", Scalar::int8},
                                                         {"int8_t", Scalar::int8},
                                                         {"uchar", Scalar::uint8},
                                                         {"unsigned char", Scalar::uint8},
                                                         {"uint8", Scalar::uint8},
                                                         {"uint8_t", Scalar::uint8},
                                                         {"short", Scalar::int16},
                                                         {"short int", Scalar::int16},
                                                         {"signed short", Scalar::int16},
                                                         {"signed short int", Scalar::int16},
                                                         {"int16", Scalar::int16},
                                                         {"int16_t", Scalar::int16},
                                                         {"ushort", Scalar::uint16},
                                                         {"unsigned short", Scalar::uint16},
                                                         {"unsigned short int", Scalar::uint16},
                                                         {"uint16", Scalar::uint16},
                                                         {"uint16_t", Scalar::uint16},
                                                         {"int", Scalar::int32},
                                                         {"signed int", Scalar::int32},
                                                         {"int32", Scalar::int32},
                                                         {"int32_t", Scalar::int32},
                                                         {"uint", Scalar::uint32},
                                                         {"unsigned int", Scalar::uint32},
                                                         {"uint32", Scalar::uint32},
                                                         {"uint32_t", Scalar::uint32},
                                                         {"longlong", Scalar::int64},
                                                         {"long long", Scalar::int64},
                                                         {"long long int", Scalar::int64},
                                                         {"signed long long", Scalar::int64},
                                                         {"signed long long int", Scalar::int64},
                                                         {"int64", Scalar::int64},
                                                         {"int64_t", Scalar::int64},
                                                         {"ulonglong", Scalar::uint64},
                                                         {"unsigned long long", Scalar::uint64},
                                                         {"unsigned long long int", Scalar::uint64},
                                                         {"uint64", Scalar::uint64},
                                                         {"uint64_t", Scalar::uint64},
                                                         {"float", Scalar::float32},
                                                         {"double", Scalar::float64}};
  const auto found = kScalars.find(type);
  if (found == kScalars.end()) return std::nullopt;
  return found->second;
}

// Fills in sizes, type and bytes.
Status count_nrrd_bytes(const TextHeader& header, const std::string& name, PixelLayout& layout) {
  const auto sizes = whole_numbers(header.find("sizes").value_or(""));
  if (!sizes || sizes->empty() || sizes->size() > 16) {
    return fail(ErrorKind::input, "{}: sizes: '{}'", name, header.find("sizes").value_or("missing"));
  }
  if (header.find("dimension").value_or("") != std::to_string(sizes->size())) {
    return fail(ErrorKind::input, "{}: dimension is '{}', sizes has {} numbers", name,
                header.find("dimension").value_or("missing"), sizes->size());
  }
  layout.voxels = 1;
  for (const std::int64_t size : *sizes) {
    const auto product = checked_product(layout.voxels, size);
    if (size < 1 || !product) {
      return fail(ErrorKind::input, "{}: sizes: '{}' make no volume", name, *header.find("sizes"));
    }
    layout.voxels = *product;
  }
  const std::string type = header.find("type").value_or("missing");
  const auto scalar = nrrd_scalar(type);
  if (!scalar) return fail(ErrorKind::input, "{}: type: '{}' is not a scalar type", name, type);
  layout.scalar = *scalar;
  const auto total = checked_product(layout.voxels, bytes_of(*scalar));
  if (!total) return fail(ErrorKind::input, "{}: sizes: too many voxels", name);
  layout.bytes = *total;
  return {};
}

Status choose_byte_order(const TextHeader& header, const std::string& name, PixelLayout& layout) {
  if (layout.coding == Coding::text || bytes_of(layout.scalar) == 1) return {};
  const std::string endian = header.find("endian").value_or("missing");
  if (endian != "little" && endian != "big") {
    return fail(ErrorKind::input, "{}: endian: '{}' is neither little nor big", name, endian);
  }
  layout.swapped = (endian == "big") != (std::endian::native == std::endian::big);
  return {};
}

Status choose_coding(const TextHeader& header, const std::string& name, PixelLayout& layout) {
  const std::string encoding = header.find("encoding").value_or("missing");
  if (encoding == "raw") {
    layout.coding = Coding::raw;
  } else if (encoding == "gzip" || encoding == "gz") {
    layout.coding = Coding::deflate;
  } else if (encoding == "ascii" || encoding == "text" || encoding == "txt") {
    layout.coding = Coding::text;
  } else {
    return fail(ErrorKind::input, "{}: encoding: '{}' is not supported", name, encoding);
  }
  for (const char* field : {"line skip", "lineskip", "byte skip", "byteskip"}) {
    const std::string skip = header.find(field).value_or("0");
    if (skip != "0") return fail(ErrorKind::input, "{}: {}: {} is not supported", name, field, skip);
  }
  return {};
}

std::optional<double> nrrd_unit_in_mm(std::string word) {
  static const std::map<std::string, double> kUnits = {
      {"m", 1e3},           {"meter", 1e3},       {"metre", 1e3},       {"cm", 10.0},
      {"centimeter", 10.0}, {"centimetre", 10.0}, {"mm", 1.0},          {"millimeter", 1.0},
      {"millimetre", 1.0},  {"um", 1e-3},         {"\u00b5m", 1e-3},  // the micro sign
      {"\u03bcm", 1e-3},                                              // the Greek letter
      {"micron", 1e-3},     {"micrometer", 1e-3}, {"micrometre", 1e-3}, {"nm", 1e-6},
      {"nanometer", 1e-6},  {"nanometre", 1e-6}};
  word = lower(std::move(word));
  if (word.size() > 3 && word.back() == 's') word.pop_back();
  const auto found = kUnits.find(word);
  if (found == kUnits.end()) return std::nullopt;
  return found->second;
}

// A word in quotation marks for each axis of the space ("space units"), or of the file where there is none
// ("units"; one of time does not count there). An empty one says nothing.
Status take_nrrd_unit(const TextHeader& header, const std::string& name, PixelLayout& layout) {
  const bool has_space = header.find("space directions").has_value();
  const char* const field = has_space ? "space units" : "units";
  const std::string stated = header.find(field).value_or("");
  std::optional<double> common;
  std::string unknown;
  for (std::size_t begin = stated.find('"'); begin != std::string::npos;) {
    const std::size_t end = std::min(stated.find('"', begin + 1), stated.size());
    const std::string word = stated.substr(begin + 1, end - begin - 1);
    begin = stated.find('"', end + 1);
    if (word.empty()) continue;
    const auto unit = nrrd_unit_in_mm(word);
    if (!unit) {
      unknown = word;
      continue;
    }
    if (common.value_or(*unit) != *unit)
      return fail(ErrorKind::input, "{}: {}: {} are not the same for all axes", name, field, stated);
    common = unit;
  }
  if (!unknown.empty() && (has_space || !common)) {
    unknown.resize(std::min<std::size_t>(unknown.size(), 80));
    if (has_space) {
      layout.warnings.push_back(
          fmt::format("space units '{}' are not known; lengths are read as mm", unknown));
    } else {
      layout.warnings.push_back(fmt::format("units '{}' are not known; lengths are read as mm", unknown));
    }
    return {};
  }
  layout.spacing_scale = layout.origin_scale = common.value_or(1.0);
  return {};
}

// The space along whose axes directions and origin are given, by the spellings of NRRD's own library. In some
// versions ITK turns the wrong axis of left-anterior-superior, and it turns none of a space with time.
Status take_nrrd_space(const TextHeader& header, const std::string& name, PixelLayout& layout) {
  static const std::set<std::string> kRight = {
      "rightanteriorsuperior", "ras", "leftposteriorsuperior", "lps", "leftposteriorsuperiortime", "lpst"};
  static const std::set<std::string> kTurned = {
      "leftanteriorsuperior", "las", "leftanteriorsuperiortime", "last", "rightanteriorsuperiortime", "rast"};
  const std::string stated = header.find("space").value_or("");
  std::string space = lower(stated);
  std::erase_if(space, [](char c) { return c == '-' || c == ' '; });
  if (kTurned.contains(space)) {
    return fail(ErrorKind::input,
                "{}: space: '{}' is not supported; left-posterior-superior and right-anterior-superior are",
                name, stated);
  }
  layout.oriented = kRight.contains(space);
  return {};
}

}  // namespace

Result<PixelLayout> locate_nrrd(const std::filesystem::path& file) {
  const std::string name = file.string();
  const auto header = read_nrrd_header(file);
  if (!header) return pass_on(header);
  PixelLayout layout{.file = file, .offset = header->end};
  TIDEMARK_TRY(count_nrrd_bytes(*header, name, layout));
  TIDEMARK_TRY(choose_coding(*header, name, layout));
  TIDEMARK_TRY(choose_byte_order(*header, name, layout));
  TIDEMARK_TRY(require_finite_fields(*header, file, {"space directions", "space origin", "spacings"}));
  TIDEMARK_TRY(take_nrrd_unit(*header, name, layout));
  TIDEMARK_TRY(take_nrrd_space(*header, name, layout));
  auto data = header->find("data file");
  if (!data) data = header->find("datafile");
  if (data) {
    auto path = detached_file(file, *data);
    if (!path) return pass_on(path);
    layout.file = *path;
    layout.offset = 0;
  }
  return layout;
}

}  // namespace tidemark::imaging::files
