// Presets and files of transfer functions. Needs no OpenGL.
#include <QTest>

#include "renderer/transfer_function.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::transfer_function_test {

class TransferFunctionTest : public QObject {
  Q_OBJECT

 private slots:
  void every_preset_can_be_used() {
    const std::vector<std::string> names = renderer::preset_names();
    QVERIFY(names.size() >= 6);
    for (const std::string& name : names) {
      const auto function = renderer::preset(name);
      QVERIFY2(function.has_value(), name.c_str());
      QVERIFY(!function->name.empty());
      QVERIFY(!function->source.empty() || !function->surface.empty());
    }
    const auto unknown = renderer::preset("ct-none");
    QCOMPARE(unknown.error().kind, ErrorKind::usage);
    QVERIFY(unknown.error().message.find("ct-bone") != std::string::npos);
  }

  void primitives_are_read() {
    const auto function = renderer::TransferFunction::parse(
        R"({"name": "x", "source": [
          {"value": {"gaussian": [40, 10]}, "phi": {"ramp": [0, 1]}, "opacity": 0.5, "colour": [1, 0.5, 0]},
          {"value": {"ramp": [300, 200]}, "gradient": {"gaussian": [5, 1]}, "opacity": 1, "colour": [0, 0, 2]}],
        "surface": [{"distance": {"ramp": [20, 0]}, "opacity": 0.7, "colour": [0.1, 0.2, 0.3]}]})");
    QCOMPARE(failure(function), QString());
    QCOMPARE(function->source.size(), std::size_t{2});
    QVERIFY((function->source[0].value ==
             renderer::TransferFactor{renderer::TransferFactor::Kind::gaussian, 40.0, 10.0}));
    QVERIFY((function->source[0].phi ==
             renderer::TransferFactor{renderer::TransferFactor::Kind::ramp, 0.0, 1.0}));
    QVERIFY(function->source[0].gradient.kind == renderer::TransferFactor::Kind::everything);
    QVERIFY(function->source[1].value.kind == renderer::TransferFactor::Kind::ramp);
    QCOMPARE(function->source[1].colour.b, 1.0F);
    QVERIFY(function->source_needs_gradient() && function->source_needs_phi());
    QCOMPARE(function->surface.size(), std::size_t{1});
    QCOMPARE(function->surface[0].distance.start, 20.0);
    QCOMPARE(function->surface[0].opacity, 0.7);
  }

  void what_is_written_is_read_as_the_same_function() {
    for (const std::string& name : renderer::preset_names()) {
      const renderer::TransferFunction function = renderer::preset(name).value();
      const auto again = renderer::TransferFunction::parse(function.to_json());
      QCOMPARE(failure(again), QString());
      QVERIFY2(*again == function, name.c_str());
    }
    renderer::TransferFunction odd = renderer::preset("ct-angio").value();
    odd.name = "a \"name\"\nin two lines, µ";
    odd.source[0].value.start = 1.0 / 3.0;
    odd.source[0].phi = {renderer::TransferFactor::Kind::gaussian, -1e-12, 1e12};
    odd.source[0].colour = {0.1F, 1.0F / 3.0F, 0.0F};
    const auto again = renderer::TransferFunction::parse(odd.to_json());
    QCOMPARE(failure(again), QString());
    QVERIFY(*again == odd);
    QVERIFY(odd.to_json().find("\"colour\":[0.1,") != std::string::npos);
  }

  void relative_values_are_shares_of_the_common_range() {
    const auto function = renderer::TransferFunction::parse(
        R"({"relative": true, "source": [{"value": {"gaussian": [0.5, 0.1]}, "gradient": {"ramp": [0, 0.25]},
            "phi": {"ramp": [-1, 1]}, "opacity": 1, "colour": [1, 1, 1]}]})");
    QCOMPARE(failure(function), QString());
    const renderer::TransferFunction own = function->for_range(-100.0, 300.0);
    QVERIFY((own.source[0].value ==
             renderer::TransferFactor{renderer::TransferFactor::Kind::gaussian, 100.0, 40.0}));
    QVERIFY((own.source[0].gradient ==
             renderer::TransferFactor{renderer::TransferFactor::Kind::ramp, 0.0, 100.0}));
    QVERIFY(own.source[0].phi == function->source[0].phi);
    QVERIFY(own.for_range(0.0, 1.0) == own);
  }

  // As where air fills nearly all of a volume.
  void a_range_of_one_value_is_one_unit_long() {
    const auto function = renderer::TransferFunction::parse(
        R"({"relative": true, "source": [{"value": {"ramp": [0.2, 0.6]}, "gradient": {"gaussian": [0.5, 0.1]},
            "opacity": 1, "colour": [1, 1, 1]}]})");
    QCOMPARE(failure(function), QString());
    const renderer::TransferFunction own = function->for_range(7.0, 7.0);
    QVERIFY(own == function->for_range(7.0, 8.0));
    QCOMPARE(own.source[0].value.at(100.0), 1.0);
    QCOMPARE(own.source[0].value.at(7.0), 0.0);
  }

  void nothing_in_a_range_is_more_opaque_than_its_bound() {
    const auto function = renderer::TransferFunction::parse(
        R"({"source": [{"value": {"gaussian": [40, 10]}, "opacity": 0.5, "colour": [1, 1, 1]},
                       {"value": {"ramp": [60, 20]}, "phi": {"ramp": [-1, 1]}, "opacity": 0.3, "colour": [1, 1, 1]}]})");
    QCOMPARE(failure(function), QString());
    for (double low = -20.0; low < 100.0; low += 7.0) {
      for (double high = low; high < 120.0; high += 9.0) {
        for (const double phi : {-2.0, 0.3, 2.0}) {
          const double most = function->most_opacity(low, high, phi, phi);
          for (double value = low; value <= high; value += 0.5) {
            double opacity = 0.0;
            for (const renderer::SourcePrimitive& p : function->source)
              opacity += p.opacity * p.value.at(value) * p.phi.at(phi);
            QVERIFY(opacity <= most + 1e-12);
          }
        }
      }
    }
  }

  void what_is_wrong_is_named_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("named");
    const auto row = [](const char* name, const QString& text, const char* named) {
      QTest::newRow(name) << text << QString(named);
    };
    row("no JSON", "{", "not JSON");
    row("relative", R"({"relative": 1, "source": []})", "relative: neither true nor false");
    row("unknown list", R"({"surfaces": []})", "'surfaces' is no field");
    row("too opaque", R"({"source": [{"value": {"ramp": [5, 6]}, "opacity": 1e7}]})",
        "source[0].opacity: 10000000 is not within");
    row("nothing", "{}", "neither 'source' nor 'surface'");
    row("no list", R"({"source": 3})", "source: not a list");
    row("no object", R"({"source": [3]})", "source[0]: not an object");
    row("unknown axis", R"({"source": [{"distance": {"ramp": [0, 1]}}]})",
        "source[0]: 'distance' is no field");
    row("unknown factor", R"({"source": [{"value": {"box": [1, 2]}}]})", "source[0].value: 'box'");
    row("two factors", R"({"source": [{"value": {"ramp": [1, 2], "gaussian": [1, 2]}}]})",
        "source[0].value:");
    row("centre", R"({"source": [{"phi": {"gaussian": ["a", 1]}}]})",
        "source[0].phi.gaussian[0]: not a number");
    row("one number", R"({"source": [{"value": {"gaussian": [1]}}]})",
        "source[0].value.gaussian: two numbers");
    row("width", R"({"source": [{"value": {"gaussian": [1, 0]}}]})", "source[0].value.gaussian: the width");
    row("ramp without length", R"({"surface": [{"intensity": {"ramp": [5, 5]}}]})",
        "surface[0].intensity.ramp: the end");
    row("no opacity", R"({"source": [{"value": {"ramp": [5, 6]}}]})", "source[0].opacity");
    row("opacity", R"({"source": [{"value": {"ramp": [5, 6]}, "opacity": -1}]})", "source[0].opacity");
    row("colour", R"({"source": [{"value": {"ramp": [5, 6]}, "opacity": 1, "colour": [1, 2]}]})",
        "source[0].colour");
    QString many = R"({"source": [)";
    for (int i = 0; i < 17; ++i) many += QString(i > 0 ? "," : "") + "{}";
    row("too many", many + "]}", "source: more than 16 entries");
  }
  void what_is_wrong_is_named() {
    QFETCH(QString, text);
    QFETCH(QString, named);
    const auto function = renderer::TransferFunction::parse(text.toStdString());
    QVERIFY(!function);
    QCOMPARE(function.error().kind, ErrorKind::input);
    QVERIFY2(QString::fromStdString(function.error().message).contains(named),
             function.error().message.c_str());
  }
};

TIDEMARK_TEST(TransferFunctionTest)

}  // namespace tidemark::test::transfer_function_test

#include "transfer_function_test.moc"
