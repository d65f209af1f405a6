// Media with a DICOMDIR.
#include <QElapsedTimer>
#include <algorithm>
#include <cctype>
#include <stop_token>

#include "imaging/dicom/media_directory.h"
#include "imaging/load_study.h"
#include "tests/imaging/dicom/bad_dicom.h"
#include "tests/imaging/dicom/directory_bytes.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/test_program.h"

namespace tidemark::test::media_directory_test {

namespace fs = std::filesystem;

namespace {

// A disc: the series' files in IMAGES, named as a burner may write them, and a file that is no image.
struct Disc {
  test::TemporaryFolder folder;
  imaging::Series series;

  explicit Disc(const char* suffix = "") {
    test::write_series(test::sample_volume({5, 4, 3}), folder / "images");
    series = test::only_series(folder / "images");
    int number = 0;
    for (const fs::path& file : series.files) {
      fs::rename(file, folder.path() / "images" / ("im" + std::to_string(++number) + suffix));
    }
    test::write_bytes(folder / "autorun.inf", "open=viewer.exe");
  }
  [[nodiscard]] fs::path directory() const { return folder / "DICOMDIR"; }
  void write(const std::vector<std::string>& names) const {
    test::write_bytes(directory(), test::directory_bytes(series.uid, names));
  }
};

const std::vector<std::string> kAll{"IMAGES\\IM1", "IMAGES\\IM2", "IMAGES\\IM3"};

}  // namespace

class MediaDirectoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_directory_opens_the_files_that_it_names_data() {
    QTest::addColumn<QByteArray>("suffix");
    QTest::addColumn<QByteArray>("name");
    QTest::newRow("as it is") << QByteArray("") << QByteArray("DICOMDIR");
    QTest::newRow("with versions") << QByteArray(";1") << QByteArray("DICOMDIR;1");
    QTest::newRow("with points") << QByteArray(".") << QByteArray("dicomdir.");
  }
  void a_directory_opens_the_files_that_it_names() {
    QFETCH(QByteArray, suffix);
    QFETCH(QByteArray, name);
    const Disc disc(suffix.constData());
    disc.write(kAll);
    fs::rename(disc.directory(), disc.folder / name.toStdString());
    const auto found = imaging::find_series(disc.folder / name.toStdString());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    QVERIFY2(found->series[0].loadable, found->series[0].reason.c_str());
    QCOMPARE(found->series[0].files.size(), std::size_t{3});
    QVERIFY(found->series[0].warnings.empty());
    QVERIFY(found->skipped.empty());
    QCOMPARE(test::failure(imaging::load_series(found->series[0])), QString());
  }

  void missing_files_are_named_by_the_directory_and_by_its_folder() {
    const Disc disc;
    disc.write({kAll[0], kAll[1], kAll[2], "IMAGES\\IM4", "OTHER\\IM5"});
    for (const fs::path& path : {disc.directory(), disc.folder.path()}) {
      const auto found = imaging::find_series(path);
      QCOMPARE(test::failure(found), QString());
      QCOMPARE(found->series.size(), std::size_t{1});
      QVERIFY(found->series[0].loadable);
      QCOMPARE(found->series[0].warnings.size(), std::size_t{1});
      QCOMPARE(
          found->series[0].warnings[0],
          std::string("DICOMDIR names 2 files of this series that are not there: IMAGES/IM4, OTHER/IM5"));
      const auto told =
          std::find_if(found->skipped.begin(), found->skipped.end(),
                       [&](const imaging::SkippedFile& one) { return one.file == disc.directory(); });
      QVERIFY(told != found->skipped.end());
      QCOMPARE(told->reason, std::string("refers to 2 files that are not there: IMAGES/IM4, OTHER/IM5"));
    }
  }

