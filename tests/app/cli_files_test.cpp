// What is read and written: listings, volumes, surfaces, pictures.
#include <QDataStream>
#include <QFile>
#include <QJsonArray>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_files_test {

namespace {

// GIPL is big endian, and has no field for how the axes lie in the patient. Of a volume of int16, 1 mm.
void write_gipl(const Volume& volume, const std::filesystem::path& to) {
  QFile file(text(to));
  if (!file.open(QIODevice::WriteOnly)) qFatal("%s cannot be written", to.c_str());
  QDataStream out(&file);
  out.setFloatingPointPrecision(QDataStream::SinglePrecision);
  const Index3 size = volume.geometry.size;
  for (const std::int64_t count : {size.x, size.y, size.z, std::int64_t{1}})
    out << static_cast<quint16>(count);
  out << quint16{15};  // int16
  for (int axis = 0; axis < 4; ++axis) out << 1.0F;
  const QByteArray unused(252 - 26, '\0');
  out.writeRawData(unused.constData(), static_cast<int>(unused.size()));
  out << quint32{0xEFFFE9B0};
  for (const std::int16_t value : std::get<std::vector<std::int16_t>>(volume.voxels)) out << qint16{value};
}

}  // namespace

class CliFilesTest : public QObject {
  Q_OBJECT

 private slots:
  void info_lists_what_the_contract_names();
  void distance_is_signed_and_in_millimetres();
  void formats_keep_values_and_geometry();
  void a_mask_becomes_a_surface();
  void a_runs_picture_shows_its_own_speed();
  void slices_of_a_sheet_are_drawn_as_they_are_asked_for();
  void pictures_claim_no_sides_that_nobody_knows();
  void pictures_are_drawn_from_masks_and_fields_data();
  void pictures_are_drawn_from_masks_and_fields();

 private:
  TemporaryFolder folder_;
  const SphereStudy sphere_;
};

void CliFilesTest::info_lists_what_the_contract_names() {
  const Outcome outcome = must_run({"info", text(sphere_.folder()), "--json"});
  const QJsonObject all = json_of(outcome.out);
  QVERIFY(all["series"].isArray() && all["skipped"].isArray());
  QJsonObject series;
  for (const auto one : all["series"].toArray()) {
    if (one.toObject()["modality"].toString() == "MR") series = one.toObject();
  }
  for (const char* key : {"uid", "modality", "description", "date", "files", "size", "spacing_mm",
                          "direction", "origin_mm", "frame_of_reference", "same_frame", "scalar",
                          "transfer_syntaxes", "loadable", "reason", "changes", "warnings"}) {
    QVERIFY2(series.contains(key), key);
  }
  QCOMPARE(series["files"].toInt(), 81);
  QCOMPARE(series["loadable"].toBool(), true);
  QCOMPARE(series["direction"].toArray(), (QJsonArray{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}));
  QCOMPARE(series["scalar"].toString(), QString("int16"));
}

void CliFilesTest::distance_is_signed_and_in_millimetres() {
  Volume volume = ball(Index3(32), 9.5);
  volume.geometry.spacing_mm = glm::dvec3(2.0);
  QCOMPARE(failure(imaging::write_mask_file(ball_mask(volume), folder_ / "ball.nii.gz")), QString());
  const Outcome outcome = must_run({"distance", text(folder_ / "ball.nii.gz"), "--band", "4", "--out",
                                    text(folder_ / "distance.nrrd"), "--json"});
  QCOMPARE(json_of(outcome.out)["band_mm"].toDouble(), 8.0);
  const auto distance = imaging::read_volume_file(folder_ / "distance.nrrd");
  QCOMPARE(failure(distance), QString());
  const glm::dvec3 middle(15.5);
  double worst = 0.0;
  for (std::int64_t i = 0; i < 32; ++i) {
    const double exact = 2.0 * (9.5 - glm::length(glm::dvec3(i, 15, 15) - middle));
    const double found = distance->value(Index3(i, 15, 15));
    worst = std::max(worst, std::abs(found - std::clamp(exact, -8.0, 8.0)));
  }
  QVERIFY2(worst < 1.0, qPrintable(QString("half a voxel is 1 mm; worst %1 mm").arg(worst)));
}

