// Pictures as volumes: what is kept, what is made of it, and what is said.
#include <algorithm>
#include <cstring>
#include <fstream>
#include <numeric>

#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "pictures.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"
#include "volumes.h"

namespace tidemark::test::picture_test {

namespace {

bool says(const Volume& volume, const char* text) {
  return std::any_of(volume.changes.begin(), volume.changes.end(),
                     [&](const std::string& change) { return change.find(text) != std::string::npos; });
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// 0, 1, 2, ... as bytes.
std::string counting(std::size_t count) {
  std::string bytes(count, '\0');
  std::iota(bytes.begin(), bytes.end(), '\0');
  return bytes;
}

// A TIFF page of 20 x 18 values of a type, row by row.
template <class T>
TiffPage page_of(int format, int compression, int tile, T first, T step) {
  TiffPage page{.columns = 20, .rows = 18};
  page.bits = 8 * static_cast<int>(sizeof(T));
  page.format = format;
  page.compression = compression;
  page.tile = tile;
  std::vector<T> values(20 * 18);
  for (std::size_t n = 0; n < values.size(); ++n)
    values[n] = static_cast<T>(first + static_cast<T>(n) * step);
  page.bytes = bytes_of(values);
  return page;
}

}  // namespace

class PictureTest : public QObject {
  Q_OBJECT

  TemporaryFolder folder_;

  Volume read(const std::string& name, const std::string& bytes) {
    put(folder_ / name, bytes);
    auto volume = imaging::load_volume(folder_ / name);
    if (!volume) qFatal("%s", volume.error().message.c_str());
    const auto series = imaging::scan_volume_file(folder_ / name);
    // What is said before the voxels are read is what they turn out to be.
    if (!series || !series->loadable || !(series->geometry == volume->geometry) ||
        series->scalar != volume->scalar_name()) {
      qFatal("%s is listed as something else", name.c_str());
    }
    return std::move(*volume);
  }

 private slots:
  void greys_of_8_bits_are_kept_exactly() {
    const Volume volume = read("grey.png", Png{}.with(counting(12)));
    QCOMPARE(volume.geometry.size, (Index3{4, 3, 1}));
    QCOMPARE(volume.scalar_name(), "int16");
    for (std::int64_t v = 0; v < 12; ++v) QCOMPARE(volume.value(v), static_cast<float>(v));
    QVERIFY(says(volume, "volume of one slice"));
    QVERIFY(says(volume, "how its axes lie"));
  }

  void a_picture_gets_no_sides_by_being_written_as_a_volume() {
    const Volume volume = read("photo.png", Png{}.with(counting(12)));
    for (const char* name : {"photo.nii.gz", "photo.nrrd"}) {
      QCOMPARE(failure(imaging::write_volume_file(volume, folder_ / name)), QString());
      const auto series = imaging::scan_volume_file(folder_ / name);
      QCOMPARE(failure(series), QString());
      QVERIFY2(series->loadable && !series->geometry.oriented, name);
      QVERIFY(series->geometry == volume.geometry);
    }
  }

  void greys_of_16_bits_are_kept_exactly() {
    std::string rows;
    for (std::uint32_t v = 0; v < 12; ++v) rows += big(65535 - 257 * v, 2);
    const Volume volume = read("deep.png", Png{.bits = 16}.with(rows));
    QCOMPARE(volume.scalar_name(), "uint16");
    for (std::uint32_t v = 0; v < 12; ++v) QCOMPARE(volume.value(v), static_cast<float>(65535 - 257 * v));
  }

  void greys_of_few_bits_keep_their_values() {
    const Volume volume = read("bits.png", Png{.columns = 4, .rows = 2, .bits = 2}.with("\x1b\xe4"));
    const std::array expected{0, 1, 2, 3, 3, 2, 1, 0};
    for (std::size_t v = 0; v < 8; ++v) {
      QCOMPARE(volume.value(static_cast<std::int64_t>(v)), static_cast<float>(expected[v]));
    }
  }

