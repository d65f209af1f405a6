// Films of an evolution and of a turn, on the command line.
#include <gif_lib.h>

#include <QJsonDocument>
#include <array>

#include "core/atomic_file.h"
#include "tests/app/cli_runner.h"
#include "tests/app/speed_files.h"
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
  std::unique_ptr<SpeedFiles> files_;
  QString series_;
  QString recipe_;

 private slots:
  void initTestCase() {
    study_ = std::make_unique<SphereStudy>();
    files_ = std::make_unique<SpeedFiles>();
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

  void as_many_pictures_as_are_asked_for_data() {
    QTest::addColumn<int>("steps");
    QTest::addColumn<QStringList>("frames");
    QTest::addColumn<int>("pictures");
    QTest::newRow("by default") << 117 << QStringList{} << 60;
    QTest::newRow("as many as there may be") << 3997 << QStringList{"--frames", "2000"} << 2000;
    QTest::newRow("fewer, or there were too many") << 2500 << QStringList{"--frames", "2000"} << 1251;
  }
  void as_many_pictures_as_are_asked_for() {
    QFETCH(int, steps);
    QFETCH(QStringList, frames);
    QFETCH(int, pictures);
    const QString volume = text(*files_ / "ball.nrrd");
    const auto recipe = *files_ / "steps.json";
    must_run({"segment", volume, "--target", "1000", "--range", "500", "--alpha", "0.8", "--seed",
              "15,15,15,4", "--steps", "1", "--executor", "host", "--recipe", text(recipe)});
    QJsonObject longer = json_of(bytes_of(recipe));
    longer["steps"] = steps;
    QVERIFY(write_file(recipe, QJsonDocument(longer).toJson().toStdString()));
    const Outcome outcome = must_run(QStringList{"film", volume, "--recipe", text(recipe), "--view", "axial",
                                                 "--at", "15,15,15", "--size", "16x16", "--renderer", "host",
                                                 "--json", "--out", text(*files_ / "steps.gif")} +
                                     frames);
    QCOMPARE(json_of(outcome.out)["frames"].toInt(), pictures);
  }

  void what_a_recipe_needs_beside_its_volume_is_given_data() {
    QTest::addColumn<QString>("volume");
    QTest::addColumn<QStringList>("speed");
    QTest::addColumn<QStringList>("needed");
    QTest::addColumn<QStringList>("view");
    const auto file = [&](const char* name) { return text(*files_ / name); };
    const QStringList map{"--speed-image", file("map.nii.gz")};
    const QStringList by_map{"--speed", "image"};
    const QStringList by_examples{"--speed", "examples", "--examples", file("labels.nii.gz")};
    const QStringList images{"--image", file("second.nrrd"), "--image", file("third.nrrd")};
    const QStringList slice{"--view", "axial"};
    QTest::newRow("map") << file("ball.nrrd") << by_map << map << slice;
    QTest::newRow("images") << file("textures.nii.gz") << by_examples << images << slice;
    QTest::newRow("map that is seen, too")
        << file("ball.nrrd") << by_map << map << QStringList{"--view", "speed"} + by_map;
  }
  void what_a_recipe_needs_beside_its_volume_is_given() {
    QFETCH(QString, volume);
    QFETCH(QStringList, speed);
    QFETCH(QStringList, needed);
    QFETCH(QStringList, view);
    const QString recipe = text(*files_ / "needs.json");
    must_run(QStringList{"segment", volume, "--alpha", "0.7", "--seed", "15,15,15,4", "--steps", "4",
                         "--executor", "host", "--recipe", recipe} +
             speed + needed);
    const auto film = *files_ / "needs.gif";
    const QStringList command = QStringList{"film",   volume,  "--recipe",   recipe, "--at",  "15,15,15",
                                            "--size", "64x64", "--renderer", "host", "--out", text(film)} +
                                view;
    const Outcome without = run_cli(command);
    QVERIFY2(without.failed_in_one_line(2) && without.err.contains(needed.first().toUtf8()), without.told());
    QVERIFY(!std::filesystem::exists(film));
    must_run(command + needed);
    QCOMPARE(film_in(text(film)).pictures.size(), std::size_t{5});
    std::filesystem::remove(film);
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
