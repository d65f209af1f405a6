// Studies in zip archives: what is unpacked, how long it stays, and archives that mean harm.
#include <zip.h>

#include <QElapsedTimer>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>

#include "imaging/archive/private_folder.h"
#include "imaging/archive/study_archive.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/imaging/dicom/dicom_bytes.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/child_process.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::study_archive_test {

namespace fs = std::filesystem;

namespace {

struct Entry {
  std::string name;
  std::string bytes;
};

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_archive(const fs::path& file, const std::vector<Entry>& entries, const char* password = nullptr) {
  zip_t* archive = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  for (const Entry& entry : entries) {
    zip_source_t* source = zip_source_buffer(archive, entry.bytes.data(), entry.bytes.size(), 0);
    const zip_int64_t index = zip_file_add(archive, entry.name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) qFatal("%s", zip_strerror(archive));
    if (password != nullptr) {
      zip_file_set_encryption(archive, static_cast<zip_uint64_t>(index), ZIP_EM_AES_256, password);
    }
  }
  if (zip_close(archive) != 0) qFatal("%s", zip_strerror(archive));
}

// The files of a series, in a folder of the archive.
std::vector<Entry> entries_of(const Volume& volume, const std::string& within = "document/series/") {
  const test::TemporaryFolder folder;
  std::vector<Entry> entries;
  for (const fs::path& file : test::write_series(volume, folder / "series")) {
    entries.push_back({within + file.filename().string(), contents(file)});
  }
  return entries;
}

std::size_t private_folders(const fs::path& parent) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(parent)) {
    if (entry.path().filename().string().starts_with("tidemark-study-")) ++count;
  }
  return count;
}

bool holds(const std::string& message, const char* part) {
  return message.find(part) != std::string::npos;
}

// An archive of one entry with other bytes in its directory: in the entry's record, or in the directory's
// end.
std::string with(std::string archive, const char* mark, std::size_t at, const std::string& bytes) {
  return archive.replace(archive.find(mark) + at, bytes.size(), bytes);
}
constexpr const char* kRecord = "PK\x01\x02";
constexpr const char* kEnd = "PK\x05\x06";

std::string little(std::uint64_t number, int bytes) {
  std::string text;
  for (; bytes > 0; --bytes, number >>= 8U) text += static_cast<char>(number & 0xffU);
  return text;
}

// What the two headers of an uncompressed entry "a" share.
std::string header_of(std::uint64_t packed, std::uint64_t extra) {
  return std::string("\x14\0\0\0\0\0\0\0\0\0", 10) + little(0, 4) + little(packed, 4) + little(packed, 4) +
         little(1, 2) + little(extra, 2);
}

// Of an entry "a" that begins there.
std::string record_of(std::uint64_t begin, std::uint64_t packed) {
  return std::string("PK\1\2\x14\0", 6) + header_of(packed, 0) + little(0, 10) + little(begin, 4) + "a";
}

std::string entry_of(std::uint64_t packed, std::uint64_t extra = 0) {
  return "PK\3\4" + header_of(packed, extra) + "a";
}

// An archive of those entries and records. The number of records is what 16 bits leave of it.
std::string archive_of(const std::string& entries, const std::vector<std::string>& records) {
  std::string bytes = entries;
  for (const std::string& record : records) bytes += record;
  return bytes + std::string("PK\5\6\0\0\0\0", 8) + little(records.size(), 2) + little(records.size(), 2) +
         little(bytes.size() - entries.size(), 4) + little(entries.size(), 4) + little(0, 2);
}

// The end of a 64-bit directory that states a trillion entries.
std::string trillion_entries() {
  std::string end = std::string("PK\x06\x06\x2c\0\0\0\0\0\0\0\x2d\0\x2d\0\0\0\0\0\0\0\0\0", 24);
  for (int i = 0; i < 2; ++i) end += std::string("\0\0\0\0\0\1\0\0", 8);  // entries
  end += std::string("\0\x10\0\0\0\0\0\0\4\0\0\0\0\0\0\0", 16);           // bytes and begin of the directory
  end += std::string("PK\x06\x07\0\0\0\0\4\0\0\0\0\0\0\0\1\0\0\0", 20);
  end += std::string("PK\x05\x06\0\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\0\0", 22);
  return std::string("PK\x03\x04", 4) + end;
}

}  // namespace

