// Bodies of several parts, cut at every place, and what is none.
#include <QTest>
#include <string>
#include <vector>

#include "imaging/web/multipart.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::multipart_test {

namespace {

using imaging::MultipartReader;

constexpr const char* kType = "Multipart/Related; type=\"application/dicom; x=1\"; Boundary=\"a b\"";

struct Parts {
  std::vector<std::string> ended;
  std::string open;

  imaging::MultipartSink sink() {
    return {[this]() -> Status {
              open.clear();
              return {};
            },
            [this](std::string_view bytes) -> Status {
              open += bytes;
              return {};
            },
            [this]() -> Status {
              ended.push_back(open);
              return {};
            }};
  }
};

// In pieces of so many bytes.
Status read(MultipartReader& reader, const std::string& body, std::size_t piece) {
  for (std::size_t at = 0; at < body.size(); at += piece) {
    TIDEMARK_TRY(reader.read(std::string_view(body).substr(at, piece)));
  }
  return {};
}

}  // namespace

class MultipartTest : public QObject {
  Q_OBJECT

 private slots:
  void parts_are_the_same_however_they_are_cut() {
    const std::vector<std::string> wanted{"first", "", "with \r\n--a and \r\n-- in it\r\n",
                                          std::string(3, '\0')};
    std::string body = "passed over\r\n";
    for (const std::string& part : wanted)
      body += "--a b \t\r\nContent-Type: application/dicom\r\n\r\n" + part + "\r\n";
    body += "--a b--\r\nalso passed over";
    for (std::size_t piece = 1; piece <= body.size(); ++piece) {
      Parts parts;
      auto reader = MultipartReader::create(kType, parts.sink());
      QCOMPARE(failure(reader), QString());
      QCOMPARE(failure(read(*reader, body, piece)), QString());
      QVERIFY(reader->is_complete());
      QVERIFY2(parts.ended == wanted, qPrintable(QString::number(piece)));
    }
  }

  void headers_may_be_none_and_the_first_boundary_may_be_first() {
    Parts parts;
    auto reader = MultipartReader::create("multipart/related;boundary=x", parts.sink());
    QCOMPARE(failure(reader->read("--x\r\n\r\nall\r\n--x--")), QString());
    QVERIFY(reader->is_complete());
    QVERIFY(parts.ended == std::vector<std::string>{"all"});
  }

  void what_is_cut_off_is_not_complete() {
    const std::string body = "--x\r\nA: b\r\n\r\nall\r\n--x--";
    for (std::size_t size = 0; size < body.size(); ++size) {
      Parts parts;
      auto reader = MultipartReader::create("multipart/related;boundary=x", parts.sink());
      QCOMPARE(failure(reader->read(std::string_view(body).substr(0, size))), QString());
      QVERIFY(!reader->is_complete());
    }
  }

  void what_is_none_is_refused_data() {
    QTest::addColumn<QByteArray>("type");
    QTest::addColumn<QByteArray>("body");
    QTest::addColumn<QString>("said");
    const QByteArray good = "multipart/related; boundary=x";
    QTest::newRow("a page") << QByteArray("text/html; boundary=x") << QByteArray() << "names no boundary";
    QTest::newRow("no boundary") << QByteArray("multipart/related") << QByteArray() << "names no boundary";
    QTest::newRow("an empty boundary")
        << QByteArray("multipart/related; boundary=\"\"") << QByteArray() << "names no boundary";
    QTest::newRow("a long boundary") << "multipart/related; boundary=" + QByteArray(71, 'x') << QByteArray()
                                     << "names no boundary";
    QTest::newRow("a boundary in quotes of another")
        << QByteArray("multipart/related; type=\"; boundary=x\"") << QByteArray() << "names no boundary";
    QTest::newRow("none begins") << good << QByteArray(20'000, ' ') << "none begins";
    QTest::newRow("noise after a boundary")
        << good << QByteArray("--xy\r\n\r\n") << "followed by something else";
    QTest::newRow("blanks without end") << good << "--x" + QByteArray(20'000, ' ') << "a boundary has no end";
    QTest::newRow("headers without end")
        << good << "--x\r\n" + QByteArray(20'000, 'a') << "headers have no end";
  }
  void what_is_none_is_refused() {
    QFETCH(QByteArray, type);
    QFETCH(QByteArray, body);
    QFETCH(QString, said);
    Parts parts;
    auto reader = MultipartReader::create(type.toStdString(), parts.sink());
    const Status done =
        reader ? read(*reader, body.toStdString(), 1'000) : tl::unexpected<Error>(reader.error());
    QVERIFY(!done);
    QCOMPARE(done.error().kind, ErrorKind::input);
    QVERIFY2(failure(done).contains(said), qPrintable(failure(done)));
  }

  void what_the_sink_says_ends_it() {
    Parts parts;
    imaging::MultipartSink sink = parts.sink();
    sink.take = [](std::string_view) -> Status { return fail(ErrorKind::write, "full"); };
    auto reader = MultipartReader::create("multipart/related; boundary=x", sink);
    const Status done = reader->read("--x\r\n\r\nall\r\n--x--");
    QVERIFY(!done);
    QCOMPARE(done.error().kind, ErrorKind::write);
    QVERIFY(parts.ended.empty());
  }

  void what_is_sent_can_be_read() {
    const imaging::MultipartObject one = imaging::multipart_object();
    Parts parts;
    auto reader = MultipartReader::create(one.content_type, parts.sink());
    QCOMPARE(failure(reader), QString());
    QCOMPARE(failure(read(*reader, one.before + "object" + one.after, 7)), QString());
    QVERIFY(reader->is_complete());
    QVERIFY(parts.ended == std::vector<std::string>{"object"});
    QVERIFY(imaging::multipart_object().content_type != one.content_type);
  }
};

TIDEMARK_TEST(MultipartTest)

}  // namespace tidemark::test::multipart_test

#include "multipart_test.moc"
