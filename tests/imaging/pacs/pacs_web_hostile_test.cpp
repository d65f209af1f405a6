// Web servers that misbehave: slow, endless, elsewhere, compressed, wrong. One clear line each, and nothing
// is left.
#include <QElapsedTimer>
#include <QScopeGuard>
#include <QTest>
#include <QtEndian>
#include <thread>

#include "core/atomic_file.h"
#include "imaging/load_study.h"
#include "imaging/pacs/services.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/pacs/scripted_peer.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::pacs_web_hostile_test {

namespace {

constexpr qint64 kSoon = 10'000;  // ms, with a patience of one second, on a busy machine
constexpr const char* kStudy = "1.2.3";

using Behaviour = ScriptedPeer::Behaviour;

std::string answer(const std::string& status, const std::string& headers, const std::string& body) {
  return fmt::format("HTTP/1.1 {}\r\n{}Content-Length: {}\r\n\r\n{}", status, headers, body.size(), body);
}

const std::string kJsonType = "Content-Type: application/dicom+json\r\n";
const std::string kPartsType = "Content-Type: multipart/related; boundary=x\r\n";

// Hears the request and says that.
Behaviour says(const std::string& bytes) {
  return [bytes](PeerEnd& end) {
    end.read_request();
    end.write(bytes);
    end.say_nothing();
  };
}

Behaviour says_again_and_again(const std::string& begin, const std::string& bytes) {
  return [begin, bytes](PeerEnd& end) {
    end.read_request();
    if (!end.write(begin)) return;
    while (!end.quits() && end.write(bytes)) {
    }
  };
}

template <class Value>
QString message(const Result<Value>& result) {
  return result ? QString("all is well") : QString::fromStdString(result.error().message);
}

imaging::PacsLimits limits() {
  imaging::PacsLimits limits;
  limits.free_bytes = 1 << 20;
  limits.object_bytes = 1 << 20;
  limits.retrieval_bytes = 2 << 20;
  limits.objects = 10;
  return limits;
}

}  // namespace

class PacsWebHostileTest : public QObject {
  Q_OBJECT

 private slots:
  void nobody_listens() {
    const imaging::PacsServer server = ScriptedPeer([](PeerEnd&) {}).web_server();  // its port is free again
    const auto echoed = imaging::pacs_echo(server);
    QVERIFY2(message(echoed).contains("cannot be called: Connection refused"), qPrintable(message(echoed)));
    QVERIFY(message(echoed).startsWith("PACS peer (http://127.0.0.1:"));
  }

  void an_unknown_host_is_named() {
    imaging::PacsServer server = ScriptedPeer([](PeerEnd&) {}).web_server();
    server.web->url = "https://no-such-host.invalid/web";
    server.timeout_seconds = 10;
    const auto echoed = imaging::pacs_echo(server);
    QVERIFY2(message(echoed).contains("its host is not known"), qPrintable(message(echoed)));
  }

  void without_authorities_the_file_is_named() {
    const ScriptedPeer peer([](PeerEnd& end) { end.say_nothing(); });
    const auto back = qScopeGuard([] { qunsetenv("SSL_CERT_FILE"); });
    qputenv("SSL_CERT_FILE", "/nowhere/authorities.crt");
    imaging::PacsServer server = peer.web_server();
    server.web->url.insert(4, "s");
    for (const std::optional<imaging::TlsFiles>& tls :
         {std::optional<imaging::TlsFiles>(), std::optional(imaging::TlsFiles())}) {
      server.tls = tls;
      const auto echoed = imaging::pacs_echo(server);
      QVERIFY2(message(echoed).contains("/nowhere/authorities.crt: no certificate can be read from it"),
               qPrintable(message(echoed)));
    }
  }

