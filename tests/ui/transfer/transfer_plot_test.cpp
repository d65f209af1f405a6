// Primitives are dragged, and moved by keys, in the plots of the real editor.
#include "editor_fixture.h"
#include "tests/support/test_program.h"

namespace tidemark::test::transfer_plot_test {

class TransferPlotTest : public QObject {
  Q_OBJECT

 private slots:
  void the_centre_goes_where_the_axis_says() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    const QPoint from = f.at(kCentre);
    const ui::PlotAxis axis = f.plot().x_axis();
    f.drag(f.plot(), from, from + QPoint(40, 0));
    QVERIFY(std::abs(f.function().source[0].value.start - 40.0 * axis.extent() / (axis.to - axis.from)) <
            1e-6);
    QCOMPARE(f.function().source[0].value.end, 200.0);
    QCOMPARE(f.function().source[0].opacity, 0.25);
    QCOMPARE(f.function().source[1].value.start, 300.0);
  }

  void a_handle_is_taken_anywhere_within_its_reach() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    for (const QPoint& beside : {QPoint(5, 0), QPoint(-5, 0), QPoint(0, 5), QPoint(0, -5)}) {
      const double before = f.function().source[0].value.end;
      const QPoint from = f.at(kAbove) + beside;
      f.drag(f.plot(), from, from + QPoint(8, 0));
      QVERIFY(f.function().source[0].value.end > before);
      QCOMPARE(f.function().source[0].value.start, 0.0);
    }
  }

  void the_side_sets_the_width_and_the_peak_the_opacity() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    const ui::PlotAxis x = f.plot().x_axis();
    QPoint from = f.at(kAbove);
    f.drag(f.plot(), from, from + QPoint(-20, 7));
    QVERIFY(std::abs(f.function().source[0].value.end - (200.0 - 20.0 * x.extent() / (x.to - x.from))) <
            1e-6);
    const ui::PlotAxis y = f.plot().y_axis();
    from = f.at(kOpacity);
    f.drag(f.plot(), from, from + QPoint(11, -30));
    QVERIFY(std::abs(f.function().source[0].opacity - y.value(y.pixel(0.25) - 30.0)) < 1e-6);
    QCOMPARE(f.function().source[0].value.start, 0.0);
  }

  void every_move_is_seen_at_once() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    int changes = 0;
    connect(&f.display, &tidemark::engine::Display::changed, this, [&] { ++changes; });
    const QPoint from = f.at(kCentre);
    f.press(f.plot(), from);
    QCOMPARE(changes, 0);
    f.move(f.plot(), from, from + QPoint(40, 0));
    QCOMPARE(changes, 4);
    QVERIFY(f.function().source[0].value.start > 0.0);
    f.release(f.plot(), from + QPoint(40, 0));
    QCOMPARE(changes, 4);
  }

  void escape_takes_a_drag_back() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    const renderer::TransferFunction before = f.function();
    const QPoint from = f.at(kCentre);
    f.press(f.plot(), from);
    f.move(f.plot(), from, from + QPoint(40, 0));
    QVERIFY(!(f.function() == before));
    QTest::keyClick(&f.plot(), Qt::Key_Escape);
    QVERIFY(f.function() == before);
    f.move(f.plot(), from, from + QPoint(60, 0));
    QVERIFY(f.function() == before);
  }

  void a_click_on_a_curve_chooses_it_and_a_drag_moves_it() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    const ui::PlotAxis x = f.plot().x_axis();
    const ui::PlotAxis y = f.plot().y_axis();
    const QPoint on_ramp(static_cast<int>(x.pixel(650.0)), static_cast<int>(y.pixel(0.4)));
    const renderer::TransferFunction before = f.function();
    QTest::mouseClick(&f.plot(), Qt::LeftButton, {}, on_ramp);
    QCOMPARE(f.display.settings().chosen_primitive, 1);
    QVERIFY(f.function() == before);
    f.drag(f.plot(), on_ramp, on_ramp + QPoint(-30, 0));
    QVERIFY(f.function().source[1].value.start < 300.0);
    QVERIFY(std::abs(f.function().source[1].value.end - f.function().source[1].value.start - 400.0) < 1e-9);
  }

  void what_changes_from_outside_during_a_drag_stays() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    const QPoint from = f.at(kCentre);
    f.press(f.plot(), from);
    f.move(f.plot(), from, from + QPoint(20, 0));
    f.display.change([](engine::DisplaySettings& s) {
      s.transfer.source[0].opacity = 0.75;
      s.transfer.source[1].colour = {0.0F, 1.0F, 0.0F};
    });
    f.move(f.plot(), from + QPoint(20, 0), from + QPoint(40, 0));
    QCOMPARE(f.function().source[0].opacity, 0.75);
    QCOMPARE(f.function().source[1].colour.g, 1.0F);
    QCOMPARE(f.function().source[1].colour.r, 0.0F);
    QVERIFY(f.function().source[0].value.start > 0.0);
    f.release(f.plot(), from + QPoint(40, 0));
  }

  void a_primitive_that_vanishes_or_changes_its_kind_is_let_go() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    const QPoint from = f.at(kAbove);
    f.press(f.plot(), from);
    f.display.change([](engine::DisplaySettings& s) {
      s.transfer.source[0].value = {renderer::TransferFactor::Kind::ramp, 10.0, 20.0};
    });
    f.move(f.plot(), from, from + QPoint(40, 0));
    QVERIFY(!f.plot().dragging());
    QVERIFY((f.function().source[0].value ==
             renderer::TransferFactor{renderer::TransferFactor::Kind::ramp, 10.0, 20.0}));
    f.release(f.plot(), from);

    const QPoint again = f.at(kCentre);
    f.press(f.plot(), again);
    f.display.change([](engine::DisplaySettings& s) { s.transfer.source.clear(); });
    f.move(f.plot(), again, again + QPoint(40, 0));
    QVERIFY(f.function().source.empty());
    f.release(f.plot(), again);

    EditorFixture other;
    f.press(f.plot(), again);
    f.editor.set_display(nullptr, nullptr);
    f.move(f.plot(), again, again + QPoint(40, 0));
    QVERIFY(!f.editor.tabs()->isEnabled());
  }

  void keys_move_the_selected_handle() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    f.press(f.plot(), f.at(kCentre));
    f.release(f.plot(), f.at(kCentre));
    const double fine = f.plot().x_axis().extent() / 500.0;
    QTest::keyClick(&f.plot(), Qt::Key_Right);
    QVERIFY(std::abs(f.function().source[0].value.start - fine) < 1e-6);
    QTest::keyClick(&f.plot(), Qt::Key_Left, Qt::ShiftModifier);
    QVERIFY(std::abs(f.function().source[0].value.start + 9.0 * fine) < 1e-6);
    QTest::keyClick(&f.plot(), Qt::Key_Up);
    QCOMPARE(f.function().source[0].opacity, 0.25);
    f.press(f.plot(), f.at(kOpacity));
    f.release(f.plot(), f.at(kOpacity));
    QTest::keyClick(&f.plot(), Qt::Key_Up);
    QVERIFY(f.function().source[0].opacity > 0.25);
    QTest::keyClick(&f.plot(), Qt::Key_PageDown);
    QCOMPARE(f.display.settings().chosen_primitive, 1);
    QTest::keyClick(&f.plot(), Qt::Key_Delete);
    QCOMPARE(f.function().source.size(), std::size_t{1});
    QVERIFY(f.function().source[0].value.kind == renderer::TransferFactor::Kind::gaussian);
  }

  void tab_goes_through_the_handles_and_then_on() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    QVERIFY(QTest::qWaitForWindowActive(&f.editor));
    f.plot().setFocus(Qt::TabFocusReason);
    QTRY_VERIFY(f.plot().hasFocus());
    for (const ui::Handle& handle : f.plot().handles()) {
      QVERIFY(f.plot().hasFocus());
      QVERIFY(f.plot().selected_handle() == handle.kind);
      QTest::keyClick(&f.plot(), Qt::Key_Tab);
    }
    QVERIFY(!f.plot().hasFocus());
  }

  void the_pointer_says_what_a_drag_would_do() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    const auto over = [&](QPoint at) {
      QMouseEvent event(QEvent::MouseMove, at, f.plot().mapToGlobal(at), Qt::NoButton, Qt::NoButton, {});
      QCoreApplication::sendEvent(&f.plot(), &event);
      return f.plot().cursor().shape();
    };
    QCOMPARE(over(f.at(kCentre)), Qt::SizeHorCursor);
    QCOMPARE(over(f.at(kOpacity)), Qt::SizeVerCursor);
    QCOMPARE(over({static_cast<int>(f.plot().x_axis().pixel(790.0)), f.at(kCentre).y()}),
             Qt::PointingHandCursor);
    QCOMPARE(over({static_cast<int>(f.plot().x_axis().pixel(-900.0)), 20}), Qt::ArrowCursor);
  }

  void an_ellipse_is_dragged_along_both_axes() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    f.display.change([](engine::DisplaySettings& s) {
      s.transfer.source[0].gradient = {renderer::TransferFactor::Kind::gaussian, 200.0, 50.0};
    });
    const auto switches = f.editor.volume_page()->findChildren<QAbstractButton*>();
    for (QAbstractButton* button : switches) {
      if (button->text().contains("gradient")) QTest::mouseClick(button, Qt::LeftButton);
    }
    const ui::HandleKind middle{ui::Grip::whole, ui::Grip::whole, false};
    const ui::PlotAxis x = f.plot().x_axis();
    const ui::PlotAxis y = f.plot().y_axis();
    const QPoint from = f.at(middle);
    QVERIFY(from.x() > 0);
    f.drag(f.plot(), from, from + QPoint(-24, 16));
    QVERIFY(std::abs(f.function().source[0].value.start - x.value(x.pixel(0.0) - 24.0)) < 1e-6);
    QVERIFY(std::abs(f.function().source[0].gradient.start - y.value(y.pixel(200.0) + 16.0)) < 1e-6);
    const QPoint top = f.at({ui::Grip::none, ui::Grip::above, false});
    f.drag(f.plot(), top, top + QPoint(0, -10));
    QVERIFY(f.function().source[0].gradient.end > 50.0);
    QCOMPARE(f.function().source[0].value.end, 200.0);
  }

  void what_lies_beyond_the_common_values_is_within_reach() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    f.display.change([](engine::DisplaySettings& s) {
      s.transfer.source[0].value = {renderer::TransferFactor::Kind::ramp, 900.0, 2000.0};
    });
    for (const ui::Handle& handle : f.plot().handles()) {
      QVERIFY(handle.at.x > f.plot().x_axis().low);
      QVERIFY(handle.at.x < f.plot().x_axis().high);
    }
    const QPoint end = f.at({ui::Grip::end, ui::Grip::none, false});
    f.drag(f.plot(), end, end + QPoint(-20, 0));
    QVERIFY(f.function().source[0].value.end < 2000.0);
    QCOMPARE(f.function().source[0].value.start, 900.0);
  }

  void ctrl_and_wheel_zoom_about_the_pointer() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    const ui::PlotAxis before = f.plot().x_axis();
    const QPointF at(before.pixel(100.0), 60.0);
    const auto wheel = [&](Qt::KeyboardModifiers keys) {
      QWheelEvent event(at, f.plot().mapToGlobal(at), {}, {0, 240}, Qt::NoButton, keys, Qt::NoScrollPhase,
                        false);
      QCoreApplication::sendEvent(&f.plot(), &event);
    };
    wheel({});
    QCOMPARE(f.plot().x_axis().extent(), before.extent());
    wheel(Qt::ControlModifier);
    QVERIFY(std::abs(f.plot().x_axis().extent() - 0.64 * before.extent()) < 1e-6);
    QVERIFY(std::abs(f.plot().x_axis().value(at.x()) - 100.0) < 1e-6);
    QTest::keyClick(&f.plot(), Qt::Key_0);
    QCOMPARE(f.plot().x_axis().extent(), before.extent());
  }
};

TIDEMARK_TEST(TransferPlotTest)

}  // namespace tidemark::test::transfer_plot_test

#include "transfer_plot_test.moc"
