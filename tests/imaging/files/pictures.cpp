#include "tests/imaging/files/pictures.h"

#include <cstdio>  // before jpeglib.h, which needs FILE

#include <jpeglib.h>
#include <tiffio.h>
#include <zlib.h>

#include <QtGlobal>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "tests/support/support.h"

namespace tidemark::test {
namespace {

std::string deflated(const std::string& bytes) {
  std::string packed(compressBound(bytes.size()), '\0');
  uLongf length = packed.size();
  compress2(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
            bytes.size(), 9);
  packed.resize(length);
  return packed;
}

// The seven passes of Adam7 over bytes, each row behind its filter byte.
std::string interlace(const Png& png, const std::string& pixels) {
  struct Pass {
    std::uint32_t x, y, across, down;
  };
  constexpr std::array<Pass, 7> kPasses{
      {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};
  std::string all;
  for (const Pass& pass : kPasses) {
    for (std::uint32_t y = pass.y; y < png.rows && pass.x < png.columns; y += pass.down) {
      all += '\0';
      for (std::uint32_t x = pass.x; x < png.columns; x += pass.across) all += pixels[y * png.columns + x];
    }
  }
  return all;
}

void write_page(TIFF* file, const TiffPage& page) {
  TIFFSetField(file, TIFFTAG_SUBFILETYPE, page.subfile);
  TIFFSetField(file, TIFFTAG_IMAGEWIDTH, page.columns);
  TIFFSetField(file, TIFFTAG_IMAGELENGTH, page.rows);
  TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, page.bits);
  TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, page.samples);
  TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, page.format);
  TIFFSetField(file, TIFFTAG_PHOTOMETRIC, page.meaning);
  TIFFSetField(file, TIFFTAG_COMPRESSION, page.compression);
  TIFFSetField(file, TIFFTAG_ORIENTATION, page.orientation);
  TIFFSetField(file, TIFFTAG_PLANARCONFIG, page.planes);
  if (page.dpi > 0.0) {
    TIFFSetField(file, TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
    TIFFSetField(file, TIFFTAG_XRESOLUTION, page.dpi);
    TIFFSetField(file, TIFFTAG_YRESOLUTION, page.dpi);
  }
  if (page.meaning == PHOTOMETRIC_PALETTE) {
    std::array<std::vector<std::uint16_t>, 3> colours;
    for (auto& colour : colours) colour.resize(256);
    for (std::uint16_t n = 0; n < 256; ++n) {
      for (auto& colour : colours) colour[n] = static_cast<std::uint16_t>(65535 - n);
    }
    TIFFSetField(file, TIFFTAG_COLORMAP, colours[0].data(), colours[1].data(), colours[2].data());
  }
  const std::size_t row_bytes = page.planes == 2 ? page.columns * static_cast<std::size_t>(page.bits) / 8
                                                 : page.bytes.size() / page.rows;
  if (page.tile == 0) {
    TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, 2);
    std::string rows = page.bytes;
    for (std::uint32_t y = 0; y < page.rows; ++y) TIFFWriteScanline(file, rows.data() + y * row_bytes, y, 0);
  } else {
    TIFFSetField(file, TIFFTAG_TILEWIDTH, page.tile);
    TIFFSetField(file, TIFFTAG_TILELENGTH, page.tile);
    const std::size_t pixel = row_bytes / page.columns;
    const auto side = static_cast<std::uint32_t>(page.tile);
    for (std::uint32_t y = 0; y < page.rows; y += side) {
      for (std::uint32_t x = 0; x < page.columns; x += side) {
        std::string tile(side * side * pixel, '\0');
        for (std::uint32_t v = 0; v < side && y + v < page.rows; ++v) {
          const std::size_t count = std::min(side, page.columns - x) * pixel;
          std::memcpy(tile.data() + v * side * pixel, page.bytes.data() + (y + v) * row_bytes + x * pixel,
                      count);
        }
        TIFFWriteTile(file, tile.data(), x, y, 0, 0);
      }
    }
  }
  TIFFWriteDirectory(file);
}

}  // namespace