  void an_interlaced_picture_is_the_same() {
    const Png png{.columns = 11, .rows = 9, .interlaced = true};
    const Volume volume = read("passes.png", png.with(counting(99)));
    for (std::int64_t v = 0; v < 99; ++v) QCOMPARE(volume.value(v), static_cast<float>(v));
  }

  void colours_become_their_luminance() {
    const std::string pixels(
        "\xff\0\0"
        "\0\xff\0"
        "\0\0\xff"
        "\x4d\x4d\x4d",
        12);
    const Volume volume = read("colours.png", Png{.columns = 4, .rows = 1, .colour_type = 2}.with(pixels));
    const std::array expected{54.0F, 182.0F, 18.0F, 77.0F};  // Rec. 709, rounded
    for (std::size_t v = 0; v < 4; ++v) QCOMPARE(volume.value(static_cast<std::int64_t>(v)), expected[v]);
    QVERIFY(says(volume, "Rec. 709"));
  }

  void a_palette_is_resolved() {
    const std::string palette(
        "\x0a\x0a\x0a"
        "\xc8\xc8\xc8"
        "\xff\0\0",
        9);
    const Png png{.columns = 4, .rows = 1, .bits = 2, .colour_type = 3, .before = png_chunk("PLTE", palette)};
    const Volume volume = read("palette.png", png.with("\x18"));  // 0, 1, 2, 0
    QCOMPARE(volume.value(0), 10.0F);
    QCOMPARE(volume.value(1), 200.0F);
    QCOMPARE(volume.value(2), 54.0F);
    QVERIFY(!says(volume, "opacity"));
  }

  void opacity_is_ignored_and_said() {
    const std::string pixels("\x32\0\x64\xff\x32\x80", 6);
    const Volume grey = read("clear.png", Png{.columns = 3, .rows = 1, .colour_type = 4}.with(pixels));
    QCOMPARE(grey.value(0), 50.0F);
    QCOMPARE(grey.value(1), 100.0F);
    QVERIFY(says(grey, "opacity is ignored"));
    const Png indexed{
        .columns = 2,
        .rows = 1,
        .colour_type = 3,
        .before = png_chunk("PLTE", "\x0a\x0a\x0a\x14\x14\x14") + png_chunk("tRNS", std::string(1, '\0'))};
    const Volume palette = read("clear-palette.png", indexed.with(std::string("\0\1", 2)));
    QCOMPARE(palette.value(0), 10.0F);
    QCOMPARE(palette.value(1), 20.0F);
    QVERIFY(says(palette, "opacity is ignored"));
  }

  void a_resolution_gives_the_spacing_unless_it_is_a_screens() {
    const auto with_density = [](std::uint32_t across, std::uint32_t down) {
      return Png{.before = png_chunk("pHYs", big(across) + big(down) + "\1")}.with(counting(12));
    };
    const Volume scanned = read("scanned.png", with_density(10000, 20000));
    QVERIFY(glm::distance(scanned.geometry.spacing_mm, glm::dvec3(0.1, 0.05, 1.0)) < 1e-9);
    QVERIFY(says(scanned, "0.1 x 0.05 mm"));
    const Volume screen = read("screen.png", with_density(3780, 3780));
    QCOMPARE(screen.geometry.spacing_mm, glm::dvec3(1.0));
    QVERIFY(says(screen, "96 dots per inch"));
    const Volume none = read("none.png", Png{}.with(counting(12)));
    QCOMPARE(none.geometry.spacing_mm, glm::dvec3(1.0));
    QVERIFY(says(none, "a pixel counts as 1 mm"));
    const Volume jpeg = read("film.jpg", Jpeg{.dpi = 254}.with(std::vector<std::uint8_t>(128, 90)));
    QVERIFY(glm::distance(jpeg.geometry.spacing_mm, glm::dvec3(0.1, 0.1, 1.0)) < 1e-9);
    TiffPage page{.bytes = counting(12)};
    page.dpi = 508.0;
    const Volume tif = read("film.tif", tiff({page}));
    QVERIFY(glm::distance(tif.geometry.spacing_mm, glm::dvec3(0.05, 0.05, 1.0)) < 1e-6);
  }

