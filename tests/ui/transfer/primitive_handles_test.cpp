// What handles do to primitives, and where axes put values. Needs no window.
#include <QTest>
#include <cmath>

#include "tests/support/test_program.h"
#include "ui/transfer/primitive_handles.h"
#include "ui/widgets/plot_axis.h"

namespace tidemark::test::primitive_handles_test {

namespace {

using Kind = renderer::TransferFactor::Kind;

const renderer::TransferFactor kGaussian{Kind::gaussian, 40.0, 10.0};
const renderer::TransferFactor kRamp{Kind::ramp, 100.0, 200.0};
const ui::Extent kShown{0.0, 400.0};

ui::AxisPrimitive primitive(const renderer::TransferFactor& first,
                            const renderer::TransferFactor& second = {}) {
  return {{first, second, {}}, 0.5, {1.0F, 0.0F, 0.0F}};
}

}  // namespace

class PrimitiveHandlesTest : public QObject {
  Q_OBJECT

 private slots:
  void a_gaussian_keeps_its_width_when_its_centre_moves() {
    QVERIFY((ui::moved(kGaussian, ui::Grip::whole, 70.0, 1.0) ==
             renderer::TransferFactor{Kind::gaussian, 70.0, 10.0}));
  }

  void either_side_of_a_gaussian_sets_its_width() {
    QCOMPARE(ui::moved(kGaussian, ui::Grip::above, 65.0, 1.0).end, 25.0);
    QCOMPARE(ui::moved(kGaussian, ui::Grip::below, 35.0, 1.0).end, 5.0);
    QCOMPARE(ui::moved(kGaussian, ui::Grip::below, 90.0, 1.0).end, 1.0);
    QCOMPARE(ui::moved(kGaussian, ui::Grip::above, 65.0, 1.0).start, 40.0);
  }

  void a_ramp_keeps_its_length_when_it_is_moved() {
    QVERIFY((ui::moved(kRamp, ui::Grip::whole, 350.0, 1.0) ==
             renderer::TransferFactor{Kind::ramp, 300.0, 400.0}));
  }

  void a_ramp_may_be_turned_round_but_never_without_length() {
    QVERIFY(
        (ui::moved(kRamp, ui::Grip::end, 50.0, 1.0) == renderer::TransferFactor{Kind::ramp, 100.0, 50.0}));
    QVERIFY((ui::moved(kRamp, ui::Grip::start, 200.0, 2.0) ==
             renderer::TransferFactor{Kind::ramp, 198.0, 200.0}));
    QVERIFY(
        (ui::moved(kRamp, ui::Grip::end, 100.5, 2.0) == renderer::TransferFactor{Kind::ramp, 100.0, 102.0}));
  }

  void handles_of_a_curve_lie_on_it() {
    for (const renderer::TransferFactor& factor : {kGaussian, kRamp}) {
      const ui::AxisPrimitive one = primitive(factor);
      const auto handles = ui::curve_handles(one, kShown);
      QCOMPARE(handles.size(), std::size_t{4});
      for (const ui::Handle& handle : handles) {
        if (factor.kind == Kind::gaussian && handle.kind.x == ui::Grip::whole) {
          QCOMPARE(handle.at.x, factor.start);  // below the peak, which is opacity's
          QVERIFY(handle.at.y < one.opacity);
        } else {
          QVERIFY(std::abs(handle.at.y - one.opacity * factor.at(handle.at.x)) < 1e-12);
        }
      }
      QVERIFY(handles.back().kind.opacity);
      QCOMPARE(handles.back().at.y, one.opacity);
    }
  }

  void what_is_everything_on_an_axis_has_no_handle_there() {
    QCOMPARE(ui::curve_handles(primitive({}), kShown).size(), std::size_t{1});
    QVERIFY(ui::plane_handles(primitive({}), kShown, kShown).empty());
    const auto handles = ui::plane_handles(primitive(kGaussian), kShown, kShown);
    QCOMPARE(handles.size(), std::size_t{3});
    for (const ui::Handle& handle : handles) QCOMPARE(handle.kind.y, ui::Grip::none);
  }

  void an_ellipse_has_handles_for_its_centre_and_both_widths() {
    const auto handles =
        ui::plane_handles(primitive(kGaussian, {Kind::gaussian, 300.0, 20.0}), kShown, kShown);
    QCOMPARE(handles.size(), std::size_t{5});
    QVERIFY((handles.back().kind == ui::HandleKind{ui::Grip::whole, ui::Grip::whole, false}));
    QVERIFY((handles.back().at == glm::dvec2{40.0, 300.0}));
    QVERIFY((handles[0].at == glm::dvec2{30.0, 300.0}));
    QVERIFY((handles[3].at == glm::dvec2{40.0, 320.0}));
  }

