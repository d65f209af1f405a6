// Key images and their presentation state, as other programs read them.
#include <QJsonArray>
#include <QProcess>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "imaging/results/key_images.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/results/sample_results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::key_images_test {

namespace {

const WindowLevel kWindow{1000.0, 4000.0};
constexpr double kRadius = 8.0;  // mm

QString text(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

QString output(const QString& program, const QStringList& arguments) {
  QProcess process;
  process.setProcessChannelMode(QProcess::MergedChannels);
  process.start(program, arguments);
  if (!process.waitForFinished()) return program + " does not run";
  return QString::fromUtf8(process.readAll());
}

}  // namespace

class KeyImagesTest : public QObject {
  Q_OBJECT

 private slots:
  void slices_are_those_with_most_voxels();
  void validators_find_no_error_data() { add_orientation_rows(); }
  void validators_find_no_error();
  void pydicom_finds_the_outline_where_the_segment_ends_data() { add_orientation_rows(); }
  void pydicom_finds_the_outline_where_the_segment_ends();
  void an_outline_ends_with_the_image_data() { add_orientation_rows(); }
  void an_outline_ends_with_the_image();
  void what_no_state_can_show_is_refused();

 private:
  // A segment (a ball, where there is none) in a series of that orientation, its key image and state.
  void write(int index, const std::optional<imaging::Segment>& segment = {});

