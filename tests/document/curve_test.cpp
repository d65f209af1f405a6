// The curve of how the surface has developed.
#include "document/curve.h"

#include "tests/support/support.h"
#include "tests/support/test_program.h"

using namespace tidemark;

namespace {

document::Curve curve_of(const std::vector<std::int64_t>& steps) {
  document::Curve curve;
  for (const std::int64_t step : steps) curve.add({step, 1.0, 2.0, 3.0});
  return curve;
}

std::vector<std::int64_t> steps(const document::Curve::Points& points) {
  std::vector<std::int64_t> steps;
  for (const document::CurvePoint& point : points) steps.push_back(point.step);
  return steps;
}

}  // namespace

class CurveTest : public QObject {
  Q_OBJECT

 private slots:
  void whoever_has_the_points_keeps_them() {
    document::Curve curve = curve_of({0});
    const auto first = curve.points();
    curve.add({0, 9.0, 9.0, 9.0});  // nothing has moved
    QCOMPARE(curve.points().get(), first.get());
    curve.add({5, 1.0, 2.0, 3.0});
    QCOMPARE(steps(*curve.points()), (std::vector<std::int64_t>{0, 5}));
    QCOMPARE(steps(*first), std::vector<std::int64_t>{0});
  }

  void a_step_back_takes_the_points_from_there_on() {
    document::Curve curve = curve_of({0, 10, 20, 30});
    const auto all = curve.points();
    curve.cut(40);
    QCOMPARE(curve.points().get(), all.get());
    curve.cut(20);
    QCOMPARE(steps(*curve.points()), (std::vector<std::int64_t>{0, 10}));
    curve.cut(0);
    QVERIFY(curve.points()->empty());
  }

  void a_long_curve_is_thinned_and_keeps_its_newest_point() {
    document::Curve curve;
    for (std::int64_t step = 0; step <= 2001; ++step) curve.add({step, 0.0, 0.0, 0.0});
    QVERIFY(curve.points()->size() > 900 && curve.points()->size() < 1100);
    QCOMPARE(curve.points()->back().step, std::int64_t{2001});
  }
};

TIDEMARK_TEST(CurveTest)
#include "curve_test.moc"
