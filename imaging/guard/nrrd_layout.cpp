// The NRRD header: lines "field: value" up to an empty one (http://teem.sourceforge.net/nrrd/format.html).
#include "core/checked.h"
#include "imaging/guard/pixel_layout.h"
#include "imaging/guard/text_header.h"

namespace tidemark::imaging::files {
namespace {

// Bytes of a voxel by NRRD's type names; nothing for "block" and unknown ones.
std::optional<int> bytes_of(const std::string& type) {
  static const std::map<std::string, int> kBytes = {{"signed char", 1},
                                                    {"int8", 1},
                                                    {"int8_t", 1},
                                                    {"uchar", 1},
                                                    {"unsigned char", 1},
                                                    {"uint8", 1},
                                                    {"uint8_t", 1},
                                                    {"short", 2},
                                                    {"short int", 2},
                                                    {"signed short", 2},
                                                    {"signed short int", 2},
                                                    {"int16", 2},
                                                    {"int16_t", 2},
                                                    {"ushort", 2},
                                                    {"unsigned short", 2},
                                                    {"unsigned short int", 2},
                                                    {"uint16", 2},
                                                    {"uint16_t", 2},
                                                    {"int", 4},
                                                    {"signed int", 4},
                                                    {"int32", 4},
                                                    {"int32_t", 4},
                                                    {"uint", 4},
                                                    {"unsigned int", 4},
                                                    {"uint32", 4},
                                                    {"uint32_t", 4},
                                                    {"longlong", 8},
                                                    {"long long", 8},
                                                    {"long long int", 8},
                                                    {"signed long long", 8},
                                                    {"signed long long int", 8},
                                                    {"int64", 8},
                                                    {"int64_t", 8},
                                                    {"ulonglong", 8},
                                                    {"unsigned long long", 8},
                                                    {"unsigned long long int", 8},
                                                    {"uint64", 8},
                                                    {"uint64_t", 8},
                                                    {"float", 4},
                                                    {"double", 8}};
  const auto found = kBytes.find(type);
  if (found == kBytes.end()) return std::nullopt;
  return found->second;
}

// Fills in sizes and bytes.
Status count_bytes(const TextHeader& header, const std::string& name, PixelLayout& layout) {
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
  const auto bytes = bytes_of(type);
  if (!bytes) return fail(ErrorKind::input, "{}: type: '{}' is not a scalar type", name, type);
  const auto total = checked_product(layout.voxels, *bytes);
  if (!total) return fail(ErrorKind::input, "{}: sizes: too many voxels", name);
  layout.bytes = *total;
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

}  // namespace

Result<PixelLayout> locate_nrrd(const std::filesystem::path& file) {
  const std::string name = file.string();
  const auto header = read_nrrd_header(file);
  if (!header) return tl::unexpected<Error>(header.error());
  PixelLayout layout{.file = file, .offset = header->end};
  TIDEMARK_TRY(count_bytes(*header, name, layout));
  TIDEMARK_TRY(choose_coding(*header, name, layout));
  TIDEMARK_TRY(require_finite_fields(*header, file, {"space directions", "space origin", "spacings"}));
  auto data = header->find("data file");
  if (!data) data = header->find("datafile");
  if (data) {
    auto path = detached_file(file, *data);
    if (!path) return pass_on(path);
    layout.file = *path;
    layout.offset = 0;
  }
  layout.oriented = header->find("space").has_value();
  return layout;
}

}  // namespace tidemark::imaging::files
