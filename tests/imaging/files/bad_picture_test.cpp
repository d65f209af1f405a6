// Pictures that are not what they say.
#include "bad_volumes.h"
#include "imaging/files/volume_file.h"
#include "pictures.h"
#include "tests/support/test_program.h"
#include "volumes.h"

namespace tidemark::test::bad_picture_test {

namespace {

std::string grey_rows() {
  return std::string("abcdefghijkl", 12);
}

std::string good_png() {
  return Png{}.with(grey_rows());
}

std::string png_of_size(std::uint32_t columns, std::uint32_t rows) {
  return Png{.columns = columns, .rows = rows}.header() + png_chunk("IDAT", std::string(200, 'x')) +
         png_chunk("IEND", "");
}

std::string with_byte(const std::string& bytes, std::size_t at, char value) {
  return bytes.substr(0, at) + value + bytes.substr(at + 1);
}

// Rows and columns of the frame header, which says 8 x 16.
std::string jpeg_of_size(const std::string& size) {
  std::string bytes = Jpeg{}.with(std::vector<std::uint8_t>(128, 90));
  return bytes.replace(bytes.find("\xff\xc0") + 5, 4, size);
}

std::string tiff_of(TiffPage page) {
  if (page.bytes.empty()) page.bytes = std::string(page.columns * page.rows * 8, 'x');
  return tiff({page});
}

// A directory of one little-endian value a field; TIFF 6.0, section 2.
std::string bare_tiff(const std::vector<std::array<std::uint32_t, 2>>& fields, std::uint32_t next) {
  const auto little = [](std::uint32_t value, int count) {
    const std::string bytes = big(value, count);
    return std::string(bytes.rbegin(), bytes.rend());
  };
  std::string bytes =
      "II" + little(42, 2) + little(8, 4) + little(static_cast<std::uint32_t>(fields.size()), 2);
  for (const auto& [tag, value] : fields)
    bytes += little(tag, 2) + little(4, 2) + little(1, 4) + little(value, 4);
  return bytes + little(next, 4) + std::string(64, 'x');
}

std::vector<BadFile> bad_pngs() {
  const std::string good = good_png();
  return {
      {"empty", "p.png", "", "not a PNG file"},
      {"text", "p.png", "This is a letter and no picture.\n", "not a PNG file"},
      {"a JPEG", "p.png", Jpeg{}.with(std::vector<std::uint8_t>(128, 90)), "not a PNG file"},
      {"no columns", "p.png", png_of_size(0, 3), "IHDR"},
      {"100000 x 100000", "p.png", png_of_size(100000, 100000), "IHDR: 100000 x 100000 pixels"},
      {"2^31 - 1 rows", "p.png", png_of_size(1, 0x7fffffff), "IHDR"},
      {"columns beyond 31 bits", "p.png", png_of_size(0xffffffff, 1), "out of range"},
      {"5 bits", "p.png", Png{.bits = 5}.with(grey_rows()), "IHDR"},
      {"a palette that is missing", "p.png", Png{.colour_type = 3}.with(grey_rows()), "PLTE"},
      {"a wrong checksum", "p.png", with_byte(good, 30, '!'), "CRC"},
      {"fewer rows than it says", "p.png", Png{.rows = 4}.header() + good.substr(Png{}.header().size()),
       "image data"},
      {"pixels that do not inflate", "p.png",
       Png{}.header() + png_chunk("IDAT", "abcdefgh") + png_chunk("IEND", ""), "damaged"},
  };
}

std::vector<BadFile> bad_jpegs() {
  return {
      {"empty", "p.jpg", "", "not a JPEG file"},
      {"text", "p.jpeg", "This is a letter and no picture.\n", "not a JPEG file"},
      {"a PNG", "p.jpg", good_png(), "not a JPEG file"},
      {"65500 x 65500", "p.jpg", jpeg_of_size("\xff\xdc\xff\xdc"), "SOF: 65500 x 65500 pixels"},
      {"no rows", "p.jpg", jpeg_of_size(std::string("\0\0\0\x10", 4)), "cannot be read"},
      {"printing inks", "p.jpg", Jpeg{.channels = 4}.with(std::vector<std::uint8_t>(512, 90)),
       "SOF: 4 components"},
      {"the beginning alone", "p.jpg", "\xff\xd8", "truncated"},
      {"tables alone", "p.jpg", "\xff\xd8\xff\xd9", "cannot be read"},
      {"scans without end", "p.jpg", Jpeg{.scans = 40}.with(std::vector<std::uint8_t>(128, 90)),
       "more than 32 scans"},
  };
}

std::vector<BadFile> bad_tiffs() {
  const std::array<std::uint32_t, 2> columns{256, 100000};
  const std::array<std::uint32_t, 2> rows{257, 100000};
  TiffPage other{.columns = 5, .bytes = std::string(15, 'x')};
  return {
      {"empty", "p.tif", "", "not a TIFF file"},
      {"text", "p.tiff", "This is a letter and no picture.\n", "not a TIFF file"},
      {"no directory", "p.tif", std::string("II*\0\xff\0\0\0", 8), "directory"},
      {"100000 x 100000", "p.tif",
       bare_tiff({columns, rows, {258, 8}, {262, 1}, {273, 8}, {277, 1}, {278, 100000}, {279, 64}}, 0),
       "ImageWidth (256), ImageLength (257): 100000 x 100000"},
      {"no columns", "p.tif",
       bare_tiff({{256, 0}, {257, 3}, {258, 8}, {262, 1}, {273, 8}, {278, 3}, {279, 64}}, 0), "p.tif"},
      {"pages of two sizes", "p.tif", tiff({TiffPage{.bytes = grey_rows()}, other}), "page 2 (5 x 3 pixels"},
      {"a preview alone", "p.tif", tiff_of({.subfile = 1}), "NewSubfileType (254)"},
      {"fax", "p.tif", tiff_of({.columns = 16, .bits = 1, .compression = 4}), "Compression (259) is 4"},
      {"printing inks", "p.tif", tiff_of({.samples = 4, .meaning = 5}),
       "PhotometricInterpretation (262) is 5"},
      {"planes", "p.tif", tiff_of({.samples = 3, .meaning = 2, .planes = 2}),
       "PlanarConfiguration (284) is 2"},
      {"64 bits", "p.tif", tiff_of({.bits = 64, .format = 3}), "BitsPerSample (258) is 64"},
      {"4 bits", "p.tif", tiff_of({.bits = 4}), "BitsPerSample (258) is 4"},
      {"strips beyond the file", "p.tif",
       bare_tiff({{256, 4}, {257, 3}, {258, 8}, {262, 1}, {273, 100000}, {277, 1}, {278, 3}, {279, 12}}, 0),
       "strip 0"},
      {"not a number", "p.tif",
       tiff_of({.columns = 1, .rows = 1, .bits = 32, .format = 3, .bytes = std::string("\0\0\xc0\x7f", 4)}),
       "voxel"},
  };
}

}  // namespace

class BadPictureTest : public QObject {
  Q_OBJECT

