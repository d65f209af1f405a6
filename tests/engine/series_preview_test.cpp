// Small pictures of series: upright, in proportion, from one slice alone.
#include "engine/series_preview.h"

#include <QSignalSpy>

#include "engine/background_job.h"
#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::series_preview_test {

namespace fs = std::filesystem;

namespace {

// One bright block towards the patient's left, front and head, in a grid whose axes run along the given
// directions.
Volume block(const glm::dmat3& direction) {
  Volume volume;
  Geometry& grid = volume.geometry;
  grid.direction = direction;
  grid.size = {40, 40, 40};
  grid.origin_mm = -(direction * glm::dvec3(19.5));
  std::vector<std::int16_t> voxels(static_cast<std::size_t>(grid.voxel_count()));
  for (std::int64_t offset = 0; offset < grid.voxel_count(); ++offset) {
    const Index3 v(offset % 40, offset / 40 % 40, offset / 1600);
    const glm::dvec3 p = grid.to_patient(glm::dvec3(v));
    const bool inside = p.x > 4.0 && p.y < -8.0 && p.z > 10.0;
    voxels[static_cast<std::size_t>(offset)] = inside ? 1000 : 0;
  }
  volume.voxels = std::move(voxels);
  volume.window = WindowLevel{500.0, 1000.0};
  return volume;
}

// Where the picture is bright: the mean place, from -1 (left, top) to 1.
QPointF bright_place(const QImage& picture) {
  QPointF sum;
  double weight = 0.0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const double grey = qGray(picture.pixel(x, y));
      sum += grey * QPointF(2.0 * x / picture.width() - 1.0, 2.0 * y / picture.height() - 1.0);
      weight += grey;
    }
  }
  return sum / weight;
}

}  // namespace

class SeriesPreviewTest : public QObject {
  Q_OBJECT

 private slots:
  // k runs along the normal; the block is cut when the middle slice goes through it, which it does along none
  // of the axes, so that each row moves it to the middle of its own.
  void the_patients_left_is_on_the_right_and_the_front_or_head_is_up_data() {
    QTest::addColumn<int>("normal");  // the patient's axis
    QTest::addColumn<bool>("exchanged");
    QTest::addColumn<bool>("backwards");
    for (int normal = 0; normal < 3; ++normal) {
      for (const bool exchanged : {false, true}) {
        for (const bool backwards : {false, true}) {
          QTest::addRow("normal %d%s%s", normal, exchanged ? ", axes exchanged" : "",
                        backwards ? ", backwards" : "")
              << normal << exchanged << backwards;
        }
      }
    }
  }
  void the_patients_left_is_on_the_right_and_the_front_or_head_is_up() {
    QFETCH(int, normal);
    QFETCH(bool, exchanged);
    QFETCH(bool, backwards);
    int i = normal == 0 ? 1 : 0;
    int j = normal == 2 ? 1 : 2;
    if (exchanged) std::swap(i, j);
    glm::dmat3 direction(0.0);
    direction[0][i] = backwards ? -1.0 : 1.0;
    direction[1][j] = backwards ? -1.0 : 1.0;
    direction[2][normal] = 1.0;
    Volume volume = block(direction);
    // The middle slice shows what any slice through the block shows.
    auto& voxels = std::get<std::vector<std::int16_t>>(volume.voxels);
    const std::int64_t through = normal == 1 ? 3 : 36;
    std::copy_n(voxels.begin() + through * 1600, 1600, voxels.begin() + 20 * 1600);

    const test::TemporaryFolder folder;
    QCOMPARE(test::failure(imaging::write_volume_file(volume, folder / "block.nrrd")), QString());
    const auto catalogue = imaging::find_series(folder / "block.nrrd");
    QCOMPARE(test::failure(catalogue), QString());
    const QImage picture = engine::middle_slice_picture(catalogue->series.front(), 40);
    QCOMPARE(picture.size(), QSize(40, 40));
    const QPointF place = bright_place(picture);
    const bool right = normal != 0;  // sagittal: the back is on the right, so that the block is left
    QVERIFY2(right ? place.x() > 0.3 : place.x() < -0.3, qPrintable(QString::number(place.x())));
    QVERIFY2(place.y() < -0.3, qPrintable(QString::number(place.y())));
  }

  void pictures_come_in_order_and_in_proportion_from_one_file_each() {
    Volume volume = block(glm::dmat3(1.0));
    volume.geometry.spacing_mm = {1.0, 0.5, 2.0};
    const test::TemporaryFolder folder;
    QCOMPARE(test::failure(imaging::write_dicom_series(volume, {}, folder / "series")), QString());
    const auto catalogue = imaging::find_series(folder / "series");
    QCOMPARE(test::failure(catalogue), QString());
    const imaging::Series& series = catalogue->series.front();
    const auto middle = static_cast<std::size_t>(series.geometry.size.z / 2);
    for (std::size_t k = 0; k < series.files.size(); ++k) {
      if (k != middle) fs::remove(series.files[k]);
    }
    engine::SeriesPreviews previews;
    QSignalSpy made(&previews, &engine::SeriesPreviews::made);
    previews.request(7, series, 96);
    previews.request(3, imaging::Series{}, 96);
    previews.request(5, series, 48);
    QTRY_COMPARE_WITH_TIMEOUT(made.size(), 3, 60'000);
    QCOMPARE(made[0][0].toInt(), 7);
    QCOMPARE(made[1][0].toInt(), 3);
    QCOMPARE(made[2][0].toInt(), 5);
    QCOMPARE(made[0][1].value<QImage>().size(), QSize(96, 48));
    QVERIFY(made[1][1].value<QImage>().isNull());  // nothing to load
    QCOMPARE(made[2][1].value<QImage>().size(), QSize(48, 24));
  }

  void what_is_forgotten_is_not_made_and_the_next_is() {
    imaging::Series nothing;
    engine::SeriesPreviews previews;
    QSignalSpy made(&previews, &engine::SeriesPreviews::made);
    for (int key = 0; key < 100; ++key) previews.request(key, nothing, 16);
    previews.forget();
    previews.request(1000, nothing, 16);
    QTRY_COMPARE_WITH_TIMEOUT(made.size(), 1, 60'000);
    QCOMPARE(made[0][0].toInt(), 1000);
    QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60)));
    QCoreApplication::processEvents();
    QCOMPARE(made.size(), 1);
  }
};

TIDEMARK_TEST(SeriesPreviewTest)

}  // namespace tidemark::test::series_preview_test

#include "series_preview_test.moc"
