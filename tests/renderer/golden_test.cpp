// Pictures of phantoms against those that were looked at and found good. Drivers differ in the last digits,
// and sometimes in more: the one that the golden pictures were made with is held to them closely, another
// processor that plays the GPU less so. The processor's own renderer is held to them like the first.
//
//   TIDEMARK_WRITE_GOLDEN=folder golden_test     writes the pictures there instead of comparing them
#include <QImage>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "tests/renderer/golden_views.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::golden_test {

namespace {

// The driver of the golden pictures (Debian 12).
constexpr const char* kDriver = "Mesa 22.3";

// sRGB to CIELAB (D65), in which distances are as large as the eye finds them.
glm::dvec3 to_lab(glm::dvec3 rgb) {
  for (int c = 0; c < 3; ++c)
    rgb[c] = rgb[c] <= 0.04045 ? rgb[c] / 12.92 : std::pow((rgb[c] + 0.055) / 1.055, 2.4);
  const glm::dvec3 xyz((0.4124 * rgb.r + 0.3576 * rgb.g + 0.1805 * rgb.b) / 0.9505,
                       0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b,
                       (0.0193 * rgb.r + 0.1192 * rgb.g + 0.9505 * rgb.b) / 1.089);
  glm::dvec3 f;
  for (int c = 0; c < 3; ++c) f[c] = xyz[c] > 0.008856 ? std::cbrt(xyz[c]) : 7.787 * xyz[c] + 16.0 / 116.0;
  return {116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z)};
}

// The mean over a pixel and its eight neighbours, as an eye at some distance sees it.
glm::dvec3 seen_at(const renderer::Picture& picture, std::int64_t x, std::int64_t y) {
  glm::dvec3 sum(0.0);
  double found = 0.0;
  for (std::int64_t v = std::max<std::int64_t>(y - 1, 0); v <= std::min(y + 1, picture.height - 1); ++v) {
    for (std::int64_t u = std::max<std::int64_t>(x - 1, 0); u <= std::min(x + 1, picture.width - 1); ++u) {
      sum += glm::dvec3(pixel(picture, u, v)) / 255.0;
      ++found;
    }
  }
  return to_lab(sum / found);
}

struct Difference {
  double mean = 0.0;           // CIELAB units; 2 is what an eye just notices
  double share_visible = 0.0;  // of pixels that differ by more than 5
};

Difference difference(const renderer::Picture& a, const renderer::Picture& b) {
  Difference result;
  const double pixels = static_cast<double>(a.width * a.height);
  for (std::int64_t y = 0; y < a.height; ++y) {
    for (std::int64_t x = 0; x < a.width; ++x) {
      const double d = glm::length(seen_at(a, x, y) - seen_at(b, x, y));
      result.mean += d / pixels;
      result.share_visible += d > 5.0 ? 1.0 / pixels : 0.0;
    }
  }
  return result;
}

// What a driver's pictures may differ from the golden ones.
struct Tolerance {
  double mean;
  double share_visible;

  [[nodiscard]] bool allows(const Difference& found) const {
    return found.mean < mean && found.share_visible < share_visible;
  }
};
constexpr Tolerance kSameDriver{0.3, 0.005};
// Rays end in other last digits there: a few cross the surface a step earlier, or miss a thin edge.
constexpr Tolerance kOtherDriver{0.6, 0.02};
// While something moves the processor's own renderer lights the source by other differences than OpenGL does.
constexpr Tolerance kOtherGradient{0.9, 0.03};

renderer::Picture read_png(const std::filesystem::path& file) {
  const QImage image = QImage(QString::fromStdString(file.string())).convertToFormat(QImage::Format_RGBA8888);
  renderer::Picture picture{image.width(), image.height(), {}};
  for (int y = 0; y < image.height(); ++y) {
    picture.pixels.insert(picture.pixels.end(), image.constScanLine(y),
                          image.constScanLine(y) + 4 * image.width());
  }
  return picture;
}

renderer::Picture read_golden(const std::string& name) {
  return read_png(std::filesystem::path(TIDEMARK_GOLDEN_PICTURES) / (name + ".png"));
}