  TemporaryFolder folder_;
  std::filesystem::path selection_, state_;
  SampleSeries series_;
  imaging::Segments segments_;
};

void KeyImagesTest::write(int index, const std::optional<imaging::Segment>& segment) {
  const std::string name = std::to_string(index);
  series_ = write_oriented_series(index, {40, 32, 9}, folder_ / ("series" + name));
  segments_ = {series_.geometry, {segment ? *segment : ball_segment(series_.geometry, kRadius)}, {}};
  segments_.list.front().name = "Leber \xc3\xbc";
  selection_ = folder_ / ("key" + name + ".dcm");
  state_ = folder_ / ("state" + name + ".dcm");
  QCOMPARE(failure(imaging::write_key_images(segments_, series_.files, kWindow,
                                             "Gr\xc3\xb6\xc3\x9fter Schnitt", {selection_, state_})),
           QString());
}

void KeyImagesTest::slices_are_those_with_most_voxels() {
  imaging::Segments segments;
  segments.geometry.size = {2, 2, 9};
  imaging::Segment one;
  one.slices = {{1, {1, 0, 0, 0}}, {4, {1, 1, 1, 0}}, {6, {1, 1, 0, 0}}};
  imaging::Segment other;
  other.slices = {{3, {1, 0, 0, 0}}, {4, {0, 0, 0, 0}}};
  imaging::Segment empty;
  empty.slices = {{8, {0, 0, 0, 0}}};
  segments.list = {one, other, one, empty};
  QCOMPARE(imaging::key_slices(segments, [](std::int64_t) { return true; }),
           (std::vector<std::int64_t>{3, 4}));
  QCOMPARE(imaging::key_slices(segments, [](std::int64_t k) { return k != 4; }),
           (std::vector<std::int64_t>{3, 6}));
}

void KeyImagesTest::validators_find_no_error() {
  QFETCH(int, index);
  write(index);
  for (const auto& file : {selection_, state_}) {
    const QString found = validate(file);
    QVERIFY2(!found.contains("Error"), qPrintable(text(file) + ": " + found));
  }
  const QString tree = output("dsrdump", {text(selection_)});
  QVERIFY2(tree.contains("Key Object Selection Document"), qPrintable(tree));
  QVERIFY2(tree.contains("Gr\xc3\xb6\xc3\x9fter Schnitt"), qPrintable(tree));
  QCOMPARE(tree.count("<contains IMAGE:"), 1);
}

// By places in the patient, whichever way the images lie.
void KeyImagesTest::pydicom_finds_the_outline_where_the_segment_ends() {
  QFETCH(int, index);
  write(index);
  const QJsonObject named = read_with_pydicom(selection_, series_.folder);
  const QJsonObject shown = read_with_pydicom(state_, series_.folder);
  for (const QJsonObject& found : {named, shown}) {
    for (const char* what : {"same_patient", "same_study", "own_series"})
      QVERIFY2(found[what].toBool(), what);
  }
  QCOMPARE(named["title"].toString(), QString("Of Interest"));
  QCOMPARE(named["note"].toString(), QString("Gr\xc3\xb6\xc3\x9fter Schnitt"));
  QVERIFY(named["known"].toBool());
  QCOMPARE(named["images"].toInt(), 1);
  QCOMPARE(named["states"].toArray(), QJsonArray{shown["instance"]});
  QCOMPARE(shown["window"].toArray(), (QJsonArray{kWindow.centre, kWindow.width}));
  QCOMPARE(shown["area"].toArray(), (QJsonArray{1, 1, 40, 32}));
  QVERIFY(shown["same_rescaling"].toBool());
  QCOMPARE(shown["layers"].toInt(), 1);
  QCOMPARE(shown["names"].toArray(), QJsonArray{"Leber \xc3\xbc"});
  QCOMPARE(shown["outlines"].toArray().size(), qsizetype{1});
  const Geometry& grid = series_.geometry;
  const glm::dvec3 middle = grid.to_patient(0.5 * glm::dvec3(grid.size - Index3(1)));
  const QJsonArray points = shown["outlines"].toArray().first().toArray();
  QVERIFY(points.size() > 20);
  QCOMPARE(points.first(), points.last());
  for (const auto& point : points) {
    const QJsonArray mm = point.toArray();
    const double radius = glm::distance(middle, {mm[0].toDouble(), mm[1].toDouble(), mm[2].toDouble()});
    QVERIFY2(std::abs(radius - kRadius) < 0.05, qPrintable(QString::number(radius)));
  }
}

// The corner of the first pixel is 0\0, and nothing lies beyond the image (PS3.3 Table C.10-5).
void KeyImagesTest::an_outline_ends_with_the_image() {
  QFETCH(int, index);
  imaging::Segment all;
  all.slices[4] = std::vector<std::uint8_t>(std::size_t{40} * 32, 1);
  write(index, all);
  const QJsonObject shown = read_with_pydicom(state_, series_.folder);
  for (const auto& [along, size] : {std::pair("columns", 40.0), std::pair("rows", 32.0)}) {
    const double low = shown[along].toArray()[0].toDouble(-1.0);
    const double high = shown[along].toArray()[1].toDouble(-1.0);
    const QString found = QStringLiteral("%1: %2 to %3").arg(QLatin1String(along)).arg(low).arg(high);
    QVERIFY2(low >= 0.0 && high <= size, qPrintable(found));
    QVERIFY2(low < 1e-3 && high > size - 1e-3, qPrintable(found));
  }
}

void KeyImagesTest::what_no_state_can_show_is_refused() {
  write(0);
  const std::filesystem::path file = folder_ / "refused.dcm";
  const auto none = imaging::write_key_images(segments_, {}, kWindow, "note", {file, {}});
  QVERIFY(!none && none.error().kind == ErrorKind::input);
  imaging::Segments empty = segments_;
  empty.list.front().slices.clear();
  QVERIFY(!imaging::write_key_images(empty, series_.files, kWindow, "note", {file, {}}));
  // Two key images that are rescaled in different ways: named, but not shown by one state.
  imaging::Segments two = segments_;
  two.list.push_back(two.list.front());
  two.list.back().slices = {{0, two.list.front().slices.begin()->second}};
  set_text(series_.files[0], 0x0028, 0x1053, "2");
  const auto refused =
      imaging::write_key_images(two, series_.files, kWindow, "note", {file, folder_ / "state.dcm"});
  QVERIFY(!refused && refused.error().message.find("one presentation state") != std::string::npos);
  QVERIFY(!std::filesystem::exists(file));
  QCOMPARE(failure(imaging::write_key_images(two, series_.files, kWindow, "note", {file, {}})), QString());
  QCOMPARE(output("dsrdump", {text(file)}).count("<contains IMAGE:"), 2);
}

TIDEMARK_TEST(KeyImagesTest)

}  // namespace tidemark::test::key_images_test

#include "key_images_test.moc"