  void a_jpeg_is_read_to_its_own_precision() {
    std::vector<std::uint8_t> grey(16 * 8);
    for (std::size_t n = 0; n < grey.size(); ++n) grey[n] = static_cast<std::uint8_t>(40 + n % 16 * 8);
    for (const bool progressive : {false, true}) {
      const Volume volume = read("ramp.jpeg", Jpeg{.progressive = progressive}.with(grey));
      QCOMPARE(volume.geometry.size, (Index3{16, 8, 1}));
      for (std::size_t n = 0; n < grey.size(); ++n) {
        const float read_value = volume.value(static_cast<std::int64_t>(n));
        QVERIFY(std::abs(read_value - static_cast<float>(grey[n])) <= 3.0F);  // quality 95
      }
      QVERIFY(says(volume, "compressed with loss"));
    }
    std::vector<std::uint8_t> red;
    for (int n = 0; n < 128; ++n) red.insert(red.end(), {200, 100, 50});
    const Volume colours = read("red.jpg", Jpeg{.channels = 3}.with(red));
    QVERIFY(std::abs(colours.value(5) - 118.0F) <= 2.0F);
    QVERIFY(says(colours, "Rec. 709"));
  }

  // The picture's first row and column lie where the camera says: a bright corner moves with them.
  void a_cameras_orientation_is_applied() {
    const std::array<glm::vec<2, std::int64_t>, 8> places{
        {{0, 0}, {15, 0}, {15, 7}, {0, 7}, {0, 0}, {7, 0}, {7, 15}, {0, 15}}};
    std::vector<std::uint8_t> corner(16 * 8, 30);
    for (const std::size_t n : {0, 1, 16, 17}) corner[n] = 230;
    for (int orientation = 1; orientation <= 8; ++orientation) {
      for (const bool big_endian : {false, true}) {
        const Jpeg jpeg{.app1 = exif_orientation_marker(orientation, big_endian)};
        const Volume volume = read("phone.jpg", jpeg.with(corner));
        QCOMPARE(volume.geometry.size, (orientation < 5 ? Index3{16, 8, 1} : Index3{8, 16, 1}));
        const auto at = places[static_cast<std::size_t>(orientation - 1)];
        QVERIFY(volume.value(Index3{at.x, at.y, 0}) > 180.0F);
        const auto size = volume.geometry.size;
        QVERIFY(volume.value(Index3{size.x - 1 - at.x, size.y - 1 - at.y, 0}) < 80.0F);
        QCOMPARE(says(volume, "turned upright"), orientation != 1);
      }
    }
    TiffPage page{.bytes = counting(12)};
    page.orientation = 6;
    const Volume turned = read("turned.tif", tiff({page}));
    QCOMPARE(turned.geometry.size, (Index3{3, 4, 1}));
    QCOMPARE(turned.value(Index3{2, 0, 0}), 0.0F);
    QCOMPARE(turned.value(Index3{2, 3, 0}), 3.0F);
    QCOMPARE(turned.value(Index3{0, 0, 0}), 8.0F);
  }