void CliFilesTest::formats_keep_values_and_geometry() {
  Volume volume = ball(Index3(9, 10, 11), 3.0);
  volume.geometry.spacing_mm = {0.5, 0.75, 2.0};
  volume.geometry.origin_mm = {-12.5, 30.25, 7.0};
  QCOMPARE(failure(imaging::write_dicom_series(volume, {}, folder_ / "oblong")), QString());
  QString from = text(folder_ / "oblong");
  for (const char* name : {"a.nii.gz", "b.nrrd", "c.mha", "d.nii"}) {
    QCOMPARE(must_run({"convert", from, "--out", text(folder_ / name)}).code, 0);
    const auto read = imaging::read_volume_file(folder_ / name);
    QCOMPARE(failure(read), QString());
    QVERIFY(same_grid(read->geometry, volume.geometry, 1e-3));
    QCOMPARE(read->values(), volume.values());
    from = text(folder_ / name);
  }
}

void CliFilesTest::a_mask_becomes_a_surface() {
  const Outcome outcome = must_run({"convert", text(sphere_ / "truth.nii.gz"), "--out",
                                    text(folder_ / "truth.stl"), "--out", text(folder_ / "truth.obj")});
  QVERIFY2(outcome.out.contains("Surface "), outcome.told());
  QVERIFY(bytes_of(folder_ / "truth.stl").size() > 84 + 50 * 1000);
  const Outcome labels =
      must_run({"convert", text(sphere_ / "series"), "--mask", "--out", text(folder_ / "nonzero.nii.gz")});
  QCOMPARE(labels.code, 0);
}

// The same surface, before the first step, driven by the tent alone and by another function, too.
void CliFilesTest::a_runs_picture_shows_its_own_speed() {
  const TemporaryFolder folder;
  const auto file = folder / "ball.nrrd";
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(32), 10.0), file)), QString());
  const auto picture = [&](const QStringList& speed) {
    const auto to = folder / "picture.png";
    must_run(QStringList{"segment", text(file)} + ball_arguments(Index3(32)) + speed +
             QStringList{"--steps", "0", "--out", text(folder / "mask.nrrd"), "--picture", text(to)});
    return bytes_of(to);
  };
  const QByteArray of_tent = picture({});
  QVERIFY(of_tent == picture({"--speed", "tent"}));
  QVERIFY(of_tent != picture({"--speed", "tent", "--speed", "edges"}));
}

void CliFilesTest::slices_of_a_sheet_are_drawn_as_they_are_asked_for() {
  const TemporaryFolder folder;
  const Volume volume = ball(Index3(32), 10.0);
  QCOMPARE(failure(imaging::write_volume_file(volume, folder / "ball.nrrd")), QString());
  QCOMPARE(failure(imaging::write_mask_file(ball_mask(volume), folder / "mask.nrrd")), QString());
  const auto sheet = [&](const QStringList& more) {
    const auto to = folder / "sheet.png";
    must_run(QStringList{"render", text(folder / "ball.nrrd"), "--mask", text(folder / "mask.nrrd"), "--view",
                         "sheet", "--size", "150x100", "--renderer", "host", "--out", text(to)} +
             more);
    return bytes_of(to);
  };
  const QByteArray plain = sheet({});
  QVERIFY(plain.size() > 300 && sheet({}) == plain);
  const QByteArray nearest = sheet({"--nearest"});
  const QByteArray contours = sheet({"--contours"});
  QVERIFY(nearest != plain);
  QVERIFY(contours != plain && contours != nearest);
}

// Of one volume in two files, of which one says where the patient's sides are.
void CliFilesTest::pictures_claim_no_sides_that_nobody_knows() {
  const TemporaryFolder folder;
  const Index3 size(32);
  const Volume volume = ball(size, 10.0);
  write_gipl(volume, folder / "ball.gipl");
  QCOMPARE(failure(imaging::write_volume_file(volume, folder / "ball.nrrd")), QString());
  const auto same = [&](const QStringList& command) {
    const auto picture = [&](const char* study) {
      const auto to = folder / "picture.png";
      must_run(QStringList(command).replaceInStrings("STUDY", text(folder / study)) << text(to));
      return bytes_of(to);
    };
    return picture("ball.gipl") == picture("ball.nrrd");
  };
  const QStringList plain{"render", "STUDY", "--size", "96x64", "--view", "axial", "--out"};
  QVERIFY(same(plain));
  for (const char* view : {"axial", "3d", "sheet"}) {
    QVERIFY2(!same({"render", "STUDY", "--size", "96x64", "--preset", "ct-bone", "--annotate", "--view", view,
                    "--out"}),
             view);
  }
  const QString recipe = text(folder / "recipe.json");
  QVERIFY(!same(QStringList{"segment", "STUDY", "--steps", "0"} + ball_arguments(size) +
                QStringList{"--recipe", recipe, "--picture"}));
  QVERIFY(!same({"replay", recipe, "STUDY", "--picture"}));
}

