// The folder that a retrieval fills holds all that came, or nothing: when the program is killed, and when the
// folder cannot be filled.
#include <QTest>
#include <fstream>

#include "core/atomic_file.h"
#include "imaging/pacs/services.h"
#include "tests/imaging/pacs/scripted_peer.h"
#include "tests/imaging/pacs/wire.h"
#include "tests/support/child_process.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::pacs_retrieval_folder_test {

namespace fs = std::filesystem;

namespace {

constexpr const char* kStudy = "1.2.3";
constexpr const char* kSeries = "1.2.3.4";
constexpr std::int64_t kSmallObject = 2000;  // bytes, and more than the first two objects have

// Three objects, the last of them larger.
void send_series(PeerEnd& end) {
  end.accept_call();
  end.read_command();
  const int ct = end.context(kCt);
  for (const char* instance : {"1.2.5", "1.2.6", "1.2.7"}) {
    std::string sent = object(kCt, instance, kStudy, kSeries);
    if (instance == std::string("1.2.7")) {
      sent += explicit_attribute(0x0020, 0x4000, "LT", std::string(8000, 'x'));
    }
    end.send_command(ct, store_request(1, kCt, instance));
    end.send_data(ct, sent);
    end.read_command();
  }
  end.send_command(1, response(kGetResponse, 1, 0, false));
  end.read_command();
}

Result<imaging::Retrieved> retrieve_series(const ScriptedPeer& peer, const fs::path& folder) {
  imaging::PacsServer server = peer.server();
  server.timeout_seconds = 5;
  imaging::PacsLimits limits;
  limits.free_bytes = 1 << 20;
  return imaging::retrieve(server, {kStudy, kSeries, folder}, limits);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

const std::vector<std::string> kAll{"000001.dcm", "000002.dcm", "000003.dcm"};

}  // namespace

class PacsRetrievalFolderTest : public QObject {
  Q_OBJECT

  // What is left beside the folder has a temporary name.
  static void verify_all_or_nothing(const fs::path& folder, bool was_there) {
    if (fs::exists(folder)) {
      const auto names = names_in(folder);
      QVERIFY2(names == kAll || (was_there && names.empty()), qPrintable(QString::number(names.size())));
    } else {
      QVERIFY(!was_there);
    }
    for (const auto& entry : fs::directory_iterator(folder.parent_path())) {
      QVERIFY2(entry.path() == folder || !AtomicFile::target_of(entry.path()).empty(), entry.path().c_str());
    }
  }

 private slots:
  void what_came_is_in_the_folder_data() {
    QTest::addColumn<bool>("was_there");
    QTest::newRow("a new one") << false;
    QTest::newRow("one that was empty") << true;
  }
  void what_came_is_in_the_folder() {
    QFETCH(bool, was_there);
    const ScriptedPeer peer(send_series);
    const TemporaryFolder place;
    const fs::path folder = place / "in";
    if (was_there) {
      fs::create_directory(folder);
      fs::permissions(folder, fs::perms::owner_all);  // only the owner is to see the patient
    }
    const auto retrieved = retrieve_series(peer, folder / "");
    QCOMPARE(failure(retrieved), QString());
    QCOMPARE(names_in(folder), kAll);
    QCOMPARE(names_in(place.path()), std::vector<std::string>{"in"});
    for (const fs::path& file : retrieved->files) QVERIFY2(fs::exists(file), file.c_str());
    if (was_there) QVERIFY(fs::status(folder).permissions() == fs::perms::owner_all);
  }

  void a_killed_retrieval_leaves_nothing_in_the_folder_data() { what_came_is_in_the_folder_data(); }
  void a_killed_retrieval_leaves_nothing_in_the_folder() {
    QFETCH(bool, was_there);
    const ScriptedPeer peer(send_series);
    const auto killed = [&](const fs::path& place, const Disturbance& how) {
      const fs::path folder = place / "in";
      if (was_there) fs::create_directory(folder);
      const Ended ended = run_in_child(
          [&]() -> Status {
            auto retrieved = retrieve_series(peer, folder);
            return retrieved ? Status() : pass_on(retrieved);
          },
          how);
      if (!ended.failure.empty()) qWarning("%s", ended.failure.c_str());
      verify_all_or_nothing(folder, was_there);
      return ended.was_killed;
    };
    {
      const TemporaryFolder place;
      QVERIFY(killed(place.path(), {.largest_file = kSmallObject}));  // in the midst of the third object
      QVERIFY(!fs::exists(place / "in") || fs::is_empty(place / "in"));
      QCOMPARE(fs::is_empty(place.path()), false);  // what came lies under its temporary name
    }
    // Between the steps: the temporary folder is made, and put in place.
    for (const int events : {1, 2, 3}) {
      const TemporaryFolder place;
      static_cast<void>(killed(place.path(), {.events = events, .watched = place.path()}));
    }
  }

  void a_folder_that_is_filled_meanwhile_is_left_alone() {
    const TemporaryFolder place;
    const fs::path folder = place / "in";
    const ScriptedPeer peer([&](PeerEnd& end) {
      fs::create_directory(folder);
      std::ofstream(folder / "mine.txt") << "mine";
      send_series(end);
    });
    const auto retrieved = retrieve_series(peer, folder);
    QVERIFY(!retrieved);
    QCOMPARE(retrieved.error().kind, ErrorKind::write);
    QVERIFY2(retrieved.error().message.find("it is no empty folder") != std::string::npos,
             retrieved.error().message.c_str());
    QCOMPARE(names_in(folder), std::vector<std::string>{"mine.txt"});
    QCOMPARE(names_in(place.path()), std::vector<std::string>{"in"});
  }
};

TIDEMARK_TEST(PacsRetrievalFolderTest)

}  // namespace tidemark::test::pacs_retrieval_folder_test

#include "pacs_retrieval_folder_test.moc"
