// The certainty of a speed function, of the case that is shown.
#include "ui/panels/speed_histogram.h"

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"

namespace tidemark::test::speed_histogram_test {

class SpeedHistogramTest : public QObject {
  Q_OBJECT

 private slots:
  void it_is_of_the_case_that_is_shown() {
    PanelCase driven;
    driven.proxy->change_drive([](document::Drive& drive) { drive.setting.terms = {{"edges", {}}}; });
    QTRY_VERIFY_WITH_TIMEOUT(driven.state().speed && !driven.state().speed_waits, 60000);
    driven.wait_until_idle();
    PanelCase tent;
    const auto histogram = shown<ui::SpeedHistogram>(driven, 104);
    // What was asked about the one is no answer about the other.
    histogram->set_proxy(tent.proxy.get());
    QTest::qWait(200);
    QVERIFY(histogram->bars().empty());
    for (int time = 0; time < 2; ++time) {
      histogram->set_proxy(driven.proxy.get());
      QTRY_VERIFY(!histogram->bars().empty());
      histogram->set_proxy(tent.proxy.get());
      QVERIFY(histogram->bars().empty());
    }
    // A function that is gone has no certainty.
    histogram->set_proxy(driven.proxy.get());
    QTRY_VERIFY(!histogram->bars().empty());
    driven.proxy->undo();
    QTRY_VERIFY(!driven.state().speed);
    QVERIFY(histogram->bars().empty());
  }
};

TIDEMARK_TEST(SpeedHistogramTest)

}  // namespace tidemark::test::speed_histogram_test

#include "speed_histogram_test.moc"
