// Presets and files of transfer functions. Needs no OpenGL.
#include <QTest>

#include "renderer/transfer_function.h"
#include "tests/support/support.h"

using namespace tidemark;
using namespace tidemark::test;

class TransferFunctionTest : public QObject {
  Q_OBJECT

 private slots:
  void every_preset_can_be_used() {
    const std::vector<std::string> names = preset_names();
    QVERIFY(names.size() >= 6);
    for (const std::string& name : names) {
      const auto function = preset(name);
      QVERIFY2(function.has_value(), name.c_str());
      QVERIFY(!function->name.empty() && !function->source.empty());
    }
    const auto unknown = preset("ct-none");
    QCOMPARE(unknown.error().kind, ErrorKind::usage);
    QVERIFY(unknown.error().message.find("ct-bone") != std::string::npos);
  }

  void primitives_are_read() {
    const auto function = TransferFunction::parse(
        R"({"name": "x", "source": [
          {"kind": "gaussian", "centre": 40, "width": 10, "opacity": 0.5, "colour": [1, 0.5, 0]},
          {"kind": "ramp", "start": 300, "end": 200, "opacity": 1, "colour": [0, 0, 2]}]})");
    QCOMPARE(failure(function), QString());
    QCOMPARE(function->source.size(), std::size_t{2});
    QCOMPARE(function->source[0].start, 40.0);
    QCOMPARE(function->source[0].end, 10.0);
    QVERIFY(function->source[1].kind == TransferPrimitive::Kind::ramp);
    QCOMPARE(function->source[1].colour.b, 1.0F);
  }

  void what_is_wrong_is_named_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("named");
    QTest::newRow("no JSON") << "{"
                             << "not a JSON object";
    QTest::newRow("no list") << R"({"source": 3})"
                             << "source: a list";
    QTest::newRow("kind") << R"({"source": [{"kind": "box"}]})"
                          << "source[0].kind";
    QTest::newRow("kind of another type") << R"({"source": [{"kind": 7}]})"
                                          << "source[0].kind";
    QTest::newRow("centre") << R"({"source": [{"kind": "gaussian", "centre": "a"}]})"
                            << "source[0].centre";
    QTest::newRow("width") << R"({"source": [{"kind": "gaussian", "centre": 1, "width": 0, "opacity": 1}]})"
                           << "source[0].width";
    QTest::newRow("ramp without length")
        << R"({"source": [{"kind": "ramp", "start": 5, "end": 5, "opacity": 1}]})"
        << "source[0].end";
    QTest::newRow("opacity") << R"({"source": [{"kind": "ramp", "start": 5, "end": 6, "opacity": -1}]})"
                             << "source[0].opacity";
    QTest::newRow("colour")
        << R"({"source": [{"kind": "ramp", "start": 5, "end": 6, "opacity": 1, "colour": [1, 2]}]})"
        << "source[0].colour";
    QString many = R"({"source": [)";
    for (int i = 0; i < 17; ++i) many += QString(i > 0 ? "," : "") + "{}";
    QTest::newRow("too many") << many + "]}"
                              << "17 primitives";
  }
  void what_is_wrong_is_named() {
    QFETCH(QString, text);
    QFETCH(QString, named);
    const auto function = TransferFunction::parse(text.toStdString());
    QVERIFY(!function);
    QCOMPARE(function.error().kind, ErrorKind::input);
    QVERIFY2(QString::fromStdString(function.error().message).contains(named),
             function.error().message.c_str());
  }
};

QTEST_APPLESS_MAIN(TransferFunctionTest)
#include "transfer_function_test.moc"
