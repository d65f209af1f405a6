// Files whose pixel data are not what their header promises.
#include "tests/imaging/dicom/bad_dicom.h"
#include "tests/imaging/dicom/dicom_bytes.h"
#include "tests/support/test_program.h"

namespace tidemark::test::bad_dicom_pixels_test {

namespace {

constexpr const char* kRle = "1.2.840.10008.1.2.5";
constexpr const char* kJpeg = "1.2.840.10008.1.2.4.70";
constexpr const char* kJpegLs = "1.2.840.10008.1.2.4.80";
constexpr const char* kJpeg2000 = "1.2.840.10008.1.2.4.90";
constexpr std::uint32_t kFrames = 0x00280008;
constexpr std::uint32_t kRows = 0x00280010;
constexpr std::uint32_t kColumns = 0x00280011;
constexpr std::uint32_t kBitsAllocated = 0x00280100;

const std::string kPixelData = "PixelData (7FE0,0010) ";

std::string with_pixels(const std::string& value, const char* vr = "OW") {
  return file(Dataset::slice().put(kPixels, element(kPixels, vr, value)));
}

std::string with_number(std::uint32_t tag, std::uint32_t value) {
  return file(Dataset::slice().put_number(tag, value));
}

std::string with_text(std::uint32_t tag, const char* vr, const std::string& value) {
  return file(Dataset::slice().put_text(tag, vr, value));
}

// A compressed slice with that frame, or with those bytes in place of the whole element.
std::string compressed(const char* syntax, const std::string& pixel_data) {
  return file(syntax, Dataset::slice().put(kPixels, pixel_data).bytes());
}

std::string fragments(const std::string& table, const std::string& items) {
  return element(kPixels, "OB", item(table) + items, kExplicit, kUndefinedLength);
}

std::string big(std::uint32_t value) {
  return word(value, kBigEndian);
}

// A JPEG stream that ends after its frame header.
std::string jpeg(std::uint32_t columns, std::uint32_t rows, char components = 1,
                 const char* marker = "\xff\xc3") {
  std::string frame = "\xff\xd8" + std::string(marker) + big(static_cast<std::uint32_t>(8 + 3 * components)) +
                      '\x10' + big(rows) + big(columns) + components;
  for (char c = 1; c <= components; ++c) frame += {c, '\x11', '\0'};
  return frame + std::string(frame.size() % 2 + 8, '\0');
}

// A JPEG 2000 stream that ends after its SIZ marker.
std::string jpeg_2000(std::uint32_t columns, std::uint32_t rows, std::uint32_t tile_columns,
                      std::uint32_t components = 1) {
  const auto size = [](std::uint32_t value) { return long_word(value, kBigEndian); };
  std::string stream = "\xff\x4f\xff\x51" + big(38 + 3 * components) + big(0) + size(columns) + size(rows) +
                       size(0) + size(0) + size(tile_columns) + size(tile_columns) + size(0) + size(0) +
                       big(components);
  for (std::uint32_t c = 0; c < components; ++c) stream += {'\x0f', '\1', '\1'};
  return stream + std::string(stream.size() % 2 + 8, '\0');
}

// A JP2 file whose stream goes on with SIZ markers, each with the start of another stream at its end.
std::string nested_jpeg_2000() {
  const std::string siz = jpeg_2000(4, 3, 4).substr(0, 45);
  std::string frame = std::string("\0\0\0\x0cjP  \r\n\x87\n\0\0\0\0jp2c", 20) + siz;
  for (int n = 0; n < 200'000; ++n) frame += std::string("\xff\x51\0\6\0\0\xff\x4f", 8);
  return frame + '\0';
}

// An RLE frame with that many segments, which begin at those offsets.
std::string rle(std::uint32_t segments, const std::vector<std::uint32_t>& offsets, const std::string& data) {
  std::string header = long_word(segments);
  for (std::size_t k = 0; k < 15; ++k) header += long_word(k < offsets.size() ? offsets[k] : 0);
  return header + data;
}

std::vector<BadDicom> native_pixels() {
  const auto rows_as_long = [](std::uint32_t rows) {
    return file(Dataset::slice().put(kRows, element(kRows, "UL", long_word(rows))));
  };
  const auto without = [](std::uint32_t tag) { return file(Dataset::slice().remove(tag)); };
  const std::string endless =
      element(kPixels, "OW", item("") + item("abcd") + sequence_end(), kExplicit, kUndefinedLength);
  const std::string endless_implicit =
      element(kPixels, "OW", item("") + item("abcd") + sequence_end(), kImplicit, kUndefinedLength);
  return {
      {"absent", without(kPixels), kPixelData + "is missing"},
      {"empty", with_pixels(""), kPixelData + "holds 0 bytes where 4 x 3 pixels of 16 bits need 24"},
      {"short", with_pixels(std::string(10, 'x')), kPixelData + "holds 10 bytes"},
      {"two bytes short", with_pixels(std::string(22, 'x')), kPixelData + "holds 22 bytes"},
      {"long", with_pixels(std::string(26, 'x')), kPixelData + "holds 26 bytes"},
      {"much too long", with_pixels(std::string(100000, 'x')), kPixelData + "holds 100000 bytes"},
      {"odd", with_pixels(std::string(23, 'x')), kPixelData + "has an odd length, 23"},
      {"512 x 512 in 1,000 bytes",
       file(Dataset::slice()
                .put_number(kRows, 512)
                .put_number(kColumns, 512)
                .put(kPixels, element(kPixels, "OW", std::string(1000, 'x')))),
       kPixelData + "holds 1000 bytes where 512 x 512 pixels"},
      {"endless", file(Dataset::slice().put(kPixels, endless)), kPixelData + "has no length"},
      {"endless, implicit", file(Dataset::slice(kImplicit).put(kPixels, endless_implicit)),
       kPixelData + "has no length"},
      {"in a sequence", with_pixels("", "SQ"), kPixelData + "is not pixel data"},
      {"of text", with_pixels(std::string(24, 'x'), "LT"), kPixelData + "is not pixel data"},
      {"no rows", without(kRows), "Rows (0028,0010) is missing"},
      {"no columns", without(kColumns), "Columns (0028,0011) is missing"},
      {"rows 0", with_number(kRows, 0), "Rows (0028,0010) is 0"},
      {"rows 65535", with_number(kRows, 65535), kPixelData + "holds 24 bytes where 4 x 65535 pixels"},
      {"rows 2", with_number(kRows, 2), kPixelData + "holds 24 bytes where 4 x 2 pixels"},
      {"rows 70000 as a long number", rows_as_long(70000), "Rows (0028,0010) is 70000"},
      {"rows 0xffffffff as a long number", rows_as_long(0xffffffff), "Rows (0028,0010) is 4294967295"},
      {"rows in words", with_text(kRows, "LO", "three"), "Rows (0028,0010) is missing or not a whole number"},
      {"columns 0", with_number(kColumns, 0), "Columns (0028,0011) is 0"},
      {"columns 65535", with_number(kColumns, 65535), kPixelData + "holds 24 bytes where 65535 x 3 pixels"},
      {"0 bits", with_number(kBitsAllocated, 0), "BitsAllocated (0028,0100) is 0"},
      {"1 bit", with_number(kBitsAllocated, 1), "BitsAllocated (0028,0100) is 1"},
      {"12 bits", with_number(kBitsAllocated, 12), "BitsAllocated (0028,0100) is 12"},
      {"52 bits", with_number(kBitsAllocated, 52), "BitsAllocated (0028,0100) is 52"},
      {"64 bits", with_number(kBitsAllocated, 64), "BitsAllocated (0028,0100) is 64"},
      {"65535 bits", with_number(kBitsAllocated, 65535), "BitsAllocated (0028,0100) is 65535"},
      {"17 bits stored", with_number(0x00280101, 17), "BitsStored (0028,0101) is 17"},
      {"no bits stored", with_number(0x00280101, 0), "BitsStored (0028,0101) is 0"},
      {"high bit 16", with_number(0x00280102, 16), "HighBit (0028,0102) is 16"},
      {"high bit 3", with_number(0x00280102, 3), "HighBit (0028,0102) is 3"},
      {"sign 2", with_number(0x00280103, 2), "PixelRepresentation (0028,0103) is 2"},
      {"3 samples", with_number(0x00280002, 3), "SamplesPerPixel (0028,0002) is 3"},
      {"0 samples", with_number(0x00280002, 0), "SamplesPerPixel (0028,0002) is 0"},
      {"RGB", with_text(0x00280004, "CS", "RGB"), "PhotometricInterpretation (0028,0004) is 'RGB'"},
      {"unknown colours", with_text(0x00280004, "CS", "GREY"), "(0028,0004) is 'GREY'"},
      {"2 frames", with_text(kFrames, "IS", "2"), "(CTImageStorage, 2 frames)"},
      {"0 frames", with_text(kFrames, "IS", "0"), "NumberOfFrames (0028,0008) is '0'"},
      {"-1 frames", with_text(kFrames, "IS", "-1"), "NumberOfFrames (0028,0008) is '-1'"},
      {"frames in words", with_text(kFrames, "IS", "many"), "NumberOfFrames (0028,0008) is 'many'"},
      {"2,147,483,647 frames", with_text(kFrames, "IS", "2147483647"), "2147483647 frames"},
      {"more frames than a number holds", with_text(kFrames, "IS", "99999999999999999999"),
       "(0028,0008) is '99999999999999999999'"},
  };
}

std::vector<BadDicom> fragment_rows() {
  const std::string fragment = item(rle(2, {64, 70}, "abcdefghijkl"));
  const auto frame = [&](const std::string& table) {
    return compressed(kRle, fragments(table, fragment + sequence_end()));
  };
  const std::string frames =
      Dataset::slice().put_text(kFrames, "IS", "3").put(kPixels, encapsulated("abcd")).bytes();
  const std::string square = Dataset::slice()
                                 .put_number(kRows, 65535)
                                 .put_number(kColumns, 65535)
                                 .put(kPixels, encapsulated(rle(2, {64, 70}, "abcdefghijkl")))
                                 .bytes();
  return {
      {"nothing at all", compressed(kRle, element(kPixels, "OB", "", kExplicit, kUndefinedLength)),
       kPixelData + "has no sequence delimiter"},
      {"not even a table",
       compressed(kRle, element(kPixels, "OB", sequence_end(), kExplicit, kUndefinedLength)),
       kPixelData + "holds (FFFE,E0DD) where a fragment belongs"},
      {"no fragments", compressed(kRle, fragments("", sequence_end())),
       kPixelData + "holds no compressed frame"},
      {"an empty fragment", compressed(kRle, encapsulated("")), kPixelData + "holds no compressed frame"},
      {"no delimiter", compressed(kRle, fragments("", fragment)), kPixelData + "has no sequence delimiter"},
      {"an item delimiter", compressed(kRle, fragments("", fragment + item_end())),
       kPixelData + "holds (FFFE,E00D)"},
      {"an element among fragments",
       compressed(kRle, fragments("", fragment + text(0x00100010, "PN", "Doe") + sequence_end())),
       kPixelData + "holds (0010,0010)"},
      {"a fragment of odd length", compressed(kRle, encapsulated("abc")),
       kPixelData + "has a fragment of odd length"},
      {"a fragment longer than the file",
       compressed(kRle, fragments("", item("abcd", kExplicit, 0x7ffffffe) + sequence_end())),
       kPixelData + "has a fragment of 2147483646 bytes"},
      {"a fragment without length",
       compressed(kRle, fragments("", item("abcd", kExplicit, kUndefinedLength) + sequence_end())),
       kPixelData + "has a fragment of 4294967295 bytes"},
      {"a table of 6 bytes", frame(std::string(6, '\0')), kPixelData + "has an offset table of 6 bytes"},
      {"a table that begins elsewhere", frame(long_word(8)), "offset table that does not point"},
      {"a table beyond the end", frame(long_word(0x7fffffff)), "offset table that does not point"},
      {"a table with more entries than fragments", frame(long_word(0) + long_word(4)),
       "offset table with more"},
      {"a table that goes back",
       compressed(kRle, fragments(long_word(0) + long_word(0), fragment + fragment + sequence_end())),
       "offset table that does not point"},
      {"a table for two frames, of one",
       compressed(kRle, fragments(long_word(0) + long_word(84), fragment + fragment + sequence_end())),
       "offset table of 2 entries for 1 frames"},
      {"a table longer than the file",
       compressed(kRle, element(kPixels, "OB", item("", kExplicit, 0x7ffffffe), kExplicit, kUndefinedLength)),
       kPixelData + "has a fragment of 2147483646 bytes"},
      {"3 frames, one fragment", file(kRle, frames), "3 frames"},
      {"not compressed at all", compressed(kRle, element(kPixels, "OW", std::string(24, 'x'))),
       kPixelData + "has a length, though the transfer syntax is one of compressed pixels"},
      {"65535 x 65535 in a hundred bytes", file(kRle, square),
       kPixelData + "cannot hold 65535 x 65535 pixels"},
  };
}

std::vector<BadDicom> frame_rows() {
  const auto one = [](const char* syntax, const std::string& frame) {
    return compressed(syntax, encapsulated(frame));
  };
  return {
      {"RLE: less than its header", one(kRle, "abcd"), kPixelData + "cannot be decoded (RLE Lossless)"},
      {"RLE: no segments", one(kRle, rle(0, {}, "abcdefgh")), kPixelData + "cannot be decoded"},
      {"RLE: 4 billion segments", one(kRle, rle(0xffffffff, {64}, "abcdefgh")),
       kPixelData + "cannot be decoded"},
      {"RLE: 3 segments of 2", one(kRle, rle(3, {64, 66, 68}, "abcdefgh")), kPixelData + "cannot be decoded"},
      {"RLE: segments beyond the end", one(kRle, rle(2, {64, 0x7fffffff}, "abcdefgh")),
       kPixelData + "cannot be decoded"},
      {"RLE: segments backwards", one(kRle, rle(2, {70, 64}, "abcdefgh")), kPixelData + "cannot be decoded"},
      {"RLE: segments that end early", one(kRle, rle(2, {64, 66}, "\x02\x41\x02\x41")),
       kPixelData + "cannot be decoded"},
      {"JPEG: no stream", one(kJpeg, std::string(100, 'x')), kPixelData + "holds no JPEG stream"},
      {"JPEG: ends before its frame", one(kJpeg, "\xff\xd8\xff\xe0"), kPixelData + "holds no JPEG stream"},
      {"JPEG: an endless comment",
       one(kJpeg, std::string("\xff\xd8\xff\xfe\xff\xff"
                              "abcd")),
       kPixelData + "holds no JPEG stream"},
      // DCMTK never gets beyond it.
      {"JPEG: a TEM marker", one(kJpeg, std::string("\xff\xd8\xff\x01", 4) + jpeg(4, 3).substr(2)),
       kPixelData + "holds no JPEG stream"},
      {"JPEG: a frame of JPEG-LS", one(kJpeg, jpeg(4, 3, 1, "\xff\xf7")),
       kPixelData + "holds no JPEG stream"},
      {"JPEG: a marker without length",
       one(kJpeg, std::string("\xff\xd8\xff\xe0\0\0", 6) + jpeg(4, 3).substr(2)),
       kPixelData + "holds no JPEG stream"},
      {"JPEG: of another size", one(kJpeg, jpeg(3, 4)),
       kPixelData + "holds a JPEG stream of 3 x 4, not 4 x 3"},
      {"JPEG: 65500 x 65500", one(kJpeg, jpeg(65500, 65500)), "holds a JPEG stream of 65500 x 65500"},
      {"JPEG: in colour", one(kJpeg, jpeg(4, 3, 3)), "holds a JPEG stream of 3 components"},
      {"JPEG: its frame header alone", one(kJpeg, jpeg(4, 3)), kPixelData + "cannot be decoded"},
      {"JPEG-LS: no stream", one(kJpegLs, std::string(100, 'x')), kPixelData + "holds no JPEG stream"},
      {"JPEG-LS: of another size", one(kJpegLs, jpeg(40000, 3, 1, "\xff\xf7")), "JPEG stream of 40000 x 3"},
      {"JPEG-LS: its frame header alone", one(kJpegLs, jpeg(4, 3, 1, "\xff\xf7")),
       kPixelData + "cannot be decoded"},
      {"JPEG 2000: no stream", one(kJpeg2000, std::string(100, 'x')),
       kPixelData + "holds no JPEG 2000 stream"},
      {"JPEG 2000: a file with no stream in it",
       one(kJpeg2000, std::string("\0\0\0\x0cjP  \r\n\x87\n\0\0\0\x14"
                                  "ftypjp2 abcdefgh",
                                  32)),
       kPixelData + "holds no JPEG 2000 stream"},
      {"JPEG 2000: of another size", one(kJpeg2000, jpeg_2000(5, 3, 5)), "JPEG 2000 stream of 5 x 3"},
      {"JPEG 2000: 4 billion pixels wide", one(kJpeg2000, jpeg_2000(0xffffffff, 3, 64)),
       "JPEG 2000 stream of 4294967295 x 3"},
      {"JPEG 2000: no tiles", one(kJpeg2000, jpeg_2000(0, 0, 0)), "JPEG 2000 stream of 0 x 0"},
      {"JPEG 2000: a tile for every pixel",
       file(kJpeg2000, Dataset::slice()
                           .put_number(kRows, 256)
                           .put_number(kColumns, 256)
                           .put(kPixels, encapsulated(jpeg_2000(256, 256, 1)))
                           .bytes()),
       "JPEG 2000 stream of 65536 tiles"},
      {"JPEG 2000: 16384 components", one(kJpeg2000, jpeg_2000(4, 3, 4, 16384)),
       "JPEG 2000 stream of 16384 components"},
      {"JPEG 2000: a stream at every marker of another one", one(kJpeg2000, nested_jpeg_2000()),
       kPixelData + "cannot be decoded"},
      {"JPEG 2000: its SIZ marker alone", one(kJpeg2000, jpeg_2000(4, 3, 4)),
       kPixelData + "cannot be decoded"},
  };
}

}  // namespace

class BadDicomPixelsTest : public QObject {
  Q_OBJECT

 private slots:
  void pixels_that_are_not_those_promised_are_refused_data() { add_rows(native_pixels()); }
  void pixels_that_are_not_those_promised_are_refused() { verify_refused(); }
  void wrong_fragments_are_refused_data() { add_rows(fragment_rows()); }
  void wrong_fragments_are_refused() { verify_refused(); }
  void a_wrong_frame_is_refused_data() { add_rows(frame_rows()); }
  void a_wrong_frame_is_refused() { verify_refused(); }
};

TIDEMARK_TEST(BadDicomPixelsTest)

}  // namespace tidemark::test::bad_dicom_pixels_test

#include "bad_dicom_pixels_test.moc"
