// Peers that are not there, say nothing, say nonsense or hang up: every call ends soon, says why, and leaves
// nothing.
#include <QElapsedTimer>
#include <QTest>
#include <random>

#include "imaging/pacs/services.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/imaging/pacs/scripted_peer.h"
#include "tests/imaging/pacs/wire.h"
#include "tests/support/test_program.h"

namespace tidemark::test::pacs_hostile_test {

namespace {

constexpr qint64 kSoon = 10'000;  // ms, with a patience of one second, on a busy machine
constexpr const char* kStudy = "1.2.3";
constexpr const char* kSeries = "1.2.3.4";

using Behaviour = ScriptedPeer::Behaviour;

// Accepts the call and hears the first command.
Behaviour then(const std::function<void(PeerEnd&)>& more) {
  return [more](PeerEnd& end) {
    end.accept_call();
    end.read_command();
    more(end);
  };
}

std::string bytes_by_chance(std::size_t count) {
  std::mt19937 random(7);
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>(random());
  return bytes;
}

QString message(const Error& error) {
  return QString::fromStdString(error.message);
}

}  // namespace

class PacsHostileTest : public QObject {
  Q_OBJECT

 private slots:
  void nobody_listens() {
    imaging::PacsServer server = ScriptedPeer([](PeerEnd&) {}).server();  // its port is free again
    const auto echoed = imaging::pacs_echo(server);
    QVERIFY(!echoed);
    QCOMPARE(echoed.error().kind, ErrorKind::input);
    QVERIFY2(message(echoed.error()).contains("Connection refused"), qPrintable(message(echoed.error())));
    QVERIFY(message(echoed.error()).startsWith("PACS peer (127.0.0.1:"));
  }

  void an_unknown_host_is_named() {
    imaging::PacsServer server = ScriptedPeer([](PeerEnd&) {}).server();
    server.host = "no-such-host.invalid";
    const auto echoed = imaging::pacs_echo(server);
    QVERIFY(!echoed);
    QVERIFY2(message(echoed.error()).contains("the host no-such-host.invalid is not known"),
             qPrintable(message(echoed.error())));
  }

