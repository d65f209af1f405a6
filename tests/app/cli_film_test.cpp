// Films of an evolution and of a turn, on the command line.
#include <QImageReader>

#include "tests/app/cli_runner.h"
#include "tests/support/test_program.h"

using namespace tidemark;
using namespace tidemark::test;

namespace {

std::vector<QImage> pictures_of(const QString& file) {
  QImageReader reader(file, "gif");
  std::vector<QImage> pictures;
  for (QImage picture = reader.read(); !picture.isNull(); picture = reader.read()) {
    pictures.push_back(picture.convertToFormat(QImage::Format_RGB32));
  }
  return pictures;
}

// Of the surface's outline in slices.
qint64 yellow_pixels(const QImage& picture) {
  qint64 count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const QRgb pixel = picture.pixel(x, y);
      if (qRed(pixel) > 150 && qGreen(pixel) > 120 && qBlue(pixel) < 100) ++count;
    }
  }
  return count;
}

}  // namespace

class CliFilmTest : public QObject {
  Q_OBJECT

  std::unique_ptr<SphereStudy> study_;
  QString series_;
  QString recipe_;

 private slots:
  void initTestCase() {
    study_ = std::make_unique<SphereStudy>();
    series_ = text(*study_ / "series");
    recipe_ = text(*study_ / "recipe.json");
    must_run(study_->arguments() + QStringList{"--out", text(*study_ / "mask.nrrd"), "--recipe", recipe_});
  }

  void the_surface_grows_from_picture_to_picture() {
    const QString film = text(*study_ / "growth.gif");
    const QJsonObject told =
        json_of(must_run({"film", series_, "--recipe", recipe_, "--view", "axial", "--frames", "10", "--size",
                          "120x100", "--out", film, "--json"})
                    .out);
    const auto pictures = pictures_of(film);
    QCOMPARE(static_cast<int>(pictures.size()), told["frames"].toInt());
    QVERIFY(pictures.size() >= 10 && pictures.size() <= 12);
    for (const QImage& picture : pictures) QCOMPARE(picture.size(), QSize(120, 100));
    // From a ball of 8 mm to one of 20 mm.
    const auto first = static_cast<double>(yellow_pixels(pictures.front()));
    const auto last = static_cast<double>(yellow_pixels(pictures.back()));
    QVERIFY2(first > 20.0 && last > 1.8 * first, qPrintable(QString("%1 %2").arg(first).arg(last)));
    QImageReader reader(film, "gif");
    QCOMPARE(reader.loopCount(), -1);
    reader.read();
    QCOMPARE(reader.nextImageDelay(), 50);  // ms
  }

  void the_camera_goes_around() {
    const QString film = text(*study_ / "turn.gif");
    must_run({"film", series_, "--mask", text(*study_ / "mask.nrrd"), "--clip", "1,0,0,0", "--turn", "180",
              "--frames", "6", "--size", "64x64", "--per-second", "10", "--out", film});
    const auto pictures = pictures_of(film);
    QCOMPARE(pictures.size(), std::size_t{6});
    for (std::size_t i = 1; i < pictures.size(); ++i) QVERIFY(pictures[i] != pictures[i - 1]);
  }

  void what_makes_no_film_is_refused_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("told");
    QTest::newRow("nothing moves") << QStringList{"--out", "x.gif"} << "give --recipe or --turn";
    QTest::newRow("no recipe") << QStringList{"--turn", "9", "--every", "2", "--out", "x.gif"}
                               << "--every counts steps";
    QTest::newRow("a slice") << QStringList{"--turn", "9", "--view", "axial", "--out", "x.gif"}
                             << "not of --view axial";
    QTest::newRow("one picture") << QStringList{"--turn", "9", "--frames", "1", "--out", "x.gif"}
                                 << "must be 2 to";
    QTest::newRow("too fast") << QStringList{"--turn", "9", "--per-second", "100", "--out", "x.gif"}
                              << "--per-second 100";
    QTest::newRow("no GIF") << QStringList{"--turn", "9", "--preset", "mr-default", "--out", "x.mp4"}
                            << "must end in .gif";
  }
  void what_makes_no_film_is_refused() {
    QFETCH(QStringList, arguments);
    QFETCH(QString, told);
    RunOptions here;
    here.folder = text(study_->folder());
    const Outcome refused = run_cli(QStringList{"film", series_} + arguments, here);
    QVERIFY2(refused.failed_in_one_line(2), refused.told());
    QVERIFY2(refused.err.contains(told.toUtf8()), refused.told());
    QVERIFY(!std::filesystem::exists(*study_ / "x.gif"));
  }
};

TIDEMARK_TEST(CliFilmTest)
#include "cli_film_test.moc"
