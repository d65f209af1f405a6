// Series of cases that a server sends: whole, or not at all.
#include <algorithm>

#include "document/cohort/pacs_cases.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/pacs/scripted_peer.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cohort_pacs_cases_test {

namespace {

namespace fs = std::filesystem;

constexpr const char* kStudy = "1.2.7";
constexpr const char* kSeries = "1.2.7.18.28";

// Two objects of the series.
std::vector<std::string> objects_of_series(const TemporaryFolder& folder) {
  std::vector<std::string> objects;
  for (const fs::path& file : write_series(sample_volume({4, 4, 2}), folder / "series")) {
    set_text(file, 0x0020, 0x000D, kStudy);
    set_text(file, 0x0020, 0x000E, kSeries);
    objects.push_back(bytes_of(file).toStdString());
  }
  return objects;
}

// Brings the series of a server that answers with these objects.
Status bring(const std::vector<std::string>& objects, const fs::path& folder) {
  std::string body;
  for (const std::string& object : objects) body += "--x\r\n\r\n" + object + "\r\n";
  body += "--x--";
  const ScriptedPeer peer([&](PeerEnd& end) {
    end.read_request();
    end.write(
        fmt::format("HTTP/1.1 200 OK\r\nContent-Type: multipart/related; boundary=x\r\n"
                    "Content-Length: {}\r\n\r\n{}",
                    body.size(), body));
    end.say_nothing();
  });
  imaging::PacsConfiguration servers;
  servers.servers.push_back(peer.web_server());
  servers.limits.free_bytes = 1 << 20;
  cohort::WorkRow row;
  row.server = servers.servers.front().name;
  row.study = kStudy;
  row.series = kSeries;
  return cohort::bring_series(servers, row, folder);
}

std::ptrdiff_t files_in(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

}  // namespace

class CohortPacsCasesTest : public QObject {
  Q_OBJECT

 private slots:
  void a_series_with_a_damaged_object_is_not_taken() {
    const TemporaryFolder folder;
    std::vector<std::string> objects = objects_of_series(folder);
    objects[1].resize(objects[1].find(kSeries) + 3);  // in the midst of its UID
    const Status brought = bring(objects, folder / "back");
    QVERIFY(!brought);
    QCOMPARE(brought.error().kind, ErrorKind::input);
    QVERIFY2(failure(brought).contains("object 000002: is damaged: "), qPrintable(failure(brought)));
    QCOMPARE(files_in(folder / "back"), std::ptrdiff_t{0});
  }

  void objects_that_nobody_asked_for_are_no_loss() {
    const TemporaryFolder folder;
    std::vector<std::string> objects = objects_of_series(folder);
    objects.push_back(objects[0]);  // a second time
    objects.push_back(objects[0]);
    std::string& other = objects.back();
    other.replace(other.find(kSeries), std::string_view(kSeries).size(), "1.2.7.18.29");
    QCOMPARE(failure(bring(objects, folder / "back")), QString());
    QCOMPARE(files_in(folder / "back"), std::ptrdiff_t{2});
  }
};

TIDEMARK_TEST(CohortPacsCasesTest)

}  // namespace tidemark::test::cohort_pacs_cases_test

#include "cohort_pacs_cases_test.moc"
