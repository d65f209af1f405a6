// Peers that send without end: what they may fill is bounded, in memory and on the disk.
#include <sys/resource.h>

#include <QElapsedTimer>
#include <QTest>

#include "imaging/pacs/services.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/imaging/pacs/scripted_peer.h"
#include "tests/imaging/pacs/wire.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::pacs_flood_test {

namespace {

constexpr const char* kStudy = "1.2.3";
constexpr const char* kSeries = "1.2.3.4";

// These peers are quick, but the machine may be busy.
imaging::PacsServer patient(const ScriptedPeer& peer) {
  imaging::PacsServer server = peer.server();
  server.timeout_seconds = 20;
  return server;
}

QString message(const Error& error) {
  return QString::fromStdString(error.message);
}

// The most memory that this process has ever had, in MiB.
long most_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

constexpr std::size_t kPiece = 1'000'000;

// The beginning of PixelData (7FE0,0010) of so many bytes, in explicit little endian.
std::string pixel_data(std::size_t bytes) {
  std::string head("\xe0\x7f\x10\x00OW\0\0", 8);
  for (int i = 0; i < 4; ++i) head += static_cast<char>(bytes >> (8 * i) & 0xff);
  return head;
}

// Sends objects of that many pieces of 1 MB without end.
ScriptedPeer::Behaviour objects_without_end(int pieces) {
  return [pieces](PeerEnd& end) {
    end.accept_call();
    end.read_command();
    const int ct = end.context(kCt);
    for (int number = 1;; ++number) {
      const std::string instance = "1.2.5." + std::to_string(number);
      if (!end.send_command(ct, store_request(number, kCt, instance))) return;
      const std::string head =
          object(kCt, instance, kStudy, kSeries) + pixel_data(static_cast<std::size_t>(pieces) * kPiece);
      if (!end.send_data(ct, head, pieces == 0)) return;
      for (int i = 0; i < pieces; ++i) {
        if (!end.send_data(ct, std::string(kPiece, '\0'), i == pieces - 1)) return;
      }
      if (end.read_command().empty()) return;
    }
  };
}

// Answers with that identifier without end.
ScriptedPeer::Behaviour answers_without_end(const std::string& identifier) {
  return [identifier](PeerEnd& end) {
    end.accept_call();
    end.read_command();
    while (end.send_command(1, response(kFindResponse, 1, kPending, true)) && end.send_data(1, identifier)) {
    }
  };
}

// So many sequences, one in the other, in explicit little endian.
std::string nested(int depth, bool closed = true) {
  std::string bytes;
  for (int i = 0; i < depth; ++i) {
    bytes += std::string("\x08\x00\x40\x11", 4) + "SQ" + std::string("\0\0\xff\xff\xff\xff", 6);
    bytes += std::string("\xfe\xff\x00\xe0\xff\xff\xff\xff", 8);
  }
  for (int i = 0; closed && i < depth; ++i) {
    bytes += std::string("\xfe\xff\x0d\xe0\0\0\0\0\xfe\xff\xdd\xe0\0\0\0\0", 16);
  }
  return bytes;
}

}  // namespace

class PacsFloodTest : public QObject {
  Q_OBJECT

