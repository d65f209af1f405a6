// Further images over a slice: sampled in the background, the newest place last.
#include "ui/views/image_overlay.h"

#include <QSignalSpy>
#include <QTest>

#include "tests/support/test_program.h"

namespace tidemark::test::image_overlay_test {

namespace {

constexpr QSize kView(60, 50);

// Every slice along z has a value of its own: 10 times its number.
engine::ShownImage layers(Index3 size = {40, 40, 30}) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = size;
  std::vector<float> values;
  for (std::int64_t i = 0; i < volume->geometry.voxel_count(); ++i)
    values.push_back(10.0F * static_cast<float>(volume->geometry.voxel_at(i).z));
  volume->voxels = std::move(values);
  auto image = std::make_shared<document::CaseImage>();
  image->volume = std::move(volume);
  engine::ShownImage shown;
  shown.image = std::move(image);
  shown.colours = engine::ImageColours::grey;
  shown.opacity = 1.0;
  shown.window = {150.0, 300.0};
  return shown;
}

class Asked {
 public:
  explicit Asked(std::vector<engine::ShownImage> images) : images_(std::move(images)) {}

  void at(double z, WindowLevel window = {}) {
    renderer::SliceView slice;
    slice.position_mm = {20.0, 20.0, z};
    slice.window = window;
    overlay.ask(images_, slice,
                ui::SliceScreen(slice, QSizeF(kView), images_.front().image->volume->geometry), kView);
  }
  void hide() {
    for (engine::ShownImage& image : images_) image.visible = false;
  }
  // What is seen in the middle, as the value that it stands for.
  [[nodiscard]] double value() const {
    const QImage& picture = overlay.newest()->picture;
    return picture.pixelColor(picture.width() / 2, picture.height() / 2).red() / 255.0 * 300.0;
  }

  ui::ImageOverlay overlay;

 private:
  std::vector<engine::ShownImage> images_;
};

}  // namespace

class ImageOverlayTest : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() { QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60))); }

  void asking_does_not_wait() {
    Asked asked({layers()});
    asked.at(12.0);
    QVERIFY(!asked.overlay.newest());
    QTRY_VERIFY(asked.overlay.newest());
    QVERIFY2(std::abs(asked.value() - 120.0) < 2.0, qPrintable(QString::number(asked.value())));
    QCOMPARE(asked.overlay.newest()->slice.position_mm.z, 12.0);
    const renderer::ImagesOver& over = *asked.overlay.newest()->over;
    QCOMPARE(over.rgba.size(), static_cast<std::size_t>(4 * over.width * over.height));
  }

  // A slice that moves on faster than its images are sampled.
  void older_places_never_follow_newer_ones() {
    Asked asked({layers({200, 200, 30})});
    std::vector<double> seen;
    connect(&asked.overlay, &ui::ImageOverlay::arrived, &asked.overlay, [&] {
      const double z = asked.overlay.newest()->slice.position_mm.z;
      QVERIFY2(std::abs(asked.value() - 10.0 * z) < 2.0, qPrintable(QString::number(asked.value())));
      seen.push_back(z);
    });
    for (int z = 1; z <= 25; ++z) {
      asked.at(z);
      if (z % 5 == 0) QTest::qWait(1);
    }
    QTRY_VERIFY(!seen.empty() && seen.back() == 25.0);
    QVERIFY(std::is_sorted(seen.begin(), seen.end()));
    QVERIFY2(seen.size() < 25, qPrintable(QString::number(seen.size())));  // those in between were left out
    QTest::qWait(100);
    QCOMPARE(seen.back(), 25.0);
  }

  void the_look_of_the_slice_asks_for_nothing() {
    Asked asked({layers()});
    asked.at(12.0);
    QTRY_VERIFY(asked.overlay.newest());
    QSignalSpy arrived(&asked.overlay, &ui::ImageOverlay::arrived);
    asked.at(12.0, {40.0, 400.0});
    QVERIFY(engine::BackgroundJob::finish_all(std::chrono::milliseconds(0)));  // nothing was begun
    QTest::qWait(50);
    QVERIFY(arrived.isEmpty());
  }

  void what_is_hidden_is_gone_at_once_and_does_not_come_back() {
    Asked asked({layers({200, 200, 30})});
    asked.at(12.0);
    asked.hide();
    asked.at(12.0);
    QVERIFY(!asked.overlay.newest());
    QSignalSpy arrived(&asked.overlay, &ui::ImageOverlay::arrived);
    QTest::qWait(100);
    QVERIFY(arrived.isEmpty() && !asked.overlay.newest());
  }

  void a_slice_beside_the_image_has_none() {
    Asked asked({layers()});
    asked.at(500.0);
    QTRY_VERIFY(asked.overlay.newest());
    QVERIFY(asked.overlay.newest()->picture.isNull());
    QVERIFY(!asked.overlay.newest()->over);
  }
};

TIDEMARK_TEST(ImageOverlayTest)

}  // namespace tidemark::test::image_overlay_test

#include "image_overlay_test.moc"
