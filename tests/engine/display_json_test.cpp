// The display as a session file keeps it.
#include "engine/display_json.h"
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
};

TIDEMARK_TEST(DisplayJsonTest)

}  // namespace tidemark::test::display_json_test

#include "display_json_test.moc"