  void a_folder_with_a_whole_directory_says_nothing_of_it() {
    const Disc disc;
    disc.write(kAll);
    const auto found = imaging::find_series(disc.folder.path());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->skipped.size(), std::size_t{1});
    QCOMPARE(found->skipped[0].file.filename().string(), std::string("autorun.inf"));
  }

  void no_name_leads_out_of_the_folder_data() {
    QTest::addColumn<QByteArray>("name");
    QTest::newRow("the folder above") << QByteArray("..\\OUTSIDE\\IM1");
    QTest::newRow("there and back") << QByteArray("IMAGES\\..\\..\\OUTSIDE\\IM1");
    QTest::newRow("an absolute path") << QByteArray("/etc/hostname");
    QTest::newRow("slashes") << QByteArray("../OUTSIDE/IM1");
    QTest::newRow("a link to a file") << QByteArray("LINK");
    QTest::newRow("a link to a folder") << QByteArray("FOLDER\\IM1");
    QTest::newRow("itself by a point") << QByteArray(".\\IMAGES\\IM1");
    QTest::newRow("a folder") << QByteArray("IMAGES");
    QTest::newRow("blanks") << QByteArray("  \\  ");
    QTest::newRow("many components") << QByteArray("A\\").repeated(500);
  }
  void no_name_leads_out_of_the_folder() {
    QFETCH(QByteArray, name);
    const Disc outside;
    fs::rename(outside.folder / "images", outside.folder / "outside");
    const fs::path inside = outside.folder / "disc";
    fs::create_directory(inside);
    fs::create_directory(inside / "images");
    fs::copy_file(outside.folder / "outside/im1", inside / "images/im1");
    fs::create_symlink(outside.folder / "outside/im1", inside / "link");
    fs::create_directory_symlink(outside.folder / "outside", inside / "folder");
    test::write_bytes(inside / "DICOMDIR", test::directory_bytes(outside.series.uid, {name.toStdString()}));
    const auto found = imaging::find_series(inside / "DICOMDIR");
    QVERIFY(!found);
    QVERIFY2(found.error().message.find("none of which is there") != std::string::npos,
             found.error().message.c_str());
    QVERIFY(found.error().message.find('\n') == std::string::npos);
    QVERIFY(found.error().message.size() < 400 + inside.string().size());
  }

  void a_damaged_directory_is_refused_by_name_data() {
    const auto records = [](const std::string& value, const char* vr = "SQ") {
      return test::file(test::Dataset().put(0x00041220, test::element(0x00041220, vr, value)));
    };
    const std::string whole = test::directory_bytes("1.2.3", kAll);
    test::add_rows({
        {"no DICOM at all", "hello", "is neither a DICOM image"},
        {"cut off", whole.substr(0, whole.size() - 30), "DirectoryRecordSequence (0004,1220)"},
        {"no records", test::file(test::Dataset().put_text(0x00041130, "CS", "DISC")), "is missing"},
        {"records that are no items", records("abcdefgh"), "DirectoryRecordSequence (0004,1220)"},
        {"no record at all", records(""), "refers to no files"},
        {"a record without a name", records(test::directory_record("IMAGE", "")), "refers to no files"},
        {"an endless name",
         records(test::directory_record("IMAGE", test::text(0x00041500, "CS", std::string(60000, 'A')))),
         "refers to 1 files, none of which is there"},
    });
  }
  void a_damaged_directory_is_refused_by_name() {
    QFETCH(QByteArray, bytes);
    QFETCH(QString, field);
    const test::TemporaryFolder folder;
    test::write_bytes(folder / "DICOMDIR", bytes.toStdString());
    const auto found = imaging::find_series(folder / "DICOMDIR");
    QVERIFY(!found);
    const std::string& message = found.error().message;
    QVERIFY2(QString::fromStdString(message).contains(field), message.c_str());
    QVERIFY2(message.find("DICOMDIR") != std::string::npos, message.c_str());
    QVERIFY(message.find('\n') == std::string::npos);
  }

  // To ask DCMTK for each by its number takes longer than anybody waits.
  void a_directory_of_very_many_records_is_read_at_once() {
    const Disc disc;
    const std::string record = test::item(test::text(0x00041500, "CS", kAll[0]));
    std::string records;
    for (int n = 0; n < 120'000; ++n) records += record;
    const std::string all = test::element(0x00041220, "SQ", records);
    test::write_bytes(disc.directory(), test::file(test::Dataset().put(0x00041220, all)));
    QElapsedTimer timer;
    timer.start();
    const auto found = imaging::find_series(disc.directory());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.front().files.size(), std::size_t{1});
    QVERIFY2(timer.elapsed() < 10'000, qPrintable(QString::number(timer.elapsed())));
  }

  // Four megabytes each, of what takes long to read or much room to keep.
  void a_hostile_directory_is_read_at_once_data() {
    constexpr std::size_t kSize = 4'000'000;
    const auto repeated = [](const std::string& record) {
      std::string records;
      records.reserve(kSize + record.size());
      while (records.size() < kSize) records += record;
      return records;
    };
    const auto name = [](const std::string& value) { return test::text(0x00041500, "CS", value); };
    const std::string long_uid(60'000, '1');
    const std::string series = test::directory_record("SERIES", test::text(0x0020000e, "UI", long_uid));
    const std::string link = test::element(0x00041400, "UL", test::long_word(400)) +
                             test::element(0x00041420, "UL", test::long_word(400));
    QTest::addColumn<QByteArray>("records");
    QTest::addColumn<qint64>("missing");
    const auto add = [](const char* what, const std::string& records, std::size_t missing) {
      QTest::newRow(what) << QByteArray::fromStdString(records) << static_cast<qint64>(missing);
    };
    const auto count = [&](const std::string& record) { return (kSize + record.size() - 1) / record.size(); };
    const std::string backslashes = test::directory_record("IMAGE", name(std::string(60'000, '\\')));
    add("names of very many components", repeated(backslashes), count(backslashes));
    const std::string absent = test::item(name("IMAGES\\NO"));
    add("a long series UID before very many missing files", series + repeated(absent), count(absent));
    const std::string other = test::item(test::text(0x00041430, "CS", "SERIES") +
                                         test::text(0x0020000e, "UI", "1.2") + name("IMAGES\\NO"));
    add("very many series", repeated(other), count(other));
    add("very many long series UIDs", repeated(series), 0);
    const std::string circle = test::item(link + name(kAll[0]));
    add("records that point at one record", repeated(circle), 0);
    add("names within names",
        repeated(test::item(test::element(0x00041220, "SQ", test::item(name("IMAGES\\NO"))))), 0);
  }
  void a_hostile_directory_is_read_at_once() {
    QFETCH(QByteArray, records);
    QFETCH(qint64, missing);
    const Disc disc;
    const std::string one = test::item(test::text(0x00041500, "CS", kAll[0]));
    const std::string all = test::element(0x00041220, "SQ", one + records.toStdString());
    test::write_bytes(disc.directory(), test::file(test::Dataset().put(0x00041220, all)));
    QElapsedTimer timer;
    timer.start();
    const auto directory = imaging::read_media_directory(disc.directory());
    QVERIFY2(timer.elapsed() < 10'000, qPrintable(QString::number(timer.elapsed())));
    QCOMPARE(test::failure(directory), QString());
    QCOMPARE(directory->files.size(), std::size_t{1});
    QCOMPARE(qint64{directory->missing.count}, missing);
    QVERIFY(imaging::list_missing(directory->missing).size() < 400);
    for (const auto& [uid, of_series] : directory->missing_of_series) {
      QVERIFY(uid.size() <= 64 && of_series.first_names.size() <= 3);
    }
  }

  void reading_a_directory_says_how_far_it_is_and_can_be_stopped() {
    const Disc disc;
    std::string records;
    const std::string record = test::item(test::text(0x00041500, "CS", kAll[0]));
    for (int n = 0; n < 10'000; ++n) records += record;
    const std::string all = test::element(0x00041220, "SQ", records);
    test::write_bytes(disc.directory(), test::file(test::Dataset().put(0x00041220, all)));
    std::stop_source stop;
    std::vector<double> told;
    const Progress progress{[&](double fraction, std::string_view) {
                              told.push_back(fraction);
                              if (fraction > 0.5) stop.request_stop();
                            },
                            stop.get_token()};
    const auto directory = imaging::read_media_directory(disc.directory(), progress);
    QVERIFY(!directory);
    QCOMPARE(directory.error().kind, ErrorKind::cancelled);
    QVERIFY(told.size() > 5 && std::is_sorted(told.begin(), told.end()));
    QVERIFY(told.back() < 0.6);
    QVERIFY(imaging::find_series(disc.directory(), progress).error().kind == ErrorKind::cancelled);
    QVERIFY(imaging::find_series(disc.folder.path(), progress).error().kind == ErrorKind::cancelled);
  }

  void a_damaged_directory_does_not_hide_the_series_beside_it() {
    const Disc disc;
    test::write_bytes(disc.directory(), "hello");
    const auto found = imaging::find_series(disc.folder.path());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    QVERIFY(found->series[0].loadable);
    QCOMPARE(found->skipped.size(), std::size_t{2});
  }
};

TIDEMARK_TEST(MediaDirectoryTest)

}  // namespace tidemark::test::media_directory_test

#include "media_directory_test.moc"
