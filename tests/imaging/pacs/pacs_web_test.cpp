// DICOMweb with a real archive: sent, asked for, found and fetched, with passwords and certificates.
#include <QFile>
#include <QScopeGuard>
#include <QTest>
#include <algorithm>

#include "imaging/load_study.h"
#include "imaging/pacs/services.h"
#include "imaging/phantom/phantom.h"
#include "imaging/results/measurement_report.h"
#include "imaging/results/results.h"
#include "tests/imaging/dicom/dicom_bytes.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/imaging/pacs/certificates.h"
#include "tests/imaging/pacs/encodings.h"
#include "tests/imaging/pacs/three_studies.h"
#include "tests/support/test_program.h"

namespace tidemark::test::pacs_web_test {

class PacsWebTest : public QObject {
  Q_OBJECT

  static QString said(const Result<double>& echoed) {
    return echoed ? "it answers" : QString::fromStdString(echoed.error().message);
  }

  static imaging::PacsLimits limits() {
    imaging::PacsLimits limits;
    limits.free_bytes = 1 << 20;
    return limits;
  }

 private slots:
  void a_series_comes_back_as_it_was_sent() {
    const WebArchive archive(nullptr, "");
    const imaging::PacsServer web = archive.web_server();
    QCOMPARE(failure(imaging::pacs_echo(web)), QString());
    const TemporaryFolder folder;
    const Volume volume = sample_volume({64, 48, 7});
    const auto files = write_series(volume, folder / "sent", "MR");
    for (const auto& file : files) {
      set_text(file, 0x0008, 0x0005, "ISO_IR 192");
      set_text(file, 0x0010, 0x0010, "Ångström^José=山田^太郎=やまだ^たろう");
      set_text(file, 0x0010, 0x0020, "WEB-7");
      set_text(file, 0x0008, 0x0020, "20250115");
      set_text(file, 0x0008, 0x1030, "Study");
      set_text(file, 0x0008, 0x103e, "A series");
    }
    const auto sent = imaging::send_files(web, files);
    QCOMPARE(failure(sent), QString());
    QCOMPARE(sent->objects, static_cast<std::int64_t>(files.size()));
    QVERIFY(sent->unsent.empty());

    // By both ways the same is found.
    for (const imaging::PacsServer& server : {web, archive.server()}) {
      imaging::StudyQuery query;
      query.patient_id = "WEB-7";
      query.modality = "MR";
      query.date_from = "2025-01-01";
      query.description = "Stud*";
      const auto studies = imaging::find_studies(server, query);
      QCOMPARE(failure(studies), QString());
      QCOMPARE(studies->entries.size(), std::size_t{1});
      QVERIFY(!studies->more);
      const imaging::PacsStudy& study = studies->entries.front();
      QCOMPARE(QString::fromStdString(study.patient_name), QString("Ångström^José=山田^太郎=やまだ^たろう"));
      QCOMPARE(QString::fromStdString(study.patient_id), QString("WEB-7"));
      QCOMPARE(QString::fromStdString(study.date), QString("2025-01-15"));
      QCOMPARE(QString::fromStdString(study.description), QString("Study"));
      QVERIFY(study.modalities == std::vector<std::string>{"MR"});
      QCOMPARE(study.series.value_or(-1), 1);
      QCOMPARE(study.objects.value_or(-1), 7);
      const auto series = imaging::find_pacs_series(server, {study.uid, "MR", {}});
      QCOMPARE(failure(series), QString());
      QCOMPARE(series->entries.size(), std::size_t{1});
      QCOMPARE(QString::fromStdString(series->entries.front().description), QString("A series"));
      QCOMPARE(series->entries.front().objects.value_or(-1), 7);
      for (const bool whole_study : {true, false}) {
        const imaging::RetrieveRequest request{study.uid, whole_study ? "" : series->entries.front().uid,
                                               folder / (server.name + (whole_study ? "-study" : "-series"))};
        const auto retrieved = imaging::retrieve(server, request, limits());
        QCOMPARE(failure(retrieved), QString());
        QCOMPARE(retrieved->files.size(), files.size());
        QCOMPARE(retrieved->missing, 0);
        QVERIFY(retrieved->refused.empty());
        const auto loaded = imaging::load_volume(request.folder);
        QCOMPARE(failure(loaded), QString());
        QVERIFY(loaded->values() == volume.values());
      }
    }
  }

  void a_query_narrows_and_is_cut_where_it_is_too_long() {
    const WebArchive archive(nullptr, "");
    const imaging::PacsServer web = archive.web_server();
    send_three_studies(web);
    find_some_of_three_studies(web, true);
    imaging::PacsLimits few = limits();
    few.answers = 2;
    const auto found = imaging::find_studies(web, {}, few);
    QCOMPARE(failure(found), QString());
    QCOMPARE(found->entries.size(), std::size_t{2});
    QVERIFY(found->more);
  }

  void compressed_files_go_and_come_as_they_are() {
    const WebArchive archive(nullptr, "");
    const TemporaryFolder folder;
    const auto files = write_series(sample_volume({16, 16, 2}), folder / "plain");
    const auto packed = folder / "packed.dcm";
    compress_by_rle(files.front(), packed);
    QCOMPARE(failure(imaging::send_files(archive.web_server(), {packed})), QString());
    const auto studies = imaging::find_studies(archive.web_server(), {});
    QCOMPARE(failure(studies), QString());
    const auto retrieved = imaging::retrieve(archive.web_server(),
                                             {studies->entries.front().uid, {}, folder / "back"}, limits());
    QCOMPARE(failure(retrieved), QString());
    QCOMPARE(retrieved->files.size(), std::size_t{1});
    QCOMPARE(syntax_of(retrieved->files.front()), syntax_of(packed));
  }

