// A phantom goes to a real archive and comes back: stored, asked for, found, fetched both ways, compared.
#include <QTest>
#include <algorithm>
#include <cmath>

#include "imaging/dicom/dicom.h"
#include "imaging/load_study.h"
#include "imaging/pacs/services.h"
#include "imaging/phantom/phantom.h"
#include "imaging/results/measurement_report.h"
#include "imaging/results/results.h"
#include "tests/imaging/dicom/dicom_bytes.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/imaging/pacs/encodings.h"
#include "tests/imaging/pacs/three_studies.h"
#include "tests/support/test_program.h"

namespace tidemark::test::pacs_archive_test {

namespace {

constexpr const char* kPatient = "Ångström^José";
constexpr const char* kPatientId = "PACS-7";

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void write(const Volume& volume, const std::string& description, const std::filesystem::path& folder) {
  imaging::DicomSeriesHeader header;
  header.modality = volume.modality.empty() ? "MR" : volume.modality;
  header.patient_name = kPatient;
  header.patient_id = kPatientId;
  header.series_description = description;
  QCOMPARE(failure(imaging::write_dicom_series(volume, header, folder)), QString());
}

}  // namespace

class PacsArchiveTest : public QObject {
  Q_OBJECT

  static void each_archive() {
    QTest::addColumn<QString>("archive_name");
    QTest::newRow("Orthanc") << "orthanc";
    QTest::newRow("dcmqrscp") << "dcmqrscp";
  }
  static imaging::PacsLimits limits() {
    imaging::PacsLimits limits;
    limits.free_bytes = 1 << 20;
    return limits;
  }

  // dcmqrscp does not know what series are called.
  static void check_description(const QString& archive_name, const imaging::PacsSeries& series,
                                const char* wanted) {
    if (archive_name == "orthanc") QCOMPARE(QString::fromStdString(series.description), QString(wanted));
  }

 private slots:
  void a_series_comes_back_as_it_was_sent_data() { each_archive(); }
  void a_series_comes_back_as_it_was_sent() {
    QFETCH(QString, archive_name);
    const auto archive = start_archive(archive_name);
    const imaging::PacsServer server = archive->server();
    const auto echoed = imaging::pacs_echo(server);
    QCOMPARE(failure(echoed), QString());

    const auto phantom = imaging::make_phantom("sphere", {});
    QCOMPARE(failure(phantom), QString());
    const TemporaryFolder folder;
    write(phantom->volume, "The phantom", folder / "sent");
    const auto files = files_in(folder / "sent");
    const auto sent = imaging::send_files(server, files);
    QCOMPARE(failure(sent), QString());
    QCOMPARE(sent->objects, static_cast<std::int64_t>(files.size()));
    QVERIFY(sent->unsent.empty());

    imaging::StudyQuery query;
    query.patient_id = kPatientId;
    query.modality = phantom->volume.modality;
    const auto studies = imaging::find_studies(server, query);
    QCOMPARE(failure(studies), QString());
    QCOMPARE(studies->entries.size(), std::size_t{1});
    const imaging::PacsStudy& study = studies->entries.front();
    QCOMPARE(QString::fromStdString(study.patient_name), QString(kPatient));
    QCOMPARE(QString::fromStdString(imaging::readable_name(study.patient_name)), QString("Ångström, José"));
    QCOMPARE(QString::fromStdString(study.patient_id), QString(kPatientId));

    const auto series = imaging::find_pacs_series(server, {study.uid, phantom->volume.modality, {}});
    QCOMPARE(failure(series), QString());
    QCOMPARE(series->entries.size(), std::size_t{1});
    QCOMPARE(QString::fromStdString(series->entries.front().modality),
             QString::fromStdString(phantom->volume.modality));
    check_description(archive_name, series->entries.front(), "The phantom");

    for (const imaging::PacsServer& way : {server, archive->server_by_move()}) {
      const bool by_get = way.retrieve == imaging::PacsServer::Retrieve::get;
      const imaging::RetrieveRequest request{study.uid, series->entries.front().uid,
                                             folder / (by_get ? "get" : "move")};
      std::vector<double> fractions;
      Progress progress;
      progress.report = [&](double fraction, std::string_view) { fractions.push_back(fraction); };
      const auto retrieved = imaging::retrieve(way, request, limits(), progress);
      QCOMPARE(failure(retrieved), QString());
      QCOMPARE(retrieved->files.size(), files.size());
      QCOMPARE(retrieved->missing, 0);
      QVERIFY(retrieved->refused.empty());
      QVERIFY(!fractions.empty() && fractions.back() > 0.9);
      const auto loaded = imaging::load_volume(request.folder);
      QCOMPARE(failure(loaded), QString());
      QVERIFY(same_grid(loaded->geometry, phantom->volume.geometry, 1e-3));
      QVERIFY2(loaded->values() == phantom->volume.values(), by_get ? "by get" : "by move");
    }
  }