  void tiff_values_of_every_type_are_kept_in_every_form() {
    for (const int compression : {1, 5, 8, 32773}) {
      for (const int tile : {0, 16}) {
        const auto check = [&](const TiffPage& page, const char* scalar, double first, double step) {
          const Volume volume = read("type.tif", tiff({page}));
          QCOMPARE(volume.scalar_name(), scalar);
          QCOMPARE(volume.geometry.size, (Index3{20, 18, 1}));
          for (std::int64_t v = 0; v < 360; ++v) {
            QCOMPARE(volume.value(v), static_cast<float>(first + step * static_cast<double>(v)));
          }
        };
        check(page_of<std::uint16_t>(1, compression, tile, 60000, 15), "uint16", 60000, 15);
        check(page_of<std::int16_t>(2, compression, tile, -3000, 17), "int16", -3000, 17);
        check(page_of<std::int32_t>(2, compression, tile, -70000, 400), "float", -70000, 400);
        check(page_of<float>(3, compression, tile, -1.5F, 0.25F), "float", -1.5, 0.25);
      }
    }
    TiffPage bits{.columns = 10, .rows = 2, .bits = 1, .bytes = std::string("\xa5\x40\x5a\x80", 4)};
    const Volume mask = read("bits.tif", tiff({bits}));
    const std::string expected = "10100101010101101010";
    for (std::size_t v = 0; v < expected.size(); ++v) {
      QCOMPARE(mask.value(static_cast<std::int64_t>(v)), expected[v] == '1' ? 1.0F : 0.0F);
    }
    TiffPage palette{.meaning = 3, .bytes = counting(12)};
    const Volume resolved = read("palette.tif", tiff({palette}));
    for (std::int64_t v = 0; v < 12; ++v) QCOMPARE(resolved.value(v), static_cast<float>(65535 - v));
    TiffPage colours{
        .columns = 2, .rows = 1, .samples = 3, .meaning = 2, .bytes = "\x4d\x4d\x4d\xff\xff\xff"};
    QCOMPARE(read("rgb.tif", tiff({colours})).value(0), 77.0F);
  }

  void pages_are_slices() {
    std::vector<TiffPage> pages;
    for (std::int16_t n = 0; n < 3; ++n)
      pages.push_back(page_of<std::int16_t>(2, 5, 0, static_cast<std::int16_t>(1000 * n), 1));
    TiffPage preview = page_of<std::int16_t>(2, 1, 0, 0, 1);
    preview.columns = 10;
    preview.bytes.resize(360);
    preview.subfile = 1;
    pages.insert(pages.begin() + 1, preview);
    const Volume volume = read("pages.tiff", tiff(pages));
    QCOMPARE(volume.geometry.size, (Index3{20, 18, 3}));
    for (std::int64_t k = 0; k < 3; ++k) {
      QCOMPARE(volume.value(Index3{3, 2, k}), static_cast<float>(1000 * k + 43));
    }
    QVERIFY(says(volume, "3 pages are slices"));
    QVERIFY(says(volume, "previews or masks"));
  }

  void a_picture_is_a_mask_too() {
    put(folder_ / "mask.png", Png{.bits = 1, .before = {}}.with(std::string("\x60\x60\0", 3)));
    const auto mask = imaging::load_mask(folder_ / "mask.png");
    QCOMPARE(failure(mask), QString());
    QCOMPARE(mask->geometry.size, (Index3{4, 3, 1}));
    QCOMPARE(mask->count(), std::int64_t{4});
  }

  // They are photographs and previews of it.
  void pictures_beside_a_study_are_left_out() {
    const TemporaryFolder folder;
    put(folder / "a.png", Png{}.with(counting(12)));
    put(folder / "b.jpg", Jpeg{}.with(std::vector<std::uint8_t>(128, 90)));
    const auto pictures = imaging::find_series(folder.path());
    QCOMPARE(failure(pictures), QString());
    QCOMPARE(pictures->series.size(), std::size_t{2});
    write_series(sample_volume({7, 5, 4}), folder / "series");
    const auto study = imaging::find_series(folder.path());
    QCOMPARE(failure(study), QString());
    QCOMPARE(study->series.size(), std::size_t{1});
    QCOMPARE(study->skipped.size(), std::size_t{2});
    QVERIFY(study->skipped[0].reason.find("picture beside a study") != std::string::npos);
    QVERIFY(imaging::load_volume(folder / "a.png"));
  }

  void reading_is_cancelled() {
    put(folder_ / "long.png", Png{}.with(counting(12)));
    std::stop_source stop;
    stop.request_stop();
    const auto volume = imaging::read_volume_file(folder_ / "long.png", {nullptr, stop.get_token()});
    QVERIFY(!volume);
    QCOMPARE(volume.error().kind, ErrorKind::cancelled);
  }
};

TIDEMARK_TEST(PictureTest)

}  // namespace tidemark::test::picture_test

#include "picture_test.moc"
