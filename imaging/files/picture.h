// Pictures as volumes: PNG, JPEG, and TIFF of one page or several. Private to this folder.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/volume.h"
#include "imaging/guard/byte_source.h"
#include "imaging/guard/scalar.h"
#include "imaging/series.h"

namespace tidemark::imaging::files {

enum class PictureFormat { png, jpeg, tiff };

// By suffix, case ignored: .png .jpg .jpeg .tif .tiff; nothing for a name of another kind.
std::optional<PictureFormat> picture_format_of(const std::filesystem::path& file);

// What a picture is before its pixels are read. Columns and rows are those that the file stores.
struct PictureHeader {
  std::int64_t columns = 0;
  std::int64_t rows = 0;
  std::int64_t pages = 1;         // of this size each
  int channels = 1;               // 1: grey, 3: red, green and blue; opacity is no channel
  Scalar scalar = Scalar::uint8;  // of a channel
  bool has_opacity = false;       // which is left out
  int orientation = 1;            // EXIF and TIFF 6.0: where the first row and column lie, 1 to 8
  glm::dvec2 pixels_per_mm{0.0};  // along a row, along a column; 0 where the file does not say
  std::vector<std::string> changes = {};
  std::vector<std::string> warnings = {};
};

// A row's samples, interleaved, as they are stored; 32-bit integers are rounded to float.
using RowSink = std::function<void(std::int64_t page, std::int64_t row, std::span<const float> samples)>;

// An open picture, whose header was read and checked: its pixels cost no more memory than its bytes allow.
class Picture {
 public:
  virtual ~Picture() = default;
  [[nodiscard]] const PictureHeader& header() const { return header_; }
  // Each row of each page, in their order. Called once. Fails (ErrorKind::input, or cancelled) naming the
  // file.
  virtual Status read(const RowSink& sink, const Progress& progress) = 0;
  // What only the pixels show, after read().
  [[nodiscard]] virtual std::vector<std::string> remarks() const { return {}; }

 protected:
  PictureHeader header_;
};

// Each reads from the bytes alone; the path is for messages.
Result<std::unique_ptr<Picture>> open_png(FileBytes bytes, const std::filesystem::path& file);
Result<std::unique_ptr<Picture>> open_jpeg(FileBytes bytes, const std::filesystem::path& file);
Result<std::unique_ptr<Picture>> open_tiff(FileBytes bytes, const std::filesystem::path& file);

// The check before pixels are read: `most_per_byte` is the number of pixels, or bytes of them, that a byte of
// the file can make at best. `field` names where the size stands.
Status require_held(const PictureHeader& header, std::int64_t most_per_byte, std::int64_t file_bytes,
                    const std::string& field, const std::filesystem::path& file);

// The picture as a series of one volume, and as a volume: i along its rows to the right, j down, k its pages.
// Colours become their luminance; orientation is applied.
Series scan_picture(const std::filesystem::path& file);
Result<Volume> read_picture(const std::filesystem::path& file, const Progress& progress);

}  // namespace tidemark::imaging::files