void CliFilesTest::pictures_are_drawn_from_masks_and_fields_data() {
  QTest::addColumn<QString>("renderer");
  for (const char* renderer : {"host", "gl"}) QTest::newRow(renderer) << renderer;
}

void CliFilesTest::pictures_are_drawn_from_masks_and_fields() {
  QFETCH(QString, renderer);
  const TemporaryFolder folder;
  const Volume volume = ball(Index3(32), 10.0);
  const auto file = folder / "ball.nrrd";
  QCOMPARE(failure(imaging::write_volume_file(volume, file)), QString());
  must_run(QStringList{"segment", text(file)} + ball_arguments(Index3(32)) +
           QStringList{"--out", text(folder / "mask.nrrd"), "--out-phi", text(folder / "phi.nrrd"),
                       "--picture", text(folder / "sheet-of-segment.png"), "--renderer", renderer});
  QVERIFY(bytes_of(folder / "sheet-of-segment.png").startsWith("\x89PNG"));
  const auto tf = folder / "tf.json";
  QFile file_of_tf(text(tf));
  QVERIFY(file_of_tf.open(QIODevice::WriteOnly));
  file_of_tf.write(
      R"({"relative": true, "source": [{"value": {"ramp": [0, 1]}, "opacity": 1, "colour": [1, 1, 1]}]})");
  file_of_tf.close();
  const QList<QStringList> views = {
      {"--mask", text(folder / "mask.nrrd"), "--camera", "30,20,1.2"},
      {"--phi", text(folder / "phi.nrrd"), "--clip", "0,-1,0,-16", "--opacity", "0.5"},
      {"--preset", "ct-bone", "--phi", text(folder / "phi.nrrd"), "--roi", "inside"},
      {"--mask", text(folder / "mask.nrrd"), "--view", "sagittal", "--at", "16,16,16"},
      {"--mask", text(folder / "mask.nrrd"), "--fit", "--colour", "curvature", "--occlusion", "0.5",
       "--annotate"},
      {"--mask", text(folder / "mask.nrrd"), "--clip", "0,-1,0,-16", "--clipped", "source", "--tf", text(tf)},
      {"--mask", text(folder / "mask.nrrd"), "--view", "oblique", "--normal", "1,1,0.5", "--nearest",
       "--annotate"},
      {"--view", "axial", "--labels", text(folder / "mask.nrrd")},
      {"--view", "3d", "--labels", text(folder / "mask.nrrd")},
      {"--view", "speed", "--target", "1000", "--range", "500"},
      {"--phi", text(folder / "phi.nrrd"), "--view", "speed", "--target", "1000", "--range", "500", "--term",
       "total"},
      {"--phi", text(folder / "phi.nrrd"), "--view", "pages", "--window", "500,1000"}};
  for (const QStringList& view : views) {
    const auto picture = folder / "picture.png";
    const QJsonObject told =
        json_of(must_run(QStringList{"render", text(file), "--size", "96x64", "--renderer", renderer,
                                     "--json", "--out", text(picture)} +
                         view)
                    .out);
    QCOMPARE(told["width"].toInt(), 96);
    QCOMPARE(told["renderer"].toString(), renderer);
    const QByteArray bytes = bytes_of(picture);
    QVERIFY(bytes.startsWith("\x89PNG"));
    // The header's first chunk holds the size, most significant byte first.
    QCOMPARE(bytes.mid(16, 8), QByteArray("\0\0\0\x60\0\0\0\x40", 8));
    QVERIFY2(bytes.size() > 300, "an even picture");
  }
  // Three columns and two rows share the sheet, with two pixels between them.
  const auto sheet = folder / "sheet.png";
  const QJsonObject told =
      json_of(must_run({"render", text(file), "--mask", text(folder / "mask.nrrd"), "--view", "sheet",
                        "--size", "300x200", "--renderer", renderer, "--json", "--out", text(sheet)})
                  .out);
  QCOMPARE(told["width"].toInt(), 298);
  QCOMPARE(told["height"].toInt(), 200);
}

TIDEMARK_TEST(CliFilesTest)

}  // namespace tidemark::test::cli_files_test

#include "cli_files_test.moc"