  void a_result_is_sent_and_found_there_data() { each_archive(); }
  void a_result_is_sent_and_found_there() {
    QFETCH(QString, archive_name);
    const auto archive = start_archive(archive_name);
    const auto phantom = imaging::make_phantom("sphere", {});
    QCOMPARE(failure(phantom), QString());
    Volume result;
    result.geometry = phantom->truth.geometry;
    result.voxels = std::vector<std::uint16_t>(phantom->truth.voxels.begin(), phantom->truth.voxels.end());
    const TemporaryFolder folder;
    write(result, "Segmented", folder / "result");
    const auto sent = imaging::send_files(archive->server(), files_in(folder / "result"));
    QCOMPARE(failure(sent), QString());
    QVERIFY(sent->unsent.empty());
    imaging::StudyQuery query;
    query.patient_name = "Ångström*";
    const auto studies = imaging::find_studies(archive->server(), query);
    QCOMPARE(failure(studies), QString());
    QCOMPARE(studies->entries.size(), std::size_t{1});
    const auto series = imaging::find_pacs_series(archive->server(), {studies->entries.front().uid, {}, {}});
    QCOMPARE(failure(series), QString());
    QCOMPARE(series->entries.size(), std::size_t{1});
    check_description(archive_name, series->entries.front(), "Segmented");
  }

  void a_segmentation_and_its_report_are_sent_and_found_there_data() { each_archive(); }
  void a_segmentation_and_its_report_are_sent_and_found_there() {
    QFETCH(QString, archive_name);
    const auto archive = start_archive(archive_name);
    const auto phantom = imaging::make_phantom("sphere", {});
    QCOMPARE(failure(phantom), QString());
    const TemporaryFolder folder;
    write(phantom->volume, "Phantom", folder / "series");
    const auto images = files_in(folder / "series");
    const auto segmentation = folder / "seg.dcm";
    const auto report = folder / "report.dcm";
    QCOMPARE(failure(imaging::write_segmentation(imaging::segments_of(phantom->truth, "Ball"), images,
                                                 segmentation)),
             QString());
    const imaging::ReportedMeasure volume{
        {"118565006", "SCT", "Volume"}, 4.2, {"cm3", "UCUM", "cubic centimeter"}, {}};
    QCOMPARE(failure(imaging::write_measurement_report(segmentation, {{0, {volume}}}, "CT", report)),
             QString());
    const auto sent = imaging::send_files(archive->server(), {segmentation, report});
    QCOMPARE(failure(sent), QString());
    QVERIFY(sent->unsent.empty());
    const auto series = imaging::find_pacs_series(archive->server(), {imaging::study_uid_of(report), {}, {}});
    QCOMPARE(failure(series), QString());
    std::vector<std::string> modalities;
    for (const imaging::PacsSeries& one : series->entries) modalities.push_back(one.modality);
    std::sort(modalities.begin(), modalities.end());
    QVERIFY(modalities == (std::vector<std::string>{"SEG", "SR"}));
  }

  void a_query_narrows_by_date_modality_and_description_data() { each_archive(); }
  void a_query_narrows_by_date_modality_and_description() {
    QFETCH(QString, archive_name);
    const auto archive = start_archive(archive_name);
    send_three_studies(archive->server());
    // dcmqrscp does not know which modalities a study has.
    find_some_of_three_studies(archive->server(), archive_name == "orthanc");
  }

  void compressed_files_are_sent_as_they_are_or_refused_by_name() {
    const TemporaryFolder folder;
    const auto files = write_series(sample_volume({16, 16, 2}), folder / "plain");
    const auto packed = folder / "packed.dcm";
    compress_by_rle(files.front(), packed);
    const StoringPeer plain_only({"+x="});
    const auto refused = imaging::send_files(plain_only.server(), {packed, files.back()});
    QCOMPARE(failure(refused), QString());
    QCOMPARE(refused->objects, 1);
    QCOMPARE(refused->unsent.size(), std::size_t{1});
    QCOMPARE(refused->unsent.front().file, packed);
    QVERIFY(QString::fromStdString(refused->unsent.front().reason).contains("RLE"));

    const StoringPeer all({"+xa"});
    const auto sent = imaging::send_files(all.server(), {packed});
    QCOMPARE(failure(sent), QString());
    QCOMPARE(sent->objects, 1);
    const auto received = files_in(all.received());
    QCOMPARE(received.size(), std::size_t{1});
    QCOMPARE(syntax_of(received.front()), syntax_of(packed));
  }