  void who_misbehaves_when_asked_is_told_off_data() {
    QTest::addColumn<Behaviour>("behave");
    QTest::addColumn<QString>("said");
    QTest::newRow("hangs up at once") << Behaviour([](PeerEnd&) {}) << "breaks off";
    QTest::newRow("hangs up in the head") << Behaviour([](PeerEnd& end) {
      end.read_request();
      end.write("HTTP/1.1 200 OK\r\nContent-Le");
    }) << "answers with '', which is not JSON";
    QTest::newRow("says nothing") << says("") << "does not answer: nothing came for 1 s";
    QTest::newRow("drips") << Behaviour([](PeerEnd& end) {
      end.read_request();
      end.write("HTTP/1.1 200 OK\r\n" + kJsonType + "\r\n");
      for (int i = 0; i < 1'000; ++i) {
        if (end.quits() || !end.write(" ")) return;
        QTest::qSleep(100);
      }
    }) << "is too slow";
    QTest::newRow("speaks another language")
        << says("220 mail.example ESMTP\r\n") << "does not answer as web servers do";
    QTest::newRow("a head without end")
        << says_again_and_again("HTTP/1.1 200 OK\r\n", "A: " + std::string(1'000, 'b') + "\r\n") << "";
    QTest::newRow("an answer without end")
        << says_again_and_again("HTTP/1.1 200 OK\r\n" + kJsonType + "\r\n[", std::string(100'000, ' '))
        << "sends more than an answer may hold";
    QTest::newRow("is elsewhere") << says(answer("302 Found", "Location: https://evil.example/web\r\n", ""))
                                  << "sends us on to https://evil.example/web: enter that address";
    QTest::newRow("wants a secret") << says(answer("401 Unauthorized", "", ""))
                                    << "(HTTP 401): it wants a secret";
    QTest::newRow("is not there") << says(answer("404 Not Found", "", "nothing"))
                                  << "has nothing at this address";
    QTest::newRow("is broken") << says(answer("500 Oops", "", std::string(200'000, 'x')))
                               << "refuses the request (HTTP 500)";
    QTest::newRow("a page") << says(answer("200 OK", "Content-Type: text/html\r\n", "<html>Log in</html>"))
                            << "answers with 'text/html', which is not JSON";
    QTest::newRow("compressed") << says(
                                       answer("200 OK", kJsonType + "Content-Encoding: gzip\r\n", "\x1f\x8b"))
                                << "compresses its answer";
    QTest::newRow("no JSON") << says(answer("200 OK", kJsonType, "[{")) << "not JSON";
    QTest::newRow("deep") << says(answer("200 OK", kJsonType, std::string(100'000, '[')))
                          << "nested more than";
    QTest::newRow("no list") << says(answer("200 OK", kJsonType, "{}")) << "not a list";
    QTest::newRow("no values") << says(answer("200 OK", kJsonType, R"([{"0020000D": {"Value": 1}}])"))
                               << "[0].0020000D.Value: not a list";
    QTest::newRow("a name of numbers")
        << says(answer("200 OK", kJsonType, R"([{"00100010": {"Value": [{"Alphabetic": 1}]}}])"))
        << "not a text";
  }
  void who_misbehaves_when_asked_is_told_off() {
    QFETCH(Behaviour, behave);
    QFETCH(QString, said);
    const ScriptedPeer peer(behave);
    QElapsedTimer timer;
    timer.start();
    const auto found = imaging::find_studies(peer.web_server(), {});
    QVERIFY2(timer.elapsed() < kSoon, qPrintable(QString::number(timer.elapsed())));
    QVERIFY(!found);
    QCOMPARE(found.error().kind, ErrorKind::input);
    QVERIFY2(message(found).startsWith("PACS peer (http://127.0.0.1:"), qPrintable(message(found)));
    QVERIFY2(message(found).contains(said), qPrintable(message(found)));
    QVERIFY2(!message(found).contains('\n') && message(found).size() < 400, qPrintable(message(found)));
  }

  void an_answer_that_goes_on_may_take_longer_than_the_patience() {
    const ScriptedPeer peer([](PeerEnd& end) {
      end.read_request();
      end.write("HTTP/1.1 200 OK\r\n" + kJsonType + "\r\n[");
      for (int i = 0; i < 12 && end.write(std::string(100'000, ' ')); ++i) QTest::qSleep(200);
      end.write("]");
    });
    QElapsedTimer timer;
    timer.start();
    const auto found = imaging::find_studies(peer.web_server(), {});
    QCOMPARE(failure(found), QString());
    QVERIFY(timer.elapsed() > 2'000);  // the patience is one second
  }

  void values_of_any_form_are_read() {
    const ScriptedPeer peer(says(answer("200 OK", kJsonType, R"([
      {"0020000D": {"vr": "UI", "Value": ["1.2.3"]},
       "00100010": {"vr": "PN", "Value": [{"Ideographic": "B"}]},
       "00201206": {"vr": "IS", "Value": ["3"]}, "00201208": {"vr": "IS", "Value": [41]},
       "00080061": {"vr": "CS", "Value": ["CT", "SEG"]}, "00080020": {"vr": "DA"},
       "00081030": {"vr": "LO", "Value": ["two\nlines"]}, "00100020": {"vr": "LO", "Value": [null]}},
      {"0020000D": {"vr": "UI", "Value": ["../etc"]}}])")));
    const auto found = imaging::find_studies(peer.web_server(), {});
    QCOMPARE(failure(found), QString());
    QCOMPARE(found->entries.size(), std::size_t{1});  // what has no UID is no study
    const imaging::PacsStudy& study = found->entries.front();
    QCOMPARE(QString::fromStdString(study.patient_name), QString("=B"));
    QCOMPARE(study.series.value_or(-1), 3);
    QCOMPARE(study.objects.value_or(-1), 41);
    QVERIFY(study.modalities == (std::vector<std::string>{"CT", "SEG"}));
    QVERIFY(study.date.empty() && study.patient_id.empty());
    QCOMPARE(QString::fromStdString(study.description), QString("two lines"));
  }

  void a_token_goes_to_the_server_and_nowhere_else() {
    const TemporaryFolder folder;
    QVERIFY(write_file(folder / "token.txt", "abc.def\n").has_value());
    std::string head;
    ScriptedPeer peer([&](PeerEnd& end) {
      head = end.read_request();
      end.write(answer("307 Moved", "Location: http://127.0.0.1:9/web\r\n", ""));
    });
    imaging::PacsServer server = peer.web_server();
    server.web->secret = folder / "token.txt";
    const auto echoed = imaging::pacs_echo(server);
    QVERIFY(!echoed);
    QVERIFY2(head.find("Authorization: Bearer abc.def\r\n") != std::string::npos, head.c_str());
    QVERIFY2(head.find("Accept: application/dicom+json\r\n") != std::string::npos, head.c_str());
    QVERIFY2(!message(echoed).contains("abc"), qPrintable(message(echoed)));
  }

  void a_secret_of_several_lines_is_refused() {
    const TemporaryFolder folder;
    QVERIFY(write_file(folder / "token.txt", "abc\r\nX-Evil: 1\n").has_value());
    imaging::PacsServer server = ScriptedPeer([](PeerEnd&) {}).web_server();
    server.web->secret = folder / "token.txt";
    const auto echoed = imaging::pacs_echo(server);
    QVERIFY2(message(echoed).contains("token.txt: holds no password or token"), qPrintable(message(echoed)));
    QVERIFY2(!message(echoed).contains("abc"), qPrintable(message(echoed)));
  }

  void a_retrieval_that_fails_leaves_nothing_data() {
    QTest::addColumn<Behaviour>("behave");
    QTest::addColumn<QString>("said");
    const std::string part = "--x\r\nContent-Type: application/dicom\r\n\r\n";
    const std::string head = "HTTP/1.1 200 OK\r\n" + kPartsType + "\r\n";
    QTest::newRow("breaks off in an object") << Behaviour([=](PeerEnd& end) {
      end.read_request();
      end.write(head + part + "DICM");
    }) << "breaks off in the midst of an object";
    QTest::newRow("an object without end") << says_again_and_again(head + part, std::string(100'000, 'x'))
                                           << "an object of more than the 1 MiB that are allowed";
    QTest::newRow("objects without end")
        << says_again_and_again(head, part + "x\r\n") << "more than the 10 objects that are allowed";
    QTest::newRow("no objects") << says(answer("200 OK", kPartsType, part + "no DICOM\r\n--x--"))
                                << "none of the objects that came can be taken";
    QTest::newRow("a page") << says(answer("200 OK", "Content-Type: text/html\r\n", "<html>"))
                            << "names no boundary";
    QTest::newRow("nothing") << says(answer("200 OK", kPartsType, "--x--")) << "the server has nothing";
    QTest::newRow("not there") << says(answer("404 Not Found", "", "")) << "the server has nothing";
    QTest::newRow("broken") << says(answer("503 Busy", "", "")) << "refuses the request (HTTP 503)";
    QTest::newRow("headers without end")
        << says_again_and_again(head + "--x\r\n", std::string(1'000, 'a')) << "headers have no end";
  }
  void a_retrieval_that_fails_leaves_nothing() {
    QFETCH(Behaviour, behave);
    QFETCH(QString, said);
    const ScriptedPeer peer(behave);
    const TemporaryFolder folder;
    const auto retrieved = imaging::retrieve(peer.web_server(), {kStudy, {}, folder / "back"}, limits());
    QVERIFY(!retrieved);
    QCOMPARE(retrieved.error().kind, ErrorKind::input);
    QVERIFY2(message(retrieved).contains(said), qPrintable(message(retrieved)));
    QVERIFY(std::filesystem::is_empty(folder.path()));
  }

  void an_object_of_another_study_is_refused() {
    const TemporaryFolder folder;
    const auto files = write_series(sample_volume({4, 4, 1}), folder / "series");
    const std::string object = bytes_of(files.front()).toStdString();
    const std::string body = "--x\r\n\r\n" + object + "\r\n--x--";
    const ScriptedPeer peer(says(answer("200 OK", kPartsType, body)));
    const auto retrieved = imaging::retrieve(peer.web_server(), {kStudy, {}, folder / "back"}, limits());
    QVERIFY2(message(retrieved).contains("belongs to another study"), qPrintable(message(retrieved)));
  }

  void what_a_server_says_of_an_object_is_told_data() {
    QTest::addColumn<Behaviour>("behave");
    QTest::addColumn<QString>("unsent");
    QTest::addColumn<QString>("failure");
    const std::string failed = R"({"00081198": {"Value": [{"00081197": {"Value": [290]}}]}})";
    QTest::newRow("good") << says(answer("200 OK", kJsonType, "{}")) << ""
                          << "";
    QTest::newRow("good in XML") << says(answer("200 OK", "Content-Type: application/dicom+xml\r\n", "<a/>"))
                                 << ""
                                 << "";
    QTest::newRow("failed") << says(answer("202 Accepted", kJsonType, failed)) << "refuses it (reason 0122)"
                            << "";
    for (const char* odd : {"0", "65536", "-1", "\"0122\"", "null"}) {
      const std::string said =
          fmt::format(R"({{"00081198": {{"Value": [{{"00081197": {{"Value": [{}]}}}}]}}}})", odd);
      QTest::newRow(odd) << says(answer("200 OK", kJsonType, said)) << "refuses it (reason 0110)"
                         << "";
    }
    QTest::newRow("conflict") << says(answer("409 Conflict", kJsonType, failed)) << "refuses it (reason 0122)"
                              << "";
    QTest::newRow("conflict without words") << says(answer("409 Conflict", "", "")) << "(HTTP 409)"
                                            << "";
    QTest::newRow("too large") << says(answer("413 Too large", "", "")) << "(HTTP 413)"
                               << "";
    QTest::newRow("no right") << says(answer("403 Forbidden", "", "")) << ""
                              << "does not let us in (HTTP 403)";
    QTest::newRow("hangs up") << Behaviour([](PeerEnd& end) { end.read_request(); }) << ""
                              << "breaks off";
  }
  void what_a_server_says_of_an_object_is_told() {
    QFETCH(Behaviour, behave);
    QFETCH(QString, unsent);
    QFETCH(QString, failure);
    const ScriptedPeer peer(behave);
    const TemporaryFolder folder;
    const auto files = write_series(sample_volume({4, 4, 1}), folder / "series");
    const auto sent = imaging::send_files(peer.web_server(), files);
    if (!failure.isEmpty()) {
      QVERIFY2(message(sent).contains(failure), qPrintable(message(sent)));
      return;
    }
    QVERIFY2(sent.has_value(), qPrintable(message(sent)));
    QCOMPARE(sent->objects, unsent.isEmpty() ? 1 : 0);
    if (!unsent.isEmpty()) {
      QVERIFY2(QString::fromStdString(sent->unsent.front().reason).contains(unsent),
               sent->unsent.front().reason.c_str());
    }
  }

  void a_file_without_a_header_is_sent_with_one_data() {
    QTest::addColumn<int>("left_out");  // of the preamble, its mark and group 0002
    QTest::newRow("nothing but a dataset") << 3;
    QTest::newRow("no preamble") << 2;
    QTest::newRow("whole") << 0;
  }
  void a_file_without_a_header_is_sent_with_one() {
    QFETCH(int, left_out);
    const TemporaryFolder folder;
    const Volume volume = sample_volume({4, 4, 1});
    const auto file = write_series(volume, folder / "series").front();
    const QByteArray whole = bytes_of(file);
    // GroupLength (0002,0000) counts from behind itself.
    const auto dataset = 144 + qFromLittleEndian<quint32>(whole.constData() + 140);
    const QByteArray cut = whole.mid(left_out == 3 ? qsizetype{dataset} : left_out == 2 ? 132 : 0);
    QVERIFY(write_file(file, cut.toStdString()).has_value());
    std::string body;
    const ScriptedPeer peer([&](PeerEnd& end) {
      end.read_request(&body);
      end.write(answer("200 OK", kJsonType, ""));
    });
    const auto sent = imaging::send_files(peer.web_server(), {file});
    QVERIFY2(sent.has_value(), qPrintable(message(sent)));
    QCOMPARE(sent->objects, 1);

    const std::size_t begin = body.find("\r\n\r\n") + 4;
    const std::string object = body.substr(begin, body.rfind("\r\n--") - begin);
    QCOMPARE(object.substr(128, 4), std::string("DICM"));
    std::filesystem::create_directory(folder / "arrived");
    QVERIFY(write_file(folder / "arrived/object.dcm", object).has_value());
    const auto loaded = imaging::load_volume(folder / "arrived");
    QCOMPARE(failure(loaded), QString());
    QVERIFY(loaded->values() == volume.values());
  }

  void a_request_to_stop_ends_it_at_once_data() {
    QTest::addColumn<Behaviour>("behave");
    QTest::newRow("says nothing") << says("");
    QTest::newRow("sends without end") << says_again_and_again(
        "HTTP/1.1 200 OK\r\n" + kPartsType + "\r\n--x\r\n\r\n", std::string(1'000, 'x'));
  }
  void a_request_to_stop_ends_it_at_once() {
    QFETCH(Behaviour, behave);
    const ScriptedPeer peer(behave);
    imaging::PacsServer server = peer.web_server();
    server.timeout_seconds = 60;
    imaging::PacsLimits wide;
    wide.free_bytes = 1 << 20;
    std::stop_source stop;
    Progress progress;
    progress.stop = stop.get_token();
    std::thread stopper([&] {
      QTest::qSleep(300);
      stop.request_stop();
    });
    QElapsedTimer timer;
    timer.start();
    const TemporaryFolder folder;
    const auto retrieved = imaging::retrieve(server, {kStudy, {}, folder / "back"}, wide, progress);
    stopper.join();
    QVERIFY(!retrieved);
    QCOMPARE(retrieved.error().kind, ErrorKind::cancelled);
    QVERIFY2(timer.elapsed() < 5'000, qPrintable(QString::number(timer.elapsed())));
    QVERIFY(std::filesystem::is_empty(folder.path()));
  }
};

TIDEMARK_TEST(PacsWebHostileTest)

}  // namespace tidemark::test::pacs_web_hostile_test

#include "pacs_web_hostile_test.moc"
