// The curve of how the surface has developed.
#include "document/curve.h"

#include "document/curve_json.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::curve_test {

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

// The problem, or nothing; `points` as they were read.
QString read(const std::string& text, document::Curve::Points* points = nullptr) {
  const auto json = JsonDocument::parse(text, "curve.json");
  if (!json) return test::failure(json);
  const std::string file = "curve.json";
  const JsonField root(*json, file);
  const document::Curve curve = document::read_curve(root);
  if (points != nullptr) *points = *curve.points();
  return test::failure(root.status());
}

document::Curve::Points read_back(const document::Curve::Points& points) {
  document::Curve::Points read_points;
  const QString problem = read(document::curve_json(points).dump(), &read_points);
  if (!problem.isEmpty()) qFatal("%s", qPrintable(problem));
  return read_points;
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

  void a_file_keeps_the_points_and_the_agreement_of_those_that_have_one() {
    const document::Curve::Points plain{{0, 1.5, 2.5, 0.0}, {7, 3.5, 4.5, 0.25}};
    QVERIFY(read_back(plain) == plain);
    QVERIFY(!document::curve_json(plain).contains("dice"));
    document::Curve::Points compared = plain;
    compared[1].dice = 0.875;
    compared.push_back({9, 4.0, 5.0, 0.125, 0.0});
    QVERIFY(read_back(compared) == compared);
  }

  void an_agreement_that_cannot_be_is_refused() {
    Json json = document::curve_json({{0, 1.0, 2.0, 3.0, 0.5}});
    json["dice"] = {1.5};
    QVERIFY(read(json.dump()).contains("dice"));
    json["dice"] = {0.5, 0.5};
    QVERIFY(read(json.dump()).contains("as many entries"));
  }
};

TIDEMARK_TEST(CurveTest)

}  // namespace tidemark::test::curve_test

#include "curve_test.moc"
