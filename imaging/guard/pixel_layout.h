// The place of a volume file's voxels by its own header, read before ITK sees the file. The libraries behind
// ITK take sizes at their word and do not all report a short file. Every format is checked here, once and in
// the same words.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "imaging/guard/scalar.h"

namespace tidemark::imaging::files {

enum class Format { nifti, nrrd, meta, gipl };
enum class Coding { raw, deflate, text };

struct PixelLayout {
  std::filesystem::path file;  // holds the voxels: the file itself, or the one that its header names
  Coding coding = Coding::raw;
  std::int64_t offset = 0;  // in `file`, of the first voxel or of the compressed stream
  std::int64_t prefix = 0;  // bytes of the inflated stream that come before the voxels
  std::int64_t voxels = 0;  // product of all sizes in the header
  std::int64_t bytes = 0;   // of all voxels, inflated
  Scalar scalar = Scalar::uint8;
  bool swapped = false;  // its bytes come in the other order than this processor's
  double slope = 1.0;    // a voxel's value is slope * stored + intercept
  double intercept = 0.0;
  bool oriented = true;  // the header says how the axes lie in the patient
  // What makes mm of the lengths that ITK gives: it scales the spacing of a NIfTI header in another unit, and
  // nothing of such an NRRD header.
  double spacing_scale = 1.0;
  double origin_scale = 1.0;
  // Of such a NIfTI file the origins in the header's unit (LPS): an origin that ITK gives and that is none of
  // these is in mm.
  std::vector<glm::dvec3> origins = {};
  std::vector<std::string> warnings = {};
};

// By suffix, case ignored; nothing for a name of another kind.
std::optional<Format> format_of(const std::filesystem::path& file);
bool has_suffix(const std::filesystem::path& file, const char* suffix);

// Reads and checks the header. Fails (ErrorKind::input) naming the file and the field.
Result<PixelLayout> locate_pixels(const std::filesystem::path& file);

// Whether the bytes on disk can hold the voxels: their exact number when raw, at least two bytes a voxel as
// text, and when compressed at most 1032 times what is there (deflate cannot do better). Takes no memory or
// time.
Status check_extent(const PixelLayout& layout);

// Goes through a compressed stream or a text, keeping nothing: a stream must be whole, with the right
// checksum, and hold exactly the bytes that the header says; a text must hold exactly so many finite numbers.
Status check_stream(const PixelLayout& layout);

// Reads all voxels' bytes, as they are stored, into `destination` (layout.bytes long). Not for text. A
// compressed stream is checked as check_stream() does.
Status read_stored(const PixelLayout& layout, void* destination);

// One per format.
Result<PixelLayout> locate_nifti(const std::filesystem::path& file);
Result<PixelLayout> locate_nrrd(const std::filesystem::path& file);
Result<PixelLayout> locate_meta(const std::filesystem::path& file);
Result<PixelLayout> locate_gipl(const std::filesystem::path& file);

// The first `count` bytes of a file (fewer when it is shorter), inflated when it is a gzip file.
Result<std::string> read_start(const std::filesystem::path& file, std::size_t count);
bool is_gzip(const std::filesystem::path& file);

// A header of lines "name<separator>value"; blanks around both removed.
struct TextHeader {
  std::map<std::string, std::string> fields;
  std::int64_t end = 0;       // offset of the byte after the header's last line
  std::string repeated = {};  // a name that occurs twice

  // The field's value, or nothing.
  [[nodiscard]] std::optional<std::string> find(const std::string& name) const;
};

std::string lower(std::string text);

// Whole numbers separated by blanks; nothing when there is anything else.
std::optional<std::vector<std::int64_t>> whole_numbers(const std::string& text);

// The file beside `header` that a header names as the one with the voxels. Lists, patterns, absolute paths
// and paths out of the header's folder are refused.
Result<std::filesystem::path> detached_file(const std::filesystem::path& header, const std::string& name);

}  // namespace tidemark::imaging::files
