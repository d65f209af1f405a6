// Phantoms as files: valid DICOM, a mask, and a description.
#include <QProcess>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "imaging/phantom/phantom.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::phantom_write_test {

namespace {

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// A phantom cut down to a few slices: the files are as those of the whole, and there are few of them.
imaging::Phantom cut(imaging::Phantom phantom, std::int64_t slices) {
  const auto count =
      static_cast<std::size_t>(phantom.volume.geometry.size.x * phantom.volume.geometry.size.y * slices);
  std::get<std::vector<std::int16_t>>(phantom.volume.voxels).resize(count);
  phantom.truth.voxels.resize(count);
  phantom.volume.geometry.size.z = slices;
  phantom.truth.geometry.size.z = slices;
  return phantom;
}

nlohmann::json parsed(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream, nullptr, false);
}

}  // namespace

class PhantomWriteTest : public QObject {
  Q_OBJECT

 private slots:
  void what_is_written_is_valid_dicom_data() {
    QTest::addColumn<QString>("kind");
    for (const char* kind : {"bridge", "organ"}) QTest::newRow(kind) << kind;  // one MR, one CT
  }
  void what_is_written_is_valid_dicom() {
    QFETCH(QString, kind);
    auto made = imaging::make_phantom(kind.toStdString());
    QCOMPARE(failure(made), QString());
    const TemporaryFolder folder;
    const Status written = imaging::write_phantom(cut(std::move(*made), 3), folder.path());
    QCOMPARE(failure(written), QString());
    const auto files = files_in(folder / "series");
    QCOMPARE(files.size(), std::size_t{3});
    for (const auto& file : files) {
      QProcess validator;
      validator.setProcessChannelMode(QProcess::MergedChannels);
      validator.start("dciodvfy", {QString::fromStdString(file.string())});
      QVERIFY2(validator.waitForStarted(), "dciodvfy is not installed (package dicom3tools)");
      QVERIFY(validator.waitForFinished());
      const QByteArray said = validator.readAll();
      QVERIFY2(validator.exitCode() == 0 && !said.contains("Error"), said.constData());
    }
  }

  void a_series_reads_back_as_it_was_made() {
    const auto made = imaging::make_phantom("bridge");
    QCOMPARE(failure(made), QString());
    const TemporaryFolder folder;
    const Status written = imaging::write_phantom(*made, folder / "a/new/folder");
    QCOMPARE(failure(written), QString());

    const auto catalogue = imaging::scan_dicom(folder / "a/new/folder/series");
    QCOMPARE(failure(catalogue), QString());
    QCOMPARE(catalogue->series.size(), std::size_t{1});
    const auto volume = imaging::load_dicom(catalogue->series[0]);
    QCOMPARE(failure(volume), QString());
    QVERIFY(same_grid(volume->geometry, made->volume.geometry, 1e-6));
    QVERIFY(volume->values() == made->volume.values());
    QCOMPARE(volume->modality, std::string("MR"));
    QVERIFY(volume->window.has_value());
    QCOMPARE(volume->window->width, made->volume.window->width);

    const auto truth = imaging::read_volume_file(folder / "a/new/folder/truth.nii.gz");
    QCOMPARE(failure(truth), QString());
    QVERIFY(same_grid(truth->geometry, made->truth.geometry, 1e-4));
    const std::vector<float> values = truth->values();
    QVERIFY(std::equal(values.begin(), values.end(), made->truth.voxels.begin(), made->truth.voxels.end()));
  }

  void the_description_holds_parameters_and_a_start() {
    auto made = imaging::make_phantom("dumbbell", {.noise_percent = 1.5, .random_seed = 77});
    QCOMPARE(failure(made), QString());
    const TemporaryFolder folder;
    QCOMPARE(failure(imaging::write_phantom(cut(*made, 2), folder.path())), QString());
    const nlohmann::json json = parsed(folder / "phantom.json");
    QVERIFY(!json.is_discarded());
    QCOMPARE(json.at("kind").get<std::string>(), std::string("dumbbell"));
    QCOMPARE(json.at("target").get<double>(), made->target);
    QCOMPARE(json.at("range").get<double>(), made->range);
    QCOMPARE(json.at("alpha").get<double>(), made->alpha);
    QCOMPARE(json.at("seed").get<std::vector<double>>(), std::vector<double>({32, 32, 32, 8}));
    QVERIFY(!json.contains("init_threshold"));
    QCOMPARE(json.at("modality").get<std::string>(), std::string("MR"));
    QCOMPARE(json.at("size").get<std::vector<int>>(), std::vector<int>({121, 65, 2}));
    QCOMPARE(json.at("spacing_mm").get<std::vector<double>>(), std::vector<double>({1, 1, 1}));
    QCOMPARE(json.at("noise_percent").get<double>(), 1.5);
    QCOMPARE(json.at("random_seed").get<int>(), 77);
    QVERIFY(!json.at("truth").get<std::string>().empty());

    made->init_threshold = {500.0, 1100.0};
    QCOMPARE(failure(imaging::write_phantom(cut(*made, 2), folder / "threshold")), QString());
    const nlohmann::json other = parsed(folder / "threshold/phantom.json");
    QCOMPARE(other.at("init_threshold").get<std::vector<double>>(), std::vector<double>({500, 1100}));
    QVERIFY(!other.contains("seed"));
  }

  void a_folder_that_cannot_be_made_is_an_error_of_writing() {
    const auto made = imaging::make_phantom("dumbbell");
    QCOMPARE(failure(made), QString());
    const TemporaryFolder folder;
    std::ofstream(folder / "file") << "in the way";
    const Status written = imaging::write_phantom(*made, folder / "file/below");
    QVERIFY(!written);
    QCOMPARE(written.error().kind, ErrorKind::write);
    QVERIFY(failure(written).contains("file/below"));
  }
};

TIDEMARK_TEST(PhantomWriteTest)

}  // namespace tidemark::test::phantom_write_test

#include "phantom_write_test.moc"