  // In the explicit form they would be bytes of an unknown representation.
  void contours_of_very_many_points_stay_what_they_are() {
    const TemporaryFolder folder;
    Geometry geometry;
    geometry.size = {300, 300, 1};
    std::vector<std::uint8_t> comb(90000);
    for (std::size_t v = 0; v < comb.size(); ++v) comb[v] = v / 300 == 0 || v % 300 % 2 == 0 ? 1 : 0;
    imaging::Segment segment;
    segment.slices[0] = comb;
    QCOMPARE(failure(imaging::write_structure_set({geometry, {segment}, {}}, {}, folder / "set.dcm")),
             QString());
    const StoringPeer peer({"+x="});  // rather takes the explicit form
    const auto sent = imaging::send_files(peer.server(), {folder / "set.dcm"});
    QCOMPARE(failure(sent), QString());
    QCOMPARE(sent->objects, 1);
    const auto received = files_in(peer.received());
    QCOMPARE(received.size(), std::size_t{1});
    QCOMPARE(syntax_of(received.front()), syntax_of(folder / "set.dcm"));
    const auto read = imaging::read_structure_set(received.front(), geometry);
    QCOMPARE(failure(read), QString());
    QVERIFY(read->list[0].slices == segment.slices);
  }

  void an_archive_with_compressed_objects_sends_them_as_they_are_data() {
    QTest::addColumn<bool>("by_get");
    QTest::newRow("by get") << true;
    QTest::newRow("by move") << false;
  }
  void an_archive_with_compressed_objects_sends_them_as_they_are() {
    QFETCH(bool, by_get);
    const auto archive = start_orthanc();  // dcmqrscp sends all of a class in one encoding
    const TemporaryFolder folder;
    const Volume volume = sample_volume({16, 16, 3});
    const auto files = write_series(volume, folder / "plain");
    for (const auto& file : files) compress_by_rle(file, file);
    QCOMPARE(failure(imaging::send_files(archive->server(), files)), QString());
    const auto studies = imaging::find_studies(archive->server(), {});
    QCOMPARE(failure(studies), QString());
    const imaging::PacsServer server = by_get ? archive->server() : archive->server_by_move();
    const auto retrieved =
        imaging::retrieve(server, {studies->entries.at(0).uid, {}, folder / "back"}, limits());
    QCOMPARE(failure(retrieved), QString());
    QCOMPARE(retrieved->files.size(), files.size());
    QCOMPARE(syntax_of(retrieved->files.front()), syntax_of(files.front()));
    const auto loaded = imaging::load_volume(folder / "back");
    QCOMPARE(failure(loaded), QString());
    QVERIFY(loaded->values() == volume.values());
  }

  void files_that_are_no_dicom_are_named_and_the_others_sent() {
    const StoringPeer peer({"+xa"});
    const TemporaryFolder folder;
    const auto files = write_series(sample_volume({4, 4, 2}), folder / "series");
    QFile note(QString::fromStdString((folder / "note.txt").string()));
    QVERIFY(note.open(QIODevice::WriteOnly) && note.write("not DICOM") > 0);
    note.close();
    const auto sent = imaging::send_files(peer.server(), {folder / "note.txt", files[0], files[1]});
    QCOMPARE(failure(sent), QString());
    QCOMPARE(sent->objects, 2);
    QCOMPARE(sent->unsent.size(), std::size_t{1});
    QCOMPARE(QString::fromStdString(sent->unsent.front().reason), QString("is not a DICOM file"));
  }

  void a_file_that_ends_in_its_middle_is_named_and_the_others_sent() {
    const StoringPeer peer({"+xa"});
    const TemporaryFolder folder;
    const auto files = write_series(sample_volume({16, 16, 3}), folder / "series");
    truncate(files[1], std::filesystem::file_size(files[1]) - 100);
    const auto sent = imaging::send_files(peer.server(), files);
    QCOMPARE(failure(sent), QString());
    QCOMPARE(sent->objects, 2);
    QCOMPARE(sent->unsent.size(), std::size_t{1});
    QCOMPARE(sent->unsent.front().file, files[1]);
    QVERIFY2(sent->unsent.front().reason.find("(7FE0,0010)") != std::string::npos,
             sent->unsent.front().reason.c_str());
  }