  void a_handle_moves_nothing_but_its_own() {
    const ui::AxisPrimitive one = primitive(kGaussian, kRamp);
    const ui::AxisPrimitive up =
        ui::moved(one, {ui::Grip::none, ui::Grip::start, false}, {9.0, 20.0}, {1.0, 1.0});
    QVERIFY(up.factors[0] == one.factors[0]);
    QVERIFY((up.factors[1] == renderer::TransferFactor{Kind::ramp, 20.0, 200.0}));
    QCOMPARE(up.opacity, one.opacity);
    const ui::AxisPrimitive opaque =
        ui::moved(one, {ui::Grip::none, ui::Grip::none, true}, {9.0, 0.8}, {1.0, 1.0});
    QVERIFY(opaque.factors == one.factors);
    QCOMPARE(opaque.opacity, 0.8);
    QCOMPARE(ui::moved(one, {ui::Grip::none, ui::Grip::none, true}, {9.0, -0.8}, {1.0, 1.0}).opacity, 0.0);
  }

  void a_ramp_reaches_to_the_end_of_what_is_shown() {
    QCOMPARE(ui::reach_of(kRamp, kShown).low, 100.0);
    QCOMPARE(ui::reach_of(kRamp, kShown).high, 400.0);
    const renderer::TransferFactor falling{Kind::ramp, 200.0, 100.0};
    QCOMPARE(ui::reach_of(falling, kShown).low, 0.0);
    QCOMPARE(ui::reach_of(falling, kShown).high, 200.0);
  }

  void an_axis_leads_to_pixels_and_back() {
    for (const double power : {1.0, 1.0 / 3.0}) {
      const ui::PlotAxis axis{0.0, 8.0, 200.0, 20.0, power};
      QCOMPARE(axis.pixel(0.0), 200.0);
      QCOMPARE(axis.pixel(8.0), 20.0);
      for (const double value : {-1.0, 0.001, 1.0, 7.5, 9.0}) {
        QVERIFY(std::abs(axis.value(axis.pixel(value)) - value) < 1e-9);
      }
    }
    QCOMPARE((ui::PlotAxis{0.0, 8.0, 0.0, 100.0, 1.0 / 3.0}.pixel(1.0)), 50.0);
  }

  void ticks_are_round_and_apart() {
    const ui::PlotAxis axis{-1024.0, 1476.0, 0.0, 300.0};
    QCOMPARE(ui::ticks(axis, 50.0), (std::vector<double>{-1000.0, -500.0, 0.0, 500.0, 1000.0}));
    const ui::PlotAxis opacity{0.0, 2.0, 160.0, 0.0, 1.0 / 3.0};
    const auto values = ui::ticks(opacity, 20.0);
    QVERIFY(values.size() >= 4);
    QCOMPARE(values.front(), 0.0);
    QCOMPARE(values.back(), 2.0);
    for (std::size_t i = 1; i < values.size(); ++i) {
      QVERIFY(opacity.pixel(values[i - 1]) - opacity.pixel(values[i]) >= 20.0);
    }
    QVERIFY((ui::ticks(ui::PlotAxis{1.0, 1.0, 0.0, 300.0}, 50.0).empty()));
  }

  void a_description_names_what_matters() {
    const std::vector<ui::PrimitiveAxis> axes = {{"Value", "HU", 0, 1, {}}, {"Gradient", "HU/mm", 0, 1, {}}};
    QCOMPARE(ui::describe(primitive(kGaussian), axes), QString::fromUtf8("Gaussian 40 ± 10\u00A0HU"));
    QCOMPARE(ui::describe(primitive(kRamp, kGaussian), axes),
             QString::fromUtf8("Ramp 100 → 200\u00A0HU, gradient 40 ± 10\u00A0HU/mm"));
    QCOMPARE(ui::describe(primitive({}, kGaussian), axes), QString::fromUtf8("Gradient 40 ± 10\u00A0HU/mm"));
    QCOMPARE(ui::describe(primitive({}), axes), QString("Everything"));
  }
};

TIDEMARK_TEST(PrimitiveHandlesTest)

}  // namespace tidemark::test::primitive_handles_test

#include "primitive_handles_test.moc"
