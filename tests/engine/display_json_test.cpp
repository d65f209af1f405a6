// The display as a session file keeps it.
#include "engine/display_json.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "document/file_limits.h"
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

  void the_line_of_a_profile_comes_back() {
    engine::DisplaySettings settings;
    settings.profile = {engine::Measurement::Kind::distance, {glm::dvec3(1.0), glm::dvec3(1.0, 2.0, 3.5)}};
    const auto read = engine::display_settings(engine::to_json(settings), {});
    QCOMPARE(failure(read), QString());
    QVERIFY(read->profile == settings.profile);
    const auto without = engine::display_settings(engine::to_json({}), {});
    QCOMPARE(failure(without), QString());
    QVERIFY(!without->profile);
  }

  void places_are_as_far_away_as_a_grid_may_be() {
    engine::DisplaySettings settings;
    settings.cursor_mm = glm::dvec3(4e9, -4e9, 0.0);
    settings.camera.focus_mm = settings.cursor_mm;
    settings.measurements = {
        {engine::Measurement::Kind::distance, {settings.cursor_mm, settings.cursor_mm + 5.0}}};
    const auto read = engine::display_settings(engine::to_json(settings), {});
    QCOMPARE(failure(read), QString());
    QVERIFY(*read == settings);
  }

  void measurements_outlive_a_view_that_makes_no_sense() {
    engine::DisplaySettings settings;
    settings.slice_zoom = -1.0;
    settings.measurements = {{engine::Measurement::Kind::distance, {glm::dvec3(0.0), glm::dvec3(5.0)}}};
    settings.profile = settings.measurements.front();
    const std::string text = engine::to_json(settings);
    QVERIFY(!engine::display_settings(text, {}));
    const auto read = engine::display_measurements(text, {});
    QCOMPARE(failure(read), QString());
    QVERIFY(read->measurements == settings.measurements);
    QVERIFY(read->profile == settings.profile);
    QCOMPARE(read->slice_zoom, 1.0);
  }

  void no_more_images_are_added_than_a_file_holds() {
    std::vector<engine::ShownImage> images;
    const auto shown = [](std::size_t number) {
      engine::ShownImage one;
      auto image = std::make_shared<document::CaseImage>();
      image->checksum = std::to_string(number);
      one.image = image;
      return one;
    };
    for (std::size_t n = 0; n < document::kMostImages; ++n)
      QCOMPARE(failure(engine::add_image(images, shown(n))), QString());
    const Status refused = engine::add_image(images, shown(document::kMostImages));
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::usage);
    QCOMPARE(images.size(), document::kMostImages);
    QCOMPARE(failure(engine::add_image(images, shown(3))), QString());  // in place of the missing one
    QCOMPARE(images.size(), document::kMostImages);
  }

  void a_plane_is_at_right_angles_data() {
    QTest::addColumn<glm::dvec3>("up");
    QTest::addColumn<bool>("is_read");
    QTest::newRow("right angles") << glm::dvec3(0.0, 0.6, 0.8) << true;
    QTest::newRow("few digits") << glm::dvec3(2e-4, 0.6, 0.8) << true;
    QTest::newRow("sheared") << glm::dvec3(0.8, 0.6, 0.0) << false;
    QTest::newRow("the same twice") << glm::dvec3(1.0, 0.0, 0.0) << false;
    QTest::newRow("opposite") << glm::dvec3(-1.0, 0.0, 0.0) << false;
  }
  void a_plane_is_at_right_angles() {
    QFETCH(glm::dvec3, up);
    QFETCH(bool, is_read);
    engine::DisplaySettings settings;
    settings.oblique = {{1.0, 0.0, 0.0}, up};
    const auto read = engine::display_settings(engine::to_json(settings), {});
    if (is_read) {
      QCOMPARE(failure(read), QString());
      QVERIFY(std::abs(glm::dot(read->oblique.right, read->oblique.up)) < 1e-12);
      QVERIFY(std::abs(glm::length(read->oblique.up) - 1.0) < 1e-12);
      QVERIFY(glm::distance(read->oblique.up, up) < 1e-3);
    } else {
      QVERIFY(!read);
      QCOMPARE(read.error().kind, ErrorKind::input);
      QVERIFY(failure(read).contains("oblique_up"));
    }
  }
};

TIDEMARK_TEST(DisplayJsonTest)

}  // namespace tidemark::test::display_json_test

#include "display_json_test.moc"