 private slots:
  void a_retrieval_ends_where_it_becomes_too_large_data() {
    QTest::addColumn<int>("pieces");
    QTest::addColumn<imaging::PacsLimits>("limits");
    QTest::addColumn<QString>("said");
    QTest::addColumn<ErrorKind>("kind");
    imaging::PacsLimits small;
    small.object_bytes = 5'000'000;
    small.retrieval_bytes = 30'000'000;
    small.objects = 40;
    small.free_bytes = 1 << 20;
    QTest::newRow("an object that never ends")
        << 4000 << small << "sends more than an object may hold" << ErrorKind::input;
    QTest::newRow("many large objects")
        << 4 << small << "sends more than the 28 MiB that are allowed" << ErrorKind::input;
    QTest::newRow("very many small objects")
        << 0 << small << "sends more than the 40 objects that are allowed" << ErrorKind::input;
    imaging::PacsLimits full = small;
    full.free_bytes = std::int64_t{1} << 60;
    QTest::newRow("a disk that is full") << 4 << full << "the disk is nearly full" << ErrorKind::write;
  }
  void a_retrieval_ends_where_it_becomes_too_large() {
    QFETCH(int, pieces);
    QFETCH(imaging::PacsLimits, limits);
    QFETCH(QString, said);
    QFETCH(ErrorKind, kind);
    const ScriptedPeer peer(objects_without_end(pieces));
    const TemporaryFolder folder;
    const long before = most_memory();
    const auto retrieved = imaging::retrieve(patient(peer), {kStudy, kSeries, folder / "in"}, limits);
    QVERIFY(!retrieved);
    QVERIFY2(message(retrieved.error()).contains(said), qPrintable(message(retrieved.error())));
    QCOMPARE(retrieved.error().kind, kind);
    QVERIFY(!std::filesystem::exists(folder / "in"));
    QVERIFY2(most_memory() - before < 64, qPrintable(QString::number(most_memory() - before)));
  }

  void responses_without_end_are_cut_off() {
    const ScriptedPeer peer([](PeerEnd& end) {
      end.accept_call();
      end.read_command();
      std::string many;
      for (int i = 0; i < 100; ++i) many += data_pdus(1, true, response(kGetResponse, 1, kPending, false));
      while (end.write(many)) {
      }
    });
    const TemporaryFolder folder;
    imaging::PacsLimits limits;
    limits.free_bytes = 1 << 20;
    const auto retrieved = imaging::retrieve(patient(peer), {kStudy, kSeries, folder / "in"}, limits);
    QVERIFY(!retrieved);
    QVERIFY2(message(retrieved.error()).contains("answers without end"),
             qPrintable(message(retrieved.error())));
  }

  void answers_without_end_are_cut_off() {
    const ScriptedPeer peer(answers_without_end(explicit_attribute(0x0020, 0x000d, "UI", kStudy)));
    imaging::PacsLimits limits;
    limits.answers = 50;
    const auto found = imaging::find_studies(patient(peer), {}, limits);
    QCOMPARE(failure(found), QString());
    QCOMPARE(found->entries.size(), std::size_t{50});
    QVERIFY(found->more);
  }