  void a_segmentation_and_its_report_are_sent_and_found_both_ways() {
    const WebArchive archive(nullptr, "");
    const auto phantom = imaging::make_phantom("sphere", {});
    QCOMPARE(failure(phantom), QString());
    const TemporaryFolder folder;
    const auto images = write_series(phantom->volume, folder / "series", "CT");
    const auto segmentation = folder / "seg.dcm";
    const auto report = folder / "report.dcm";
    QCOMPARE(failure(imaging::write_segmentation(imaging::segments_of(phantom->truth, "Ball"), images,
                                                 segmentation)),
             QString());
    const imaging::ReportedMeasure volume{
        {"118565006", "SCT", "Volume"}, 4.2, {"cm3", "UCUM", "cubic centimeter"}, {}};
    QCOMPARE(failure(imaging::write_measurement_report(segmentation, {{0, {volume}}}, "CT", report)),
             QString());
    const auto sent = imaging::send_files(archive.web_server(), {segmentation, report});
    QCOMPARE(failure(sent), QString());
    QVERIFY(sent->unsent.empty());
    for (const imaging::PacsServer& server : {archive.web_server(), archive.server()}) {
      const auto series = imaging::find_pacs_series(server, {imaging::study_uid_of(report), {}, {}});
      QCOMPARE(failure(series), QString());
      std::vector<std::string> modalities;
      for (const imaging::PacsSeries& one : series->entries) modalities.push_back(one.modality);
      std::sort(modalities.begin(), modalities.end());
      QVERIFY(modalities == (std::vector<std::string>{"SEG", "SR"}));
    }
  }

  void nothing_is_found_where_there_is_nothing() {
    const WebArchive archive(nullptr, "");
    const TemporaryFolder folder;
    const auto studies = imaging::find_studies(archive.web_server(), {});
    QCOMPARE(failure(studies), QString());
    QVERIFY(studies->entries.empty());
    const auto retrieved = imaging::retrieve(archive.web_server(), {"1.2.3", {}, folder / "back"}, limits());
    QVERIFY(!retrieved);
    QVERIFY2(failure(retrieved).contains("the server has nothing of the study"),
             qPrintable(failure(retrieved)));
    QVERIFY(!std::filesystem::exists(folder / "back"));
  }

  void passwords_and_certificates_count() {
    const Certificates authority;
    const Certificates stranger;
    const auto pair = authority.signed_for("localhost");
    const TlsFiles files{authority.authority(), pair.certificate, pair.key};
    const WebArchive archive(&files, "reader");
    const imaging::PacsServer good = archive.web_server();
    QCOMPARE(said(imaging::pacs_echo(good)), QString("it answers"));
    const TemporaryFolder folder;
    const auto sent = imaging::send_files(good, write_series(sample_volume({64, 64, 3}), folder / "sent"));
    QCOMPARE(failure(sent), QString());
    QCOMPARE(sent->objects, 3);

    imaging::PacsServer server = good;
    server.web->user.clear();
    server.web->secret.clear();
    QVERIFY2(said(imaging::pacs_echo(server)).contains("does not let us in (HTTP 401): it wants a secret"),
             qPrintable(said(imaging::pacs_echo(server))));
    server = good;
    server.web->user = "nobody";
    QVERIFY2(said(imaging::pacs_echo(server)).contains("the user or the secret is not the right one"),
             qPrintable(said(imaging::pacs_echo(server))));
    server = good;
    server.tls->ca = stranger.authority();
    QVERIFY2(said(imaging::pacs_echo(server)).contains("its certificate is not to be trusted"),
             qPrintable(said(imaging::pacs_echo(server))));
    server.tls->verify = false;
    QCOMPARE(said(imaging::pacs_echo(server)), QString("it answers"));
    server = good;
    server.tls.reset();  // the system's authorities do not know it
    QVERIFY2(said(imaging::pacs_echo(server)).contains("its certificate is not to be trusted"),
             qPrintable(said(imaging::pacs_echo(server))));
    server = good;
    server.web->url.replace(server.web->url.find("localhost"), 9,
                            "127.0.0.1");  // the certificate names another
    QVERIFY2(said(imaging::pacs_echo(server)).contains("its certificate is not to be trusted"),
             qPrintable(said(imaging::pacs_echo(server))));
    server = good;
    server.tls->ca = folder / "none.pem";
    QVERIFY2(said(imaging::pacs_echo(server)).contains("none.pem"),
             qPrintable(said(imaging::pacs_echo(server))));
    // The system's authorities are those that this variable names, as for DICOM's own protocol.
    server = good;
    server.tls.reset();
    const auto back = qScopeGuard([] { qunsetenv("SSL_CERT_FILE"); });
    qputenv("SSL_CERT_FILE", authority.authority().c_str());
    QCOMPARE(said(imaging::pacs_echo(server)), QString("it answers"));
    qputenv("SSL_CERT_FILE", stranger.authority().c_str());
    QCOMPARE(said(imaging::pacs_echo(good)), QString("it answers"));
    server = good;
    server.web->secret = folder / "none.txt";
    QVERIFY2(said(imaging::pacs_echo(server)).contains("none.txt"),
             qPrintable(said(imaging::pacs_echo(server))));
  }
};

TIDEMARK_TEST(PacsWebTest)

}  // namespace tidemark::test::pacs_web_test

#include "pacs_web_test.moc"