  void a_file_that_is_replaced_after_it_was_looked_into_is_not_sent_unseen_data() {
    QTest::addColumn<QByteArray>("second");
    QTest::addColumn<QString>("reason");
    Dataset other = Dataset::slice();
    QTest::newRow("another image") << QByteArray::fromStdString(file(other))
                                   << "it is not what it was a moment ago";
    QTest::newRow("sequences without end")
        << QByteArray::fromStdString(file(other.put(0x00081140, nested(100'000, "SQ", kExplicit, false))))
        << "lies in more than 64 sequences";
  }
  void a_file_that_is_replaced_after_it_was_looked_into_is_not_sent_unseen() {
    QFETCH(QByteArray, second);
    QFETCH(QString, reason);
    const StoringPeer peer({"+xa"});
    const TemporaryFolder folder;
    const auto files = write_series(sample_volume({4, 4, 3}), folder / "series");
    // The first object that is sent says so, when all have been looked into.
    bool is_replaced = false;
    const Progress progress{
        [&](double, std::string_view what) {
          if (std::exchange(is_replaced, is_replaced || what == "sending objects") || !is_replaced) return;
          write_bytes(folder / "other.dcm", second.toStdString());
          std::filesystem::rename(folder / "other.dcm", files[2]);
        },
        {}};
    const auto sent = imaging::send_files(peer.server(), files, progress);
    QCOMPARE(failure(sent), QString());
    QVERIFY(is_replaced);
    QCOMPARE(sent->objects, 2);
    QCOMPARE(sent->unsent.size(), std::size_t{1});
    QCOMPARE(sent->unsent.front().file, files[2]);
    QVERIFY2(QString::fromStdString(sent->unsent.front().reason).contains(reason),
             sent->unsent.front().reason.c_str());
  }

  void a_study_that_is_not_there_leaves_no_folder_data() { each_archive(); }
  void a_study_that_is_not_there_leaves_no_folder() {
    QFETCH(QString, archive_name);
    const auto archive = start_archive(archive_name);
    const TemporaryFolder folder;
    for (const imaging::PacsServer& way : {archive->server(), archive->server_by_move()}) {
      const auto retrieved = imaging::retrieve(way, {"1.2.3.4", {}, folder / "none"}, limits());
      QVERIFY(!retrieved);
      QCOMPARE(retrieved.error().kind, ErrorKind::input);
      QVERIFY(!std::filesystem::exists(folder / "none"));
    }
  }

  void a_folder_with_something_in_it_is_not_filled() {
    const TemporaryFolder folder;
    write_series(sample_volume({4, 4, 2}), folder / "full");
    const auto before = files_in(folder / "full");
    imaging::PacsServer server;
    server.name = "nobody";
    server.host = "localhost";
    server.ae_title = "NOBODY";
    server.port = free_port();
    const auto retrieved = imaging::retrieve(server, {"1.2.3.4", {}, folder / "full"}, limits());
    QVERIFY(!retrieved);
    QCOMPARE(retrieved.error().kind, ErrorKind::write);
    QVERIFY(files_in(folder / "full") == before);
  }

  void a_server_that_is_called_otherwise_says_so() {
    const auto archive = start_orthanc();
    imaging::PacsServer server = archive->server();
    server.ae_title = "WRONG";
    const auto echoed = imaging::pacs_echo(server);
    QVERIFY(!echoed);
    QVERIFY2(echoed.error().message.find("it is not called 'WRONG' (ae_title)") != std::string::npos,
             echoed.error().message.c_str());
  }

  void a_server_that_does_not_know_where_to_send_says_so() {
    const auto archive = start_dcmqrscp();
    const TemporaryFolder folder;
    QCOMPARE(
        failure(imaging::send_files(archive->server(), write_series(sample_volume({4, 4, 2}), folder / "s"))),
        QString());
    const auto studies = imaging::find_studies(archive->server(), {});
    QCOMPARE(failure(studies), QString());
    imaging::PacsServer server = archive->server_by_move();
    server.own_ae_title = "STRANGER";
    const auto retrieved =
        imaging::retrieve(server, {studies->entries.at(0).uid, {}, folder / "back"}, limits());
    QVERIFY(!retrieved);
    QVERIFY2(retrieved.error().message.find("does not know where to send to") != std::string::npos,
             retrieved.error().message.c_str());
  }
};

TIDEMARK_TEST(PacsArchiveTest)

}  // namespace tidemark::test::pacs_archive_test

#include "pacs_archive_test.moc"