  void a_peer_that_misbehaves_in_an_echo_is_told_off_data() {
    QTest::addColumn<Behaviour>("behave");
    QTest::addColumn<QString>("said");
    QTest::newRow("hangs up at once") << Behaviour([](PeerEnd&) {}) << "cannot be called";
    QTest::newRow("connects and says nothing")
        << Behaviour([](PeerEnd& end) { end.say_nothing(); }) << "does not answer: nothing came for 1 s";
    QTest::newRow("drips") << Behaviour([](PeerEnd& end) {
      const std::string answer = accept_all(contexts_of(end.read_pdu()));
      for (const char c : answer) {
        if (end.quits() || !end.write(std::string(1, c))) return;
        QTest::qSleep(100);
      }
    }) << "is too slow";
    QTest::newRow("rejects our title") << Behaviour([](PeerEnd& end) {
      end.read_pdu();
      end.write(reject(1, 1, 3));
    }) << "it does not know us as 'TIDEMARK' (own_ae_title)";
    QTest::newRow("rejects for now") << Behaviour([](PeerEnd& end) {
      end.read_pdu();
      end.write(reject(2, 3, 1));
    }) << "refuses the call for now";
    QTest::newRow("accepts no context") << Behaviour([](PeerEnd& end) {
      end.read_pdu();
      end.write(accept_all({}));
      end.say_nothing();
    }) << "";
    QTest::newRow("answers the call with noise") << Behaviour([](PeerEnd& end) {
      end.read_pdu();
      end.write(bytes_by_chance(100'000));
      end.say_nothing();
    }) << "";
    QTest::newRow("promises an answer of 4 GiB") << Behaviour([](PeerEnd& end) {
      end.read_pdu();
      end.write(std::string("\x02\x00\xff\xff\xff\xff", 6));
      end.say_nothing();
    }) << "";
    QTest::newRow("accepts and says nothing")
        << then([](PeerEnd& end) { end.say_nothing(); }) << "does not answer: nothing came for 1 s";
    QTest::newRow("accepts and hangs up") << then([](PeerEnd&) {}) << "breaks off";
    QTest::newRow("aborts") << then([](PeerEnd& end) {
      end.write(pdu(7, std::string(4, '\0')));
      end.say_nothing();
    }) << "it aborts the conversation";
    QTest::newRow("says goodbye instead") << then([](PeerEnd& end) {
      end.write(pdu(5, std::string(4, '\0')));
      end.say_nothing();
    }) << "it hangs up before it has answered";
    QTest::newRow("answers with noise in a PDU") << then([](PeerEnd& end) {
      end.write(data_pdus(1, true, bytes_by_chance(2000)));
      end.say_nothing();
    }) << "";
    QTest::newRow("answers on another context") << then([](PeerEnd& end) {
      end.send_command(77, response(kEchoResponse, 1, 0, false));
      end.say_nothing();
    }) << "";
    QTest::newRow("answers another question") << then([](PeerEnd& end) {
      end.send_command(1, response(kFindResponse, 1, 0, false));
      end.say_nothing();
    }) << "does not echo";
    QTest::newRow("a command that never ends") << then([](PeerEnd& end) {
      while (end.write(data_pdus(1, true, std::string(16000, '\0'), false))) {
      }
    }) << "";
    QTest::newRow("an item that is longer than its PDU") << then([](PeerEnd& end) {
      end.write(pdu(4, std::string("\x7f\xff\xff\xff\x01\x03", 6)));
      end.say_nothing();
    }) << "";
  }
  void a_peer_that_misbehaves_in_an_echo_is_told_off() {
    QFETCH(Behaviour, behave);
    QFETCH(QString, said);
    const ScriptedPeer peer(behave);
    QElapsedTimer timer;
    timer.start();
    const auto echoed = imaging::pacs_echo(peer.server());
    QVERIFY(!echoed);
    QCOMPARE(echoed.error().kind, ErrorKind::input);
    QVERIFY2(timer.elapsed() < kSoon, qPrintable(QString::number(timer.elapsed())));
    QVERIFY2(message(echoed.error()).contains(said), qPrintable(message(echoed.error())));
    QCOMPARE(message(echoed.error()).count('\n'), 0);
  }

  void a_peer_that_is_silent_at_the_end_has_answered_all_the_same() {
    const ScriptedPeer peer(then([](PeerEnd& end) {
      end.send_command(1, response(kEchoResponse, 1, 0, false));
      end.say_nothing();
    }));
    QElapsedTimer timer;
    timer.start();
    QCOMPARE(failure(imaging::pacs_echo(peer.server())), QString());
    QVERIFY(timer.elapsed() < kSoon);
  }

  void a_peer_that_misbehaves_in_a_retrieval_leaves_nothing_data() {
    QTest::addColumn<Behaviour>("behave");
    QTest::addColumn<QString>("said");
    const auto begin_object = [](PeerEnd& end, const std::string& instance) {
      end.send_command(end.context(kCt), store_request(1, kCt, instance));
    };
    QTest::newRow("says nothing") << then([](PeerEnd& end) { end.say_nothing(); }) << "does not answer";
    QTest::newRow("hangs up in the midst of an object") << then([=](PeerEnd& end) {
      begin_object(end, "1.2.5");
      end.send_data(end.context(kCt), std::string(20'000, '\0'), false);
    }) << "breaks off in the midst of an object";
    QTest::newRow("stops in the midst of an object") << then([=](PeerEnd& end) {
      begin_object(end, "1.2.5");
      end.send_data(end.context(kCt), std::string(20'000, '\0'), false);
      end.say_nothing();
    }) << "is too slow: 2";
    QTest::newRow("drips an object") << then([=](PeerEnd& end) {
      begin_object(end, "1.2.5");
      while (end.send_data(end.context(kCt), std::string(2, '\0'), false)) QTest::qSleep(50);
    }) << "is too slow";
    QTest::newRow("noise in the midst of an object") << then([=](PeerEnd& end) {
      begin_object(end, "1.2.5");
      end.send_data(end.context(kCt), std::string(20'000, '\0'), false);
      end.write(bytes_by_chance(100'000));
      end.say_nothing();
    }) << "";
    QTest::newRow("says for ever that it is at it") << then([](PeerEnd& end) {
      const std::string counts = short_attribute(0, 0x1020, 7) + short_attribute(0, 0x1021, 0);
      while (end.send_command(1, response(kGetResponse, 1, kPending, false, counts))) QTest::qSleep(20);
    }) << "";
    QTest::newRow("has failed") << then([](PeerEnd& end) {
      end.send_command(1, response(kGetResponse, 1, 0xa701, false));
      end.read_command();
    }) << "cannot send the requested objects (status A701)";
    QTest::newRow("says that all is well and sends nothing") << then([](PeerEnd& end) {
      end.send_command(1, response(kGetResponse, 1, 0, false));
      end.read_command();
    }) << "the server has nothing";
    const auto send_object = [](PeerEnd& end, const std::string& announced, const std::string& object) {
      end.send_command(end.context(kCt), store_request(1, kCt, announced));
      end.send_data(end.context(kCt), object);
      end.read_command();
      end.send_command(1, response(kGetResponse, 1, 0, false));
      end.read_command();
    };
    QTest::newRow("an object of another series")
        << then([=](PeerEnd& end) { send_object(end, "1.2.5", object(kCt, "1.2.5", kStudy, "1.2.3.5")); })
        << "none of the objects that came can be taken: object 000001: belongs to another series";
    QTest::newRow("an object of another study")
        << then([=](PeerEnd& end) { send_object(end, "1.2.5", object(kCt, "1.2.5", "1.2.9", kSeries)); })
        << "object 000001: belongs to another study";
    QTest::newRow("another object than it announces")
        << then([=](PeerEnd& end) { send_object(end, "1.2.5", object(kCt, "1.2.6", kStudy, kSeries)); })
        << "object 000001: is another object than was announced";
    QTest::newRow("an object of another class than it announces") << then([=](PeerEnd& end) {
      send_object(end, "1.2.5", object("1.2.840.10008.5.1.4.1.1.4", "1.2.5", kStudy, kSeries));
    }) << "object 000001: is another object than was announced";
    QTest::newRow("an object that is noise")
        << then([=](PeerEnd& end) { send_object(end, "1.2.5", bytes_by_chance(4000)); })
        << "none of the objects that came can be taken: object 000001: ";
    QTest::newRow("an object without content")
        << then([=](PeerEnd& end) { send_object(end, "1.2.5", {}); })
        << "none of the objects that came can be taken: object 000001: ";
    QTest::newRow("a class that was not asked for") << then([=](PeerEnd& end) {
      constexpr const char* kReport = "1.2.840.10008.5.1.4.1.1.88.11";
      end.send_command(end.context(kCt), store_request(1, kReport, "1.2.5"));
      end.send_data(end.context(kCt), object(kReport, "1.2.5", kStudy, kSeries));
      end.read_command();
      end.send_command(1, response(kGetResponse, 1, 0, false));
      end.read_command();
    }) << "object 000001: is of a class that was not asked for";
    QTest::newRow("a path for a name") << then([=](PeerEnd& end) {
      send_object(end, "../../../x", object(kCt, "../../../x", kStudy, kSeries));
    }) << "SOPInstanceUID (0008,0018) is missing or no UID";
    QTest::newRow("an absolute path for a name") << then([=](PeerEnd& end) {
      send_object(end, "/tmp/tidemark-x", object(kCt, "/tmp/tidemark-x", kStudy, kSeries));
    }) << "SOPInstanceUID (0008,0018) is missing or no UID";
  }
  void a_peer_that_misbehaves_in_a_retrieval_leaves_nothing() {
    QFETCH(Behaviour, behave);
    QFETCH(QString, said);
    const ScriptedPeer peer(behave);
    const TemporaryFolder folder;
    imaging::PacsLimits limits;
    limits.free_bytes = 1 << 20;
    QElapsedTimer timer;
    timer.start();
    const auto retrieved = imaging::retrieve(peer.server(), {kStudy, kSeries, folder / "a/b"}, limits);
    QVERIFY(!retrieved);
    QVERIFY2(timer.elapsed() < kSoon, qPrintable(QString::number(timer.elapsed())));
    QCOMPARE(retrieved.error().kind, ErrorKind::input);
    QVERIFY2(message(retrieved.error()).contains(said), qPrintable(message(retrieved.error())));
    QVERIFY(!std::filesystem::exists(folder / "a/b"));
    QVERIFY(!std::filesystem::exists(folder / "x") && !std::filesystem::exists("/tmp/tidemark-x"));
  }

  void what_is_right_stays_when_another_object_is_wrong() {
    const ScriptedPeer peer(then([](PeerEnd& end) {
      const int ct = end.context(kCt);
      for (const auto& [instance, series] :
           {std::pair{"1.2.5", kSeries}, {"1.2.6", "1.2.99"}, {"1.2.5", kSeries}, {"1.2.7", kSeries}}) {
        end.send_command(ct, store_request(1, kCt, instance));
        end.send_data(ct, object(kCt, instance, kStudy, series));
        end.read_command();
      }
      const std::string counts = short_attribute(0, 0x1021, 3) + short_attribute(0, 0x1022, 2);
      end.send_command(1, response(kGetResponse, 1, 0xb000, false, counts));
      end.read_command();
    }));
    const TemporaryFolder folder;
    imaging::PacsLimits limits;
    limits.free_bytes = 1 << 20;
    const auto retrieved = imaging::retrieve(peer.server(), {kStudy, kSeries, folder / "in"}, limits);
    QCOMPARE(failure(retrieved), QString());
    QCOMPARE(retrieved->files.size(), std::size_t{2});
    QCOMPARE(retrieved->missing, 2);
    QCOMPARE(retrieved->refused, (std::vector<std::string>{"object 000002: belongs to another series",
                                                           "object 000003: came a second time"}));
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "in"))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    QCOMPARE(names, (std::vector<std::string>{"000001.dcm", "000004.dcm"}));
  }

  void a_request_to_stop_is_heard_within_a_second_data() {
    QTest::addColumn<Behaviour>("behave");
    QTest::newRow("while it is called") << Behaviour([](PeerEnd& end) { end.say_nothing(); });
    QTest::newRow("before it answers") << then([](PeerEnd& end) { end.say_nothing(); });
    QTest::newRow("in the midst of an object") << then([](PeerEnd& end) {
      end.send_command(end.context(kCt), store_request(1, kCt, "1.2.5"));
      while (end.send_data(end.context(kCt), std::string(1'000'000, '\0'), false)) QTest::qSleep(10);
    });
    QTest::newRow("while it stops in the midst of a PDU") << then([](PeerEnd& end) {
      end.send_command(end.context(kCt), store_request(1, kCt, "1.2.5"));
      end.write(data_pdus(end.context(kCt), false, std::string(10'000, '\0')).substr(0, 500));
      end.say_nothing();
    });
  }
  void a_request_to_stop_is_heard_within_a_second() {
    QFETCH(Behaviour, behave);
    const ScriptedPeer peer(behave);
    imaging::PacsServer server = peer.server();
    server.timeout_seconds = 60;
    const TemporaryFolder folder;
    imaging::PacsLimits limits;
    limits.free_bytes = 1 << 20;
    std::stop_source stop;
    QElapsedTimer since_stop;
    std::thread stopper([&] {
      QTest::qSleep(700);
      since_stop.start();
      stop.request_stop();
    });
    Progress progress;
    progress.stop = stop.get_token();
    const auto retrieved = imaging::retrieve(server, {kStudy, kSeries, folder / "in"}, limits, progress);
    const qint64 took = since_stop.elapsed();
    stopper.join();
    QVERIFY(!retrieved);
    QCOMPARE(retrieved.error().kind, ErrorKind::cancelled);
    QVERIFY2(took < 1000, qPrintable(QString::number(took)));
    QVERIFY(!std::filesystem::exists(folder / "in"));
  }

  void a_request_to_stop_is_heard_where_no_connection_comes_about() {
    // A machine that drops what it is sent: TEST-NET-1, which no network has (RFC 5737), or none that is
    // reachable.
    imaging::PacsServer server = ScriptedPeer([](PeerEnd&) {}).server();
    server.host = "192.0.2.1";
    server.timeout_seconds = 60;
    std::stop_source stop;
    std::thread stopper([&] {
      QTest::qSleep(300);
      stop.request_stop();
    });
    Progress progress;
    progress.stop = stop.get_token();
    QElapsedTimer timer;
    timer.start();
    const auto echoed = imaging::pacs_echo(server, progress);
    stopper.join();
    QVERIFY(!echoed);
    QVERIFY2(timer.elapsed() < 1500, qPrintable(QString::number(timer.elapsed())));
  }
};

TIDEMARK_TEST(PacsHostileTest)

}  // namespace tidemark::test::pacs_hostile_test

#include "pacs_hostile_test.moc"
