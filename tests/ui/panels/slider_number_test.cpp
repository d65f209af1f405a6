#include "ui/widgets/slider_number.h"

#include <QDoubleSpinBox>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalSpy>
#include <QSlider>
#include <QVBoxLayout>
#include <QWheelEvent>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/widgets/number_box.h"
#include "ui/widgets/number_text.h"

namespace tidemark::test::slider_number_test {

class SliderNumberTest : public QObject {
  Q_OBJECT
 private slots:
  void slider_and_number_are_always_of_one_value() {
    ui::SliderNumber both;
    both.set_range(0.0, 200.0);
    both.slider()->setValue(500);
    QCOMPARE(both.value(), 100.0);
    both.number()->setValue(50.0);
    QCOMPARE(both.slider()->value(), 250);
  }

  void a_value_that_is_set_is_not_an_edit() {
    ui::SliderNumber both;
    QSignalSpy edits(&both, &ui::SliderNumber::edited);
    both.set_range(0.0, 10.0);
    both.set_value(4.0);
    QCOMPARE(both.value(), 4.0);
    QCOMPARE(edits.count(), 0);
  }

  void keys_in_quick_succession_are_one_gesture_and_later_ones_another() {
    ui::SliderNumber both;
    both.set_range(0.0, 100.0);
    QSignalSpy edits(&both, &ui::SliderNumber::edited);
    show(both);
    both.number()->setFocus();
    QTest::keyClick(both.number(), Qt::Key_Up);
    QTest::keyClick(both.number(), Qt::Key_Up);
    QTest::qWait(900);
    QTest::keyClick(both.number(), Qt::Key_Up);
    QCOMPARE(edits.count(), 3);
    QCOMPARE(edits[0][1], edits[1][1]);
    QVERIFY(edits[1][1] != edits[2][1]);
  }

  void a_logarithmic_scale_has_the_geometric_mean_in_the_middle() {
    ui::SliderNumber both;
    both.set_range(1.0, 100.0, ui::SliderNumber::Scale::logarithmic);
    both.slider()->setValue(500);
    QCOMPARE(both.value(), 10.0);
    both.set_value(1.0);
    QCOMPARE(both.slider()->value(), 0);
  }

  void a_number_beyond_the_slider_can_be_typed() {
    ui::SliderNumber both;
    both.set_range(0.0, 10.0, -100.0, 100.0);
    both.number()->setValue(70.0);
    QCOMPARE(both.value(), 70.0);
    QCOMPARE(both.slider()->value(), both.slider()->maximum());
  }

  void what_is_being_typed_is_left_alone() {
    ui::SliderNumber both;
    both.set_range(0.0, 1000.0);
    show(both);
    both.number()->setFocus();
    both.number()->selectAll();
    QTest::keyClicks(both.number(), "12");
    both.set_value(500.0);  // from elsewhere, in the middle of typing 123
    QTest::keyClicks(both.number(), "3");
    QTest::keyClick(both.number(), Qt::Key_Return);
    QCOMPARE(both.value(), 123.0);
    both.set_value(500.0);
    QCOMPARE(both.value(), 500.0);
  }

  void the_wheel_scrolls_the_panel_unless_the_number_was_chosen() {
    QScrollArea area;
    auto* content = new QWidget;
    auto* column = new QVBoxLayout(content);
    auto* both = new ui::SliderNumber;
    both->set_range(0.0, 100.0);
    both->set_value(50.0);
    auto* below = new QWidget;
    below->setMinimumHeight(2000);
    column->addWidget(both);
    column->addWidget(below);
    area.setWidget(content);
    area.setWidgetResizable(true);
    area.resize(300, 200);
    show(area);
    area.setFocus();
    turn_wheel(*both->slider());
    turn_wheel(*both->number());
    QCOMPARE(both->value(), 50.0);
    both->number()->setFocus();
    turn_wheel(*both->number());
    QVERIFY(both->value() != 50.0);
  }

  void numbers_have_as_many_digits_as_their_span_needs() {
    QCOMPARE(ui::decimals_for(4000.0), 0);
    QCOMPARE(ui::decimals_for(1.0), 3);
    QCOMPARE(ui::decimals_for(0.0), 0);
    QCOMPARE(ui::decimals_for(2e-9), 12);
    QCOMPARE(ui::value_decimals(4000.0), 1);
    QCOMPARE(ui::value_decimals(1.0), 3);
    QLocale::setDefault(QLocale(QLocale::German));
    QCOMPARE(ui::number_text(1234.56, 1, "mm"), QStringLiteral("1234,6") + QChar(QChar::Nbsp) + "mm");
    QLocale::setDefault(QLocale::c());
    QCOMPARE(ui::number_text(2e-9, ui::decimals_for(2e-9)), QStringLiteral("0.000000002000"));
    QCOMPARE(ui::size_text(12.345, 1), QStringLiteral("12.3"));
    QCOMPARE(ui::size_text(0.3, 1), QStringLiteral("0.30"));
    QCOMPARE(ui::size_text(0.0412, 1), QStringLiteral("0.041"));
    QCOMPARE(ui::size_text(0.0, 1), QStringLiteral("0.0"));
    QCOMPARE(ui::share_text(0.99999), QStringLiteral("99.9") + QChar(QChar::Nbsp) + "%");
    QCOMPARE(ui::short_text(0.0123), QStringLiteral("0.0123"));
    QCOMPARE(ui::short_text(12.345), QStringLiteral("12.3"));
    QCOMPARE(ui::short_text(0.0), QStringLiteral("0"));
  }

 private:
  static void turn_wheel(QWidget& widget) {
    const QPointF at = QRectF(widget.rect()).center();
    QWheelEvent event(at, widget.mapToGlobal(at), {}, {0, -120}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&widget, &event);
  }
};

TIDEMARK_TEST(SliderNumberTest)

}  // namespace tidemark::test::slider_number_test

#include "slider_number_test.moc"
