// Films of an evolution and of a turn, on the command line.
#include <gif_lib.h>

#include <array>

#include "tests/app/cli_runner.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_film_test {

namespace {

using Colour = std::array<int, 3>;

struct Film {
  int width = 0;
  int height = 0;
  int hundredths = 0;  // of a second, that the first picture stays
  bool for_ever = false;
  std::vector<std::vector<Colour>> pictures;
};

// Empty where it cannot be read.
Film film_in(const QString& file) {
  Film film;
  int code = 0;
  GifFileType* gif = DGifOpenFileName(file.toUtf8().constData(), &code);
  if (gif == nullptr) return film;
  if (DGifSlurp(gif) == GIF_OK) {
    film.width = gif->SWidth;
    film.height = gif->SHeight;
    for (int i = 0; i < gif->ImageCount; ++i) {
      const SavedImage& image = gif->SavedImages[i];
      std::vector<Colour> pixels;
      for (int pixel = 0; pixel < film.width * film.height; ++pixel) {
        const GifColorType& colour = image.ImageDesc.ColorMap->Colors[image.RasterBits[pixel]];
        pixels.push_back({colour.Red, colour.Green, colour.Blue});
      }
      film.pictures.push_back(std::move(pixels));
    }
    GraphicsControlBlock control{};
    DGifSavedExtensionToGCB(gif, 0, &control);
    film.hundredths = control.DelayTime;
    const SavedImage& first = gif->SavedImages[0];
    for (int i = 0; i < first.ExtensionBlockCount; ++i) {
      film.for_ever = film.for_ever || first.ExtensionBlocks[i].Function == APPLICATION_EXT_FUNC_CODE;
    }
  }
  DGifCloseFile(gif, &code);
  return film;
}

// Of the surface's outline in slices.
double yellow_pixels(const std::vector<Colour>& picture) {
  return static_cast<double>(std::count_if(picture.begin(), picture.end(), [](const Colour& pixel) {
    return pixel[0] > 150 && pixel[1] > 120 && pixel[2] < 100;
  }));
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
    const QString file = text(*study_ / "growth.gif");
    const QJsonObject told =
        json_of(must_run({"film", series_, "--recipe", recipe_, "--view", "axial", "--frames", "10", "--size",
                          "120x100", "--out", file, "--json"})
                    .out);
    const Film film = film_in(file);
    QCOMPARE(static_cast<int>(film.pictures.size()), told["frames"].toInt());
    QVERIFY(film.pictures.size() >= 10 && film.pictures.size() <= 12);
    QVERIFY(film.width == 120 && film.height == 100);
    QVERIFY(film.for_ever && film.hundredths == 5);
    // From a ball of 8 mm to one of 20 mm.
    const double first = yellow_pixels(film.pictures.front());
    const double last = yellow_pixels(film.pictures.back());
    QVERIFY2(first > 20.0 && last > 1.4 * first, qPrintable(QString("%1 %2").arg(first).arg(last)));
  }

  void the_camera_goes_around() {
    const QString file = text(*study_ / "turn.gif");
    must_run({"film", series_, "--mask", text(*study_ / "mask.nrrd"), "--clip", "1,0,0,0", "--turn", "180",
              "--frames", "6", "--size", "64x64", "--per-second", "10", "--out", file});
    const Film film = film_in(file);
    QCOMPARE(film.pictures.size(), std::size_t{6});
    for (std::size_t i = 1; i < film.pictures.size(); ++i) QVERIFY(film.pictures[i] != film.pictures[i - 1]);
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
    QTest::newRow("no GIF") << QStringList{"--turn", "9", "--preset", "mr-head", "--out", "x.mp4"}
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

}  // namespace tidemark::test::cli_film_test

#include "cli_film_test.moc"