  void an_answer_without_end_is_refused_data() {
    QTest::addColumn<std::string>("identifier");
    QTest::newRow("a long one") << std::string(1'000'000, '\0');
    // What fits into the longest answer that is taken must not end the program.
    QTest::newRow("a deep one") << nested(1800);
    QTest::newRow("a deep one that is not closed") << nested(3200, false);
    QTest::newRow("a deeper one") << nested(20'000);
  }
  void an_answer_without_end_is_refused() {
    QFETCH(std::string, identifier);
    const ScriptedPeer peer(answers_without_end(identifier));
    QElapsedTimer timer;
    timer.start();
    imaging::PacsLimits limits;
    limits.answers = 3;
    const auto found = imaging::find_studies(patient(peer), {}, limits);
    QVERIFY(timer.elapsed() < 5000);
    QVERIFY(!found || found->entries.empty());
    if (identifier.size() > 65536) {
      QVERIFY(!found);
      QVERIFY2(message(found.error()).contains("sends more than the data of a command may hold"),
               qPrintable(message(found.error())));
    }
  }

  void answers_that_hold_anything_come_as_clean_text() {
    const ScriptedPeer peer([](PeerEnd& end) {
      end.accept_call();
      end.read_command();
      const std::string answer =
          explicit_attribute(0x0008, 0x0020, "DA", "no date!") +
          explicit_attribute(0x0008, 0x1030, "LO", "line\nfeed \x1b[31m \xff\xfe end") +
          explicit_attribute(0x0020, 0x000d, "UI", kStudy);
      end.send_command(1, response(kFindResponse, 1, kPending, true));
      end.send_data(1, answer);
      end.send_command(1, response(kFindResponse, 1, 0, false));
      end.read_command();
    });
    const auto found = imaging::find_studies(patient(peer), {});
    QCOMPARE(failure(found), QString());
    QCOMPARE(found->entries.size(), std::size_t{1});
    const imaging::PacsStudy& study = found->entries.front();
    QCOMPARE(QString::fromStdString(study.date), QString());
    QVERIFY2(!QString::fromStdString(study.description).contains('\n'), study.description.c_str());
    QVERIFY(!QString::fromStdString(study.description).contains('\x1b'));
    QVERIFY(QString::fromStdString(study.description).endsWith("end"));
  }

  void a_flood_on_the_port_for_moves_ends_the_retrieval() {
    const ScriptedPeer archive([](PeerEnd& end) {
      end.accept_call();
      end.read_command();
      QTest::qSleep(1500);
      end.send_command(1, response(0x8021, 1, 0, false));
      end.read_command();
    });
    imaging::PacsServer server = archive.server();
    server.retrieve = imaging::PacsServer::Retrieve::move;
    server.timeout_seconds = 5;
    server.move_port = free_port();
    const TemporaryFolder folder;
    const auto files = write_series(sample_volume({64, 64, 2}), folder / "series");
    imaging::PacsLimits limits;
    limits.free_bytes = 1 << 20;
    limits.object_bytes = 2000;
    std::thread caller([&] {
      QTest::qSleep(200);
      imaging::PacsServer us = server;
      us.port = server.move_port;
      us.ae_title = server.own_ae_title;
      static_cast<void>(imaging::send_files(us, files));
    });
    const auto retrieved = imaging::retrieve(server, {kStudy, kSeries, folder / "in"}, limits);
    caller.join();
    QVERIFY(!retrieved);
    QVERIFY2(message(retrieved.error()).contains("sends more than an object may hold"),
             qPrintable(message(retrieved.error())));
    QVERIFY(!std::filesystem::exists(folder / "in"));
  }

  void a_caller_on_the_port_for_moves_gets_nothing_stored_under_another_title() {
    // Stands in for the archive: it never calls back, but somebody else does.
    const ScriptedPeer archive([](PeerEnd& end) {
      end.accept_call();
      end.read_command();
      QTest::qSleep(500);
      end.send_command(1, response(0x8021, 1, 0, false));
      end.read_command();
    });
    imaging::PacsServer server = archive.server();
    server.retrieve = imaging::PacsServer::Retrieve::move;
    server.own_ae_title = "US";
    server.timeout_seconds = 5;
    server.move_port = free_port();
    const TemporaryFolder folder;
    imaging::PacsLimits limits;
    limits.free_bytes = 1 << 20;
    imaging::PacsServer us = server;
    us.port = server.move_port;
    us.retrieve = imaging::PacsServer::Retrieve::get;
    us.ae_title = "THEM";
    Result<double> wrong = fail(ErrorKind::internal, "not called");
    Result<double> right = fail(ErrorKind::internal, "not called");
    std::thread caller([&] {
      QTest::qSleep(100);
      wrong = imaging::pacs_echo(us);
      us.ae_title = "US";
      right = imaging::pacs_echo(us);
    });
    const auto retrieved = imaging::retrieve(server, {kStudy, kSeries, folder / "in"}, limits);
    caller.join();
    QVERIFY(!retrieved);
    QVERIFY2(message(retrieved.error()).contains("has nothing"), qPrintable(message(retrieved.error())));
    QVERIFY(!wrong);
    QVERIFY2(message(wrong.error()).contains("it is not called 'THEM'"), qPrintable(message(wrong.error())));
    QCOMPARE(failure(right), QString());
  }
};

TIDEMARK_TEST(PacsFloodTest)

}  // namespace tidemark::test::pacs_flood_test

#include "pacs_flood_test.moc"