void write_png(const renderer::Picture& picture, const std::filesystem::path& file) {
  const QImage image(picture.pixels.data(), static_cast<int>(picture.width), static_cast<int>(picture.height),
                     QImage::Format_RGBA8888);
  if (!image.convertToFormat(QImage::Format_RGB888).save(QString::fromStdString(file.string()))) {
    qFatal("cannot write %s", file.c_str());
  }
}

}  // namespace

class GoldenTest : public QObject {
  Q_OBJECT

 private slots:
  void pictures_are_as_they_were_found_good_data() {
    QTest::addColumn<QString>("name");
    for (const auto& [name, golden] : golden_views())
      QTest::newRow(name.c_str()) << QString::fromStdString(name);
  }
  void pictures_are_as_they_were_found_good() {
    QFETCH(QString, name);
    const Golden& golden = golden_views().at(name.toStdString());
    auto& patient = patients_[golden.patient];
    if (!patient) patient.emplace(golden.patient, renderer_under_test());
    const auto picture = golden.draw(*patient);
    QCOMPARE(failure(picture), QString());
    // Something is to be seen, whatever the driver.
    const glm::ivec3 corner = pixel(*picture, 0, 0);
    QVERIFY(count(*picture, [&](glm::ivec3 c) { return glm::length(glm::dvec3(c - corner)) > 20.0; }) > 100);

    const std::string file = name.toStdString() + ".png";
    if (const QByteArray folder = qgetenv("TIDEMARK_WRITE_GOLDEN"); !folder.isEmpty()) {
      write_png(*picture, std::filesystem::path(folder.toStdString()) / file);
      return;
    }
    const gpu::Capabilities driver =
        patient->painter->is_gl() ? patient->painter->device().capabilities() : gpu::Capabilities();
    if (patient->painter->is_gl() && !driver.software) {
      QSKIP(qPrintable(QString("the golden pictures are those of %1 on a processor, not of %2")
                           .arg(kDriver, driver.renderer.c_str())));
    }
    // The processor's own renderer draws by rays what OpenGL draws by slices.
    const bool same = patient->painter->is_gl() ? driver.version.find(kDriver) != std::string::npos &&
                                                      driver.renderer.find("llvmpipe") != std::string::npos
                                                : !name.endsWith("-by-slices");
    const renderer::Picture expected = read_golden(name.toStdString());
    QVERIFY2(expected.width > 0, "there is no golden picture of that name");
    QCOMPARE(picture->width, expected.width);
    QCOMPARE(picture->height, expected.height);
    const Difference found = difference(*picture, expected);
    const QString text = QString("mean difference %1, %2 % of the pixels visibly different")
                             .arg(found.mean)
                             .arg(100.0 * found.share_visible);
    if (!same) qInfo("%s, on %s", qPrintable(text), driver.renderer.c_str());
    const bool other_gradient = !patient->painter->is_gl() && name == "moving";
    QVERIFY2((other_gradient ? kOtherGradient
              : same         ? kSameDriver
                             : kOtherDriver)
                 .allows(found),
             qPrintable(text));
  }

  // What a user would call another picture is none that another driver makes.
  void the_wider_tolerance_tells_pictures_apart_data() {
    QTest::addColumn<QString>("other");
    for (const auto& [one, other] : {std::pair{"surface", "surface-lit-from-above"},
                                     {"surface", "surface-occlusion"},
                                     {"surface", "surface-translucent"},
                                     {"clip-both", "clip-source"},
                                     {"region-inside", "region-tinted"},
                                     {"teaching-data", "teaching-total"},
                                     {"slice-axial", "slice-labels"},
                                     {"speed-total", "speed-data"}}) {
      QTest::newRow(one) << QString(other);
    }
  }
  void the_wider_tolerance_tells_pictures_apart() {
    QFETCH(QString, other);
    const Difference found =
        difference(read_golden(QTest::currentDataTag()), read_golden(other.toStdString()));
    qInfo("%.2f, %.1f %%", found.mean, 100.0 * found.share_visible);
    QVERIFY(!kOtherDriver.allows(found));
  }

 private:
  std::map<std::string, std::optional<Patient>> patients_;
};

TIDEMARK_TEST(GoldenTest)

}  // namespace tidemark::test::golden_test

#include "golden_test.moc"