std::string big(std::uint32_t number, int count) {
  std::string bytes;
  for (int n = count - 1; n >= 0; --n) bytes += static_cast<char>(number >> (8 * n));
  return bytes;
}

std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string summed = type + data;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(summed.data()), static_cast<uInt>(summed.size()));
  return big(static_cast<std::uint32_t>(data.size())) + summed + big(static_cast<std::uint32_t>(sum));
}

std::string Png::header() const {
  const std::string kind{static_cast<char>(bits), static_cast<char>(colour_type), 0, 0,
                         static_cast<char>(interlaced ? 1 : 0)};
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", big(columns) + big(rows) + kind);
}

std::string Png::with(const std::string& scanlines) const {
  std::string filtered;
  const std::size_t row_bytes = scanlines.size() / rows;
  for (std::uint32_t y = 0; y < rows; ++y) filtered += '\0' + scanlines.substr(y * row_bytes, row_bytes);
  if (interlaced) filtered = interlace(*this, scanlines);
  return header() + before + png_chunk("IDAT", deflated(filtered)) + png_chunk("IEND", "");
}

std::string Jpeg::with(const std::vector<std::uint8_t>& samples) const {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* memory = nullptr;
  unsigned long length = 0;
  jpeg_mem_dest(&jpeg, &memory, &length);
  jpeg.image_width = static_cast<JDIMENSION>(columns);
  jpeg.image_height = static_cast<JDIMENSION>(rows);
  jpeg.input_components = channels;
  jpeg.in_color_space = channels == 1 ? JCS_GRAYSCALE : channels == 3 ? JCS_RGB : JCS_CMYK;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 95, TRUE);
  if (dpi > 0) {
    jpeg.density_unit = 1;
    jpeg.X_density = jpeg.Y_density = static_cast<UINT16>(dpi);
  }
  if (progressive) jpeg_simple_progression(&jpeg);
  std::vector<jpeg_scan_info> script;
  for (int scan = 0; scan < scans; ++scan) script.push_back({1, {0, 0, 0, 0}, scan, scan, 0, 0});
  if (scans > 0) {
    jpeg.scan_info = script.data();
    jpeg.num_scans = scans;
  }
  jpeg_start_compress(&jpeg, TRUE);
  if (!app1.empty()) {
    jpeg_write_marker(&jpeg, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(app1.data()),
                      static_cast<unsigned>(app1.size()));
  }
  std::vector<std::uint8_t> row(static_cast<std::size_t>(columns * channels));
  for (std::size_t y = 0; y < static_cast<std::size_t>(rows); ++y) {
    std::memcpy(row.data(), samples.data() + y * row.size(), row.size());
    JSAMPROW line = row.data();
    jpeg_write_scanlines(&jpeg, &line, 1);
  }
  jpeg_finish_compress(&jpeg);
  std::string bytes(reinterpret_cast<const char*>(memory), length);
  jpeg_destroy_compress(&jpeg);
  std::free(memory);
  return bytes;
}

std::string exif_orientation_marker(int orientation, bool big_endian) {
  const auto number = [&](std::uint32_t value, int count) {
    std::string bytes = big(value, count);
    return big_endian ? bytes : std::string(bytes.rbegin(), bytes.rend());
  };
  return std::string("Exif\0\0", 6) + (big_endian ? "MM" : "II") + number(42, 2) + number(8, 4) +
         number(1, 2) + number(274, 2) + number(3, 2) + number(1, 4) +
         number(static_cast<std::uint32_t>(orientation), 2) + number(0, 2) + number(0, 4);
}

std::string tiff(const std::vector<TiffPage>& pages) {
  const TemporaryFolder folder;
  const auto path = folder / "made.tif";
  TIFF* file = TIFFOpen(path.c_str(), "w");
  if (file == nullptr) qFatal("cannot make a TIFF file");
  for (const TiffPage& page : pages) write_page(file, page);
  TIFFClose(file);
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace tidemark::test
