// The MetaImage header: lines "name = value", the last is ElementDataFile
// (https://itk.org/Wiki/ITK/MetaIO/Documentation).
#include <bit>

#include "core/checked.h"
#include "imaging/guard/pixel_layout.h"
#include "imaging/guard/text_header.h"

namespace tidemark::imaging::files {
namespace {

std::optional<Scalar> meta_scalar(const std::string& type) {
  static const std::map<std::string, Scalar> kScalars = {
      {"MET_CHAR", Scalar::int8},         {"MET_UCHAR", Scalar::uint8},   {"MET_SHORT", Scalar::int16},
      {"MET_USHORT", Scalar::uint16},     {"MET_INT", Scalar::int32},     {"MET_UINT", Scalar::uint32},
      {"MET_LONG", Scalar::int32},        {"MET_ULONG", Scalar::uint32},  {"MET_LONG_LONG", Scalar::int64},
      {"MET_ULONG_LONG", Scalar::uint64}, {"MET_FLOAT", Scalar::float32}, {"MET_DOUBLE", Scalar::float64}};
  const auto found = kScalars.find(type);
  if (found == kScalars.end()) return std::nullopt;
  return found->second;
}

bool is_true(const TextHeader& header, const char* name, bool otherwise) {
  const auto value = header.find(name);
  if (!value || value->empty()) return otherwise;
  return value->front() == 'T' || value->front() == 't' || value->front() == '1';
}

Status count_meta_bytes(const TextHeader& header, const std::string& name, PixelLayout& layout) {
  const auto text = header.find("DimSize");
  const auto sizes = whole_numbers(text.value_or(""));
  const auto dimensions = whole_numbers(header.find("NDims").value_or(""));
  if (!dimensions || dimensions->size() != 1 || dimensions->front() < 1 || dimensions->front() > 10) {
    return fail(ErrorKind::input, "{}: NDims is '{}'", name, header.find("NDims").value_or("missing"));
  }
  if (!sizes || static_cast<std::int64_t>(sizes->size()) != dimensions->front()) {
    return fail(ErrorKind::input, "{}: DimSize is '{}', NDims is {}", name, text.value_or("missing"),
                dimensions->front());
  }
  layout.voxels = 1;
  for (const std::int64_t size : *sizes) {
    const auto product = checked_product(layout.voxels, size);
    if (size < 1 || !product) return fail(ErrorKind::input, "{}: DimSize '{}' makes no volume", name, *text);
    layout.voxels = *product;
  }
  if (header.find("ElementNumberOfChannels").value_or("1") != "1") {
    return fail(ErrorKind::input, "{}: ElementNumberOfChannels is {}: only one channel is supported", name,
                *header.find("ElementNumberOfChannels"));
  }
  const std::string type = header.find("ElementType").value_or("missing");
  const auto scalar = meta_scalar(type);
  if (!scalar) return fail(ErrorKind::input, "{}: ElementType {} is not a scalar type", name, type);
  layout.scalar = *scalar;
  const auto total = checked_product(layout.voxels, bytes_of(*scalar));
  if (!total) return fail(ErrorKind::input, "{}: DimSize: too many voxels", name);
  layout.bytes = *total;
  return {};
}

// Where the voxels begin in the data file.
Status find_offset(const TextHeader& header, const std::string& name, PixelLayout& layout) {
  const auto skip = whole_numbers(header.find("HeaderSize").value_or("0"));
  if (!skip || skip->size() != 1 || skip->front() < -1) {
    return fail(ErrorKind::input, "{}: HeaderSize is '{}'", name, *header.find("HeaderSize"));
  }
  if (skip->front() == -1) {  // the voxels are the end of the file
    std::error_code error;
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(layout.file, error));
    if (error) return fail(ErrorKind::input, "{}: {}", layout.file.string(), error.message());
    layout.offset = std::max<std::int64_t>(0, size - layout.bytes);
  } else {
    layout.offset += skip->front();
  }
  return {};
}

// The library takes as much memory as this field says.
Status check_compressed_size(const TextHeader& header, const std::string& name, const PixelLayout& layout) {
  const auto stated = header.find("CompressedDataSize");
  if (!stated || layout.coding != Coding::deflate) return {};
  std::error_code error;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(layout.file, error));
  const auto numbers = whole_numbers(*stated);
  if (!error && numbers && numbers->size() == 1 && numbers->front() >= 0 &&
      numbers->front() <= std::max<std::int64_t>(0, size - layout.offset)) {
    return {};
  }
  return fail(ErrorKind::input, "{}: CompressedDataSize is '{}', the file has {} bytes", name, *stated,
              error ? 0 : size);
}

}  // namespace

Result<PixelLayout> locate_meta(const std::filesystem::path& file) {
  const std::string name = file.string();
  const auto header = read_meta_header(file);
  if (!header) return pass_on(header);
  PixelLayout layout{.file = file, .offset = header->end};
  TIDEMARK_TRY(count_meta_bytes(*header, name, layout));
  TIDEMARK_TRY(require_finite_fields(*header, file,
                                     {"TransformMatrix", "Rotation", "Orientation", "Offset", "Position",
                                      "Origin", "ElementSpacing", "ElementSize"}));
  if (is_true(*header, "CompressedData", false)) {
    layout.coding = Coding::deflate;
  } else if (!is_true(*header, "BinaryData", true)) {
    layout.coding = Coding::text;
  }
  // The second of these names overrules the first one in the library, too.
  constexpr bool kNative = std::endian::native == std::endian::big;
  const bool is_big =
      is_true(*header, "ElementByteOrderMSB", is_true(*header, "BinaryDataByteOrderMSB", kNative));
  layout.swapped = is_big != kNative;
  const std::string data = *header->find("ElementDataFile");
  if (data != "LOCAL" && data != "Local" && data != "local") {
    auto path = detached_file(file, data);
    if (!path) return pass_on(path);
    layout.file = *path;
    layout.offset = 0;
  }
  TIDEMARK_TRY(find_offset(*header, name, layout));
  TIDEMARK_TRY(check_compressed_size(*header, name, layout));
  layout.oriented =
      header->find("TransformMatrix") || header->find("Orientation") || header->find("Rotation");
  return layout;
}

}  // namespace tidemark::imaging::files
