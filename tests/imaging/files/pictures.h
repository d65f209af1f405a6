// Small PNG, JPEG and TIFF files, good ones and bad ones.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tidemark::test {

// Big endian, of two or four bytes.
std::string big(std::uint32_t number, int count = 4);

// A PNG file byte by byte. `rows` has the scanlines as they are stored, without their filter bytes.
struct Png {
  std::uint32_t columns = 4;
  std::uint32_t rows = 3;
  int bits = 8;
  int colour_type = 0;      // 0 grey, 2 colours, 3 palette, 4 grey and opacity, 6 colours and opacity
  std::string before = {};  // chunks in front of the pixels
  bool interlaced = false;  // of 8 bits a pixel alone

  [[nodiscard]] std::string header() const;  // signature and IHDR
  [[nodiscard]] std::string with(const std::string& scanlines) const;
};
std::string png_chunk(const std::string& type, const std::string& data);

// `samples`: one or three (or four, for printing inks) a pixel. `app1` is the contents of that marker.
struct Jpeg {
  int columns = 16;
  int rows = 8;
  int channels = 1;
  int dpi = 0;
  bool progressive = false;
  int scans = 0;  // of one coefficient each after the first, where it is above 0
  std::string app1 = {};

  [[nodiscard]] std::string with(const std::vector<std::uint8_t>& samples) const;
};
// The contents of an APP1 marker that says how a picture lies, in either byte order.
std::string exif_orientation_marker(int orientation, bool big_endian);

// A page of a TIFF file; numbers are those of TIFF 6.0. `bytes` are its rows.
struct TiffPage {
  std::uint32_t columns = 4;
  std::uint32_t rows = 3;
  int bits = 8;
  int samples = 1;
  int format = 1;       // 1 without sign, 2 with sign, 3 float
  int meaning = 1;      // 0 white is zero, 1 black is zero, 2 colours, 3 palette
  int compression = 1;  // 1 none, 5 LZW, 8 deflate, 32773 PackBits
  int tile = 0;         // of both sides, in pixels; 0: strips
  int orientation = 1;
  int planes = 1;
  int subfile = 0;
  double dpi = 0.0;
  std::string bytes = {};
};
std::string tiff(const std::vector<TiffPage>& pages);

}  // namespace tidemark::test
