// The display as a session file keeps it.
#include "engine/display_json.h"

#include <algorithm>

#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::display_json_test {

class DisplayJsonTest : public QObject {
  Q_OBJECT

 private slots:
  void every_tool_comes_back() {
    for (int tool = 0; tool < engine::kTools; ++tool) {
      engine::DisplaySettings settings;
      settings.tool = static_cast<engine::Tool>(tool);
      const auto read = engine::display_settings(engine::to_json(settings), {});
      QCOMPARE(failure(read), QString());
      QCOMPARE(read->tool, settings.tool);
    }
    engine::DisplaySettings unknown;
    unknown.tool = static_cast<engine::Tool>(engine::kTools);
    const auto refused = engine::display_settings(engine::to_json(unknown), {});
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::input);
    QVERIFY(refused.error().message.find("tool") != std::string::npos);
  }

  void a_volume_of_any_values_and_any_size_loses_nothing() {
    engine::DisplaySettings settings;
    settings.images.resize(1);
    settings.images.front().window = {-1e30, 1e-12};
    settings.measurements.push_back(
        {engine::Measurement::Kind::distance, {glm::dvec3(0.0), glm::dvec3(0.001, 0.0, 0.0)}});
    for (const double brush_mm : {0.005, 4000.0}) {
      settings.window = {1e10, 2e10};
      settings.brush_mm = brush_mm;
      engine::DisplaySettings first;
      first.images.resize(1);
      const auto read = engine::display_settings(engine::to_json(settings), first);
      QCOMPARE(failure(read), QString());
      QCOMPARE(read->window, settings.window);
      QCOMPARE(read->images.front().window, settings.images.front().window);
      QVERIFY(read->measurements == settings.measurements);
      QCOMPARE(read->brush_mm, std::clamp(brush_mm, 0.01, 1000.0));
    }
  }
};

TIDEMARK_TEST(DisplayJsonTest)

}  // namespace tidemark::test::display_json_test

#include "display_json_test.moc"