class StudyArchiveTest : public QObject {
  Q_OBJECT

  // Where archives are unpacked to, so that what is left can be counted.
  std::unique_ptr<test::TemporaryFolder> temporary_;
  const Volume sample_ = test::sample_volume({7, 6, 4});

 private slots:
  void init() {
    temporary_ = std::make_unique<test::TemporaryFolder>();
    qputenv("TMPDIR", QByteArray::fromStdString(temporary_->path().string()));
  }
  void cleanup() {
    QCOMPARE(private_folders(temporary_->path()), std::size_t{0});
    qunsetenv("TMPDIR");
  }

  void an_archive_opens_like_a_folder() {
    const test::TemporaryFolder folder;
    std::vector<Entry> entries = entries_of(sample_);
    entries.push_back({"document/readme.txt", "hello"});
    QVERIFY(imaging::write_volume_file(sample_, folder / "a.nii.gz"));
    entries.push_back({"a.nii.gz", contents(folder / "a.nii.gz")});
    entries.push_back({"more.ZIP", "PK"});
    write_archive(folder / "study.zip", entries);

    const auto found = imaging::find_series(folder / "study.zip");
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{2});
    for (const imaging::Series& series : found->series) {
      QVERIFY2(series.loadable, series.reason.c_str());
      const auto volume = imaging::load_series(series);
      QCOMPARE(test::failure(volume), QString());
      QVERIFY(volume->voxels == sample_.voxels);
    }
    QCOMPARE(found->skipped.size(), std::size_t{2});
    QVERIFY(holds(found->skipped[0].file.string(), "study.zip/"));
    QVERIFY(holds(found->skipped[0].file.string(), "readme.txt"));
    QVERIFY(holds(found->skipped[1].reason, "an archive within the archive"));
  }

  void its_files_stay_as_long_as_a_series_is_held() {
    const test::TemporaryFolder folder;
    write_archive(folder / "study.zip", entries_of(sample_));
    std::optional<imaging::Series> series;
    {
      const auto found = imaging::find_series(folder / "study.zip");
      QCOMPARE(test::failure(found), QString());
      series = found->series.front();
    }
    fs::remove(folder / "study.zip");
    QCOMPARE(private_folders(temporary_->path()), std::size_t{1});
    for (const fs::path& file : imaging::dicom_files_of(*series)) QVERIFY(fs::exists(file));
    const auto volume = imaging::load_series(*series);
    QCOMPARE(test::failure(volume), QString());
    const fs::path gone = series->files.front();
    series.reset();
    QVERIFY(!fs::exists(gone));
    QVERIFY(volume->voxels == sample_.voxels);  // needs no file any more
  }

  void a_loaded_series_is_found_again_under_the_same_uid() {
    const test::TemporaryFolder folder;
    QVERIFY(imaging::write_volume_file(sample_, folder / "a.nrrd"));
    write_archive(folder / "study.zip", {{"x/b.nrrd", contents(folder / "a.nrrd")}});
    const auto first = imaging::load_with_series(folder / "study.zip");
    QCOMPARE(test::failure(first), QString());
    const auto again = imaging::load_with_series(folder / "study.zip", first->series.uid);
    QCOMPARE(test::failure(again), QString());
  }

  void names_in_an_archive_lead_nowhere() {
    const test::TemporaryFolder folder;
    std::vector<Entry> entries = entries_of(sample_, "../../../outside/");
    entries[0].name = "/absolute/slice";
    entries[1].name = "..";
    entries[2].name = "a\\..\\..\\b:c\n*?\"<>|";
    write_archive(folder / "study.zip", entries);
    const auto found = imaging::find_series(folder / "study.zip");
    QCOMPARE(test::failure(found), QString());
    std::size_t files = 0;
    for (const imaging::Series& series : found->series) files += series.files.size();
    QCOMPARE(files, entries.size());
    const auto is_harmless = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr("-._", c) != nullptr;
    };
    for (const auto& entry : fs::recursive_directory_iterator(found->series.front().archive->folder())) {
      const std::string name = entry.path().filename().string();
      QVERIFY2(std::all_of(name.begin(), name.end(), is_harmless), name.c_str());
    }
    // The folder of this test and that of the archive.
    QCOMPARE(std::distance(fs::directory_iterator(temporary_->path()), fs::directory_iterator()), 2);
  }

  void an_archive_that_cannot_be_used_is_refused_in_one_line_data() {
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<QString>("why");
    const test::TemporaryFolder folder;
    const fs::path file = folder / "a.zip";
    const auto row = [&](const char* name, const std::string& bytes, const char* why) {
      QTest::newRow(name) << QByteArray::fromStdString(bytes) << QString(why);
    };
    write_archive(file, entries_of(sample_));
    const std::string whole = contents(file);
    row("cut off", whole.substr(0, whole.size() / 2), "is damaged: its directory is missing");
    std::string flipped = whole;
    flipped[200] = static_cast<char>(flipped[200] ^ 0x10);
    row("a wrong bit in an entry", flipped, "is damaged");
    write_archive(file, entries_of(sample_), "secret");
    row("encrypted", contents(file), "is encrypted");
    row("its first bytes alone", std::string("PK\x03\x04", 4), "is damaged: its directory is missing");
    row("no entries", std::string("PK\x05\x06", 4) + std::string(18, '\0'), "holds no DICOM series");
    write_archive(file, {{"a.txt", "hello"}});
    const std::string text = contents(file);
    row("no study", text, "holds no DICOM series, volume file or picture");
    write_archive(file, {{"a.txt", "hello"}, {"b.txt", "hello"}});
    const std::string two = contents(file);
    const auto size = [&](const std::string& bytes) { return with(text, kRecord, 24, bytes); };
    row("two gigabytes in a few bytes", size("\xff\xff\xff\x7f"), "times its size");
    row("an entry that is longer than it says", size(std::string("\4\0\0\0", 4)), "holds more than it says");
    row("an entry that is shorter than it says", size(std::string("\x50\0\0\0", 4)),
        "holds less than it says");
    row("an entry with another checksum", with(text, kRecord, 16, "abcd"), "its checksum is another one");
    row("an entry larger than the archive", with(text, kRecord, 20, "\xff\xff\xff\x7f"), "beyond its end");
    row("an entry of 64 bits that are nowhere", with(text, kRecord, 20, "\xff\xff\xff\xff"),
        "beyond its end");
    row("an entry that is none", with(two, "hello", 5, "QK"), "is not where the directory says");
    row("an entry within the one before it", with(text, kRecord, 42, "\1"), "its entries overlap");
    row("one entry for two records", archive_of(entry_of(0), {record_of(0, 0), record_of(0, 0)}),
        "its entries overlap");
    row("an entry that holds the next one's header",
        archive_of(entry_of(31) + entry_of(0), {record_of(0, 31), record_of(31, 0)}), "its entries overlap");
    row("records in another order than the entries, which overlap",
        archive_of(entry_of(31) + entry_of(0), {record_of(31, 0), record_of(0, 31)}), "its entries overlap");
    row("an entry that holds the directory", archive_of(entry_of(40), {record_of(0, 40)}),
        "its entries overlap");
    row("an entry whose own header reaches into the next one",
        archive_of(entry_of(4, 4) + "1234" + entry_of(0), {record_of(0, 4), record_of(35, 0)}),
        "reaches into the next entry");
    row("an entry of bzip2", with(text, kRecord, 10, "\x0c"), "is not read (a.txt, method 12)");
    row("an entry of deflate that is none", with(text, kRecord, 10, "\x08"), "is damaged: a.txt");
    row("a longer name than there is", with(text, kRecord, 28, "\xff\xff"), "its directory is cut off");
    row("a directory that begins late", with(text, kEnd, 16, "\xff\xff"), "its directory is not whole");
    row("a directory of other bytes", with(text, kEnd, 16, std::string(1, '\0')), "its directory is cut off");
    row("more entries than there are", with(text, kEnd, 10, "\2"), "holds 1 entries instead of 2");
    row("a trillion entries", trillion_entries(), "its directory is not whole");
  }

  void an_archive_that_cannot_be_used_is_refused_in_one_line() {
    QFETCH(QByteArray, bytes);
    QFETCH(QString, why);
    const test::TemporaryFolder folder;
    test::write_bytes(folder / "study.zip", bytes.toStdString());
    const auto found = imaging::find_series(folder / "study.zip");
    QVERIFY(!found);
    const QString message = QString::fromStdString(found.error().message);
    QVERIFY2(message.startsWith(QString::fromStdString((folder / "study.zip").string())),
             qPrintable(message));
    QVERIFY2(message.contains(why), qPrintable(message));
    QVERIFY2(!message.contains('\n') && !message.contains("tidemark-study-"), qPrintable(message));
  }

  void many_entries_in_few_bytes_are_refused_at_once_data() {
    QTest::addColumn<int>("records");
    QTest::addColumn<QString>("why");
    QTest::newRow("as many as there may be") << 50'000 << "its entries overlap";
    QTest::newRow("more than there may be") << 65'534 << "has 65534 entries, more than 50000";
    QTest::newRow("more than 16 bits count") << 180'000 << "has more than 50000 entries";
  }

  void many_entries_in_few_bytes_are_refused_at_once() {
    QFETCH(int, records);
    QFETCH(QString, why);
    const test::TemporaryFolder folder;
    const std::string bytes =
        archive_of(entry_of(0), std::vector<std::string>(static_cast<std::size_t>(records), record_of(0, 0)));
    test::write_bytes(folder / "study.zip", bytes);
    QElapsedTimer timer;
    timer.start();
    const auto ended = test::run_in_child(
        [&]() -> Status {
          const auto found = imaging::find_series(folder / "study.zip");
          return found ? Status() : pass_on(found);
        },
        {.more_memory = static_cast<std::int64_t>(bytes.size()) + (std::int64_t{64} << 20)});
    QVERIFY2(ended.failure.find(why.toStdString()) != std::string::npos, ended.failure.c_str());
    QVERIFY2(timer.elapsed() < 1000, qPrintable(QString::number(timer.elapsed()) + " ms"));
  }

  // Each is an entry of its own, with bytes of its own, and no lie about it.
  void many_empty_files_are_told_in_one_line_at_once_data() {
    QTest::addColumn<int>("count");
    QTest::addColumn<QString>("why");
    QTest::newRow("as many as there may be") << 50'000 << "holds no DICOM series, volume file or picture";
    QTest::newRow("more") << 65'534 << "has 65534 entries, more than 50000";
  }

  void many_empty_files_are_told_in_one_line_at_once() {
    QFETCH(int, count);
    QFETCH(QString, why);
    std::string entries;
    std::vector<std::string> records;
    for (int n = 0; n < count; ++n) {
      records.push_back(record_of(entries.size(), 0));
      entries += entry_of(0);
    }
    const test::TemporaryFolder folder;
    test::write_bytes(folder / "study.zip", archive_of(entries, records));
    QElapsedTimer timer;
    timer.start();
    const auto found = imaging::find_series(folder / "study.zip");
    QVERIFY2(timer.elapsed() < 1000, qPrintable(QString::number(timer.elapsed()) + " ms"));
    QVERIFY(!found);
    QVERIFY2(holds(found.error().message, why.toUtf8()), found.error().message.c_str());
  }

  void empty_files_beside_a_study_are_counted() {
    const test::TemporaryFolder folder;
    std::vector<Entry> entries = entries_of(sample_);
    entries.push_back({"document/series/.keep", ""});
    entries.push_back({"notes.txt", ""});
    write_archive(folder / "study.zip", entries);
    const auto found = imaging::find_series(folder / "study.zip");
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    QCOMPARE(found->skipped.size(), std::size_t{1});
    QVERIFY(holds(found->skipped.front().reason, "holds 2 empty files"));
  }

  void thousands_of_small_files_are_a_study() {
    const test::TemporaryFolder folder;
    std::vector<Entry> entries = entries_of(sample_);
    constexpr std::size_t kOthers = 5000;
    for (std::size_t i = 0; i < kOthers; ++i) entries.push_back({fmt::format("notes/{}.txt", i), "x"});
    for (std::size_t i = 0; i < 200; ++i) entries.push_back({fmt::format("more/{}.zip", i), "PK"});
    write_archive(folder / "study.zip", entries);
    const auto found = imaging::find_series(folder / "study.zip");
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    const auto volume = imaging::load_series(found->series.front());
    QCOMPARE(test::failure(volume), QString());
    QVERIFY(volume->voxels == sample_.voxels);
    // The archives are named as far as someone might read on.
    QCOMPARE(found->skipped.size(), kOthers + 101);
    QVERIFY(holds(found->skipped.back().reason, "holds 100 more archives"));
  }

  void an_error_of_a_file_names_the_archive() {
    const test::TemporaryFolder folder;
    std::vector<Entry> entries = entries_of(sample_);
    entries[1].bytes.resize(entries[1].bytes.size() - 20);
    write_archive(folder / "study.zip", entries);
    const auto volume = imaging::load_volume(folder / "study.zip");
    QVERIFY(!volume);
    QVERIFY2(holds(volume.error().message, "study.zip: "), volume.error().message.c_str());
    QVERIFY2(!holds(volume.error().message, "tidemark-study-"), volume.error().message.c_str());
  }

  void an_archive_in_a_folder_is_not_opened() {
    const test::TemporaryFolder folder;
    test::write_series(sample_, folder / "series");
    write_archive(folder / "other.zip", entries_of(sample_));
    const auto found = imaging::find_series(folder.path());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    QCOMPARE(found->skipped.size(), std::size_t{1});
    QVERIFY(holds(found->skipped[0].reason, "is a zip archive"));
  }

  void without_room_to_unpack_a_write_has_failed() {
    const test::TemporaryFolder folder;
    write_archive(folder / "study.zip", {{"a.txt", std::string(100'000, 'x')}});
    const auto ended = test::run_in_child(
        [&]() -> Status {
          const auto found = imaging::find_series(folder / "study.zip");
          if (found) return {};
          const bool is_write = found.error().kind == ErrorKind::write;
          return fail(found.error().kind, "{}: {}", is_write ? "write" : "else", found.error().message);
        },
        {.largest_file = 5000, .is_fatal = false});
    QVERIFY2(ended.failure.starts_with("write: "), ended.failure.c_str());
    QVERIFY2(holds(ended.failure, "study.zip: there is no room to unpack it"), ended.failure.c_str());
  }

  void unpacking_can_be_given_up() {
    const test::TemporaryFolder folder;
    write_archive(folder / "study.zip", entries_of(sample_));
    std::stop_source stop;
    Progress progress;
    progress.stop = stop.get_token();
    int reports = 0;
    progress.report = [&](double fraction, std::string_view what) {
      QVERIFY(fraction >= 0.0 && fraction <= 1.0);
      QCOMPARE(std::string(what), std::string("unpacking the archive"));
      if (++reports == 2) stop.request_stop();
    };
    const auto found = imaging::find_series(folder / "study.zip", progress);
    QVERIFY(!found);
    QCOMPARE(found.error().kind, ErrorKind::cancelled);
    QCOMPARE(reports, 2);
  }

  void what_a_killed_program_unpacked_is_swept() {
    const fs::path left = temporary_->path() / "tidemark-study-abcdef";
    fs::create_directories(left / "files/0001");
    test::write_bytes(left / "files/0001/slice", "x");
    test::write_bytes(left / "lock", "");
    const fs::path young = temporary_->path() / "tidemark-study-young";
    fs::create_directory(young);
    const fs::path old = temporary_->path() / "tidemark-study-old";
    fs::create_directory(old);
    fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(1));
    const test::TemporaryFolder elsewhere;
    test::write_bytes(elsewhere / "keep", "x");
    fs::create_directory_symlink(elsewhere.path(), temporary_->path() / "tidemark-study-link");
    {
      const auto held = imaging::PrivateFolder::create();
      QCOMPARE(test::failure(held), QString());
      imaging::sweep_private_folders(temporary_->path());
      QVERIFY(fs::exists(held->path()));  // is in use
    }
    QVERIFY(!fs::exists(left));
    QVERIFY(!fs::exists(old));
    QVERIFY(fs::exists(young));               // is being made
    QVERIFY(fs::exists(elsewhere / "keep"));  // a link is none of ours
    fs::remove(young);
    fs::remove(temporary_->path() / "tidemark-study-link");
  }
};

TIDEMARK_TEST(StudyArchiveTest)

}  // namespace tidemark::test::study_archive_test

#include "study_archive_test.moc"