 private slots:
  void a_bad_png_is_refused_by_name_data() { add_rows(bad_pngs()); }
  void a_bad_png_is_refused_by_name() { verify_volume_refused(); }
  void a_bad_jpeg_is_refused_by_name_data() { add_rows(bad_jpegs()); }
  void a_bad_jpeg_is_refused_by_name() { verify_volume_refused(); }
  void a_bad_tiff_is_refused_by_name_data() { add_rows(bad_tiffs()); }
  void a_bad_tiff_is_refused_by_name() { verify_volume_refused(); }

  void a_picture_cut_anywhere_is_refused() {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> grey(128, 90);
    TiffPage page{.bytes = grey_rows()};
    const std::vector<std::pair<std::string, std::string>> files{
        {"p.png", good_png()},
        {"q.png", Png{.columns = 4, .rows = 3, .interlaced = true}.with(grey_rows())},
        {"p.jpg", Jpeg{}.with(grey)},
        {"q.jpg", Jpeg{.progressive = true}.with(grey)},
        {"p.tif", tiff({page})}};
    for (const auto& [name, whole] : files) {
      put(folder / name, whole);
      QVERIFY2(imaging::read_volume_file(folder / name), name.c_str());
      for (std::size_t length = 0; length < whole.size(); ++length) {
        put(folder / name, whole.substr(0, length));
        const auto volume = imaging::read_volume_file(folder / name);
        QVERIFY2(!volume, qPrintable(QString("%1: %2 bytes").arg(name.c_str()).arg(length)));
        QVERIFY(volume.error().message.starts_with((folder / name).string() + ": "));
        QVERIFY(volume.error().message.find('\n') == std::string::npos);
      }
    }
  }

  void directories_in_a_circle_end() {
    const TemporaryFolder folder;
    put(folder / "p.tif",
        bare_tiff({{256, 4}, {257, 3}, {258, 8}, {262, 1}, {273, 8}, {277, 1}, {278, 3}, {279, 12}}, 8));
    const auto volume = imaging::read_volume_file(folder / "p.tif");
    QCOMPARE(failure(volume), QString());
    QCOMPARE(volume->geometry.size, (Index3{4, 3, 1}));
  }

  void a_folder_is_not_a_picture() {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "p.png");
    const auto volume = imaging::read_volume_file(folder / "p.png");
    QVERIFY(!volume);
    QCOMPARE(volume.error().kind, ErrorKind::input);
  }
};

TIDEMARK_TEST(BadPictureTest)

}  // namespace tidemark::test::bad_picture_test

#include "bad_picture_test.moc"
