// What handles do to primitives, and where axes put values. Needs no window.
#include <QTest>
#include <cmath>

#include "tests/support/test_program.h"
#include "ui/transfer/primitive_handles.h"
#include "ui/widgets/plot_axis.h"

using namespace tidemark;

namespace {

using Kind = TransferFactor::Kind;

const TransferFactor kGaussian{Kind::gaussian, 40.0, 10.0};
const TransferFactor kRamp{Kind::ramp, 100.0, 200.0};
const Extent kShown{0.0, 400.0};

AxisPrimitive primitive(const TransferFactor& first, const TransferFactor& second = {}) {
  return {{first, second, {}}, 0.5, {1.0F, 0.0F, 0.0F}};
}

}  // namespace

class PrimitiveHandlesTest : public QObject {
  Q_OBJECT

 private slots:
  void a_gaussian_keeps_its_width_when_its_centre_moves() {
    QVERIFY((moved(kGaussian, Grip::whole, 70.0, 1.0) == TransferFactor{Kind::gaussian, 70.0, 10.0}));
  }

  void either_side_of_a_gaussian_sets_its_width() {
    QCOMPARE(moved(kGaussian, Grip::above, 65.0, 1.0).end, 25.0);
    QCOMPARE(moved(kGaussian, Grip::below, 35.0, 1.0).end, 5.0);
    QCOMPARE(moved(kGaussian, Grip::below, 90.0, 1.0).end, 1.0);
    QCOMPARE(moved(kGaussian, Grip::above, 65.0, 1.0).start, 40.0);
  }

  void a_ramp_keeps_its_length_when_it_is_moved() {
    QVERIFY((moved(kRamp, Grip::whole, 350.0, 1.0) == TransferFactor{Kind::ramp, 300.0, 400.0}));
  }

  void a_ramp_may_be_turned_round_but_never_without_length() {
    QVERIFY((moved(kRamp, Grip::end, 50.0, 1.0) == TransferFactor{Kind::ramp, 100.0, 50.0}));
    QVERIFY((moved(kRamp, Grip::start, 200.0, 2.0) == TransferFactor{Kind::ramp, 198.0, 200.0}));
    QVERIFY((moved(kRamp, Grip::end, 100.5, 2.0) == TransferFactor{Kind::ramp, 100.0, 102.0}));
  }

  void handles_of_a_curve_lie_on_it() {
    for (const TransferFactor& factor : {kGaussian, kRamp}) {
      const AxisPrimitive one = primitive(factor);
      const auto handles = curve_handles(one, kShown);
      QCOMPARE(handles.size(), std::size_t{4});
      for (const Handle& handle : handles) {
        if (factor.kind == Kind::gaussian && handle.kind.x == Grip::whole) {
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
    QCOMPARE(curve_handles(primitive({}), kShown).size(), std::size_t{1});
    QVERIFY(plane_handles(primitive({}), kShown, kShown).empty());
    const auto handles = plane_handles(primitive(kGaussian), kShown, kShown);
    QCOMPARE(handles.size(), std::size_t{3});
    for (const Handle& handle : handles) QCOMPARE(handle.kind.y, Grip::none);
  }

  void an_ellipse_has_handles_for_its_centre_and_both_widths() {
    const auto handles = plane_handles(primitive(kGaussian, {Kind::gaussian, 300.0, 20.0}), kShown, kShown);
    QCOMPARE(handles.size(), std::size_t{5});
    QVERIFY((handles.back().kind == HandleKind{Grip::whole, Grip::whole, false}));
    QVERIFY((handles.back().at == glm::dvec2{40.0, 300.0}));
    QVERIFY((handles[0].at == glm::dvec2{30.0, 300.0}));
    QVERIFY((handles[3].at == glm::dvec2{40.0, 320.0}));
  }

  void a_handle_moves_nothing_but_its_own() {
    const AxisPrimitive one = primitive(kGaussian, kRamp);
    const AxisPrimitive up = moved(one, {Grip::none, Grip::start, false}, {9.0, 20.0}, {1.0, 1.0});
    QVERIFY(up.factors[0] == one.factors[0]);
    QVERIFY((up.factors[1] == TransferFactor{Kind::ramp, 20.0, 200.0}));
    QCOMPARE(up.opacity, one.opacity);
    const AxisPrimitive opaque = moved(one, {Grip::none, Grip::none, true}, {9.0, 0.8}, {1.0, 1.0});
    QVERIFY(opaque.factors == one.factors);
    QCOMPARE(opaque.opacity, 0.8);
    QCOMPARE(moved(one, {Grip::none, Grip::none, true}, {9.0, -0.8}, {1.0, 1.0}).opacity, 0.0);
  }

  void a_ramp_reaches_to_the_end_of_what_is_shown() {
    QCOMPARE(reach_of(kRamp, kShown).low, 100.0);
    QCOMPARE(reach_of(kRamp, kShown).high, 400.0);
    const TransferFactor falling{Kind::ramp, 200.0, 100.0};
    QCOMPARE(reach_of(falling, kShown).low, 0.0);
    QCOMPARE(reach_of(falling, kShown).high, 200.0);
  }

  void an_axis_leads_to_pixels_and_back() {
    for (const double power : {1.0, 1.0 / 3.0}) {
      const PlotAxis axis{0.0, 8.0, 200.0, 20.0, power};
      QCOMPARE(axis.pixel(0.0), 200.0);
      QCOMPARE(axis.pixel(8.0), 20.0);
      for (const double value : {-1.0, 0.001, 1.0, 7.5, 9.0}) {
        QVERIFY(std::abs(axis.value(axis.pixel(value)) - value) < 1e-9);
      }
    }
    QCOMPARE((PlotAxis{0.0, 8.0, 0.0, 100.0, 1.0 / 3.0}.pixel(1.0)), 50.0);
  }

  void ticks_are_round_and_apart() {
    const PlotAxis axis{-1024.0, 1476.0, 0.0, 300.0};
    QCOMPARE(ticks(axis, 50.0), (std::vector<double>{-1000.0, -500.0, 0.0, 500.0, 1000.0}));
    const PlotAxis opacity{0.0, 2.0, 160.0, 0.0, 1.0 / 3.0};
    const auto values = ticks(opacity, 20.0);
    QVERIFY(values.size() >= 4);
    QCOMPARE(values.front(), 0.0);
    QCOMPARE(values.back(), 2.0);
    for (std::size_t i = 1; i < values.size(); ++i) {
      QVERIFY(opacity.pixel(values[i - 1]) - opacity.pixel(values[i]) >= 20.0);
    }
    QVERIFY((ticks(PlotAxis{1.0, 1.0, 0.0, 300.0}, 50.0).empty()));
  }

  void a_description_names_what_matters() {
    const std::vector<PrimitiveAxis> axes = {{"Value", "HU", 0, 1, {}}, {"Gradient", "HU/mm", 0, 1, {}}};
    QCOMPARE(describe(primitive(kGaussian), axes), QString::fromUtf8("Gaussian 40 ± 10\u00A0HU"));
    QCOMPARE(describe(primitive(kRamp, kGaussian), axes),
             QString::fromUtf8("Ramp 100 → 200\u00A0HU, gradient 40 ± 10\u00A0HU/mm"));
    QCOMPARE(describe(primitive({}, kGaussian), axes), QString::fromUtf8("Gradient 40 ± 10\u00A0HU/mm"));
    QCOMPARE(describe(primitive({}), axes), QString("Everything"));
  }
};

TIDEMARK_TEST(PrimitiveHandlesTest)
#include "primitive_handles_test.moc"
