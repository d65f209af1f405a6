// The registry of speed functions: settings, their checks, and what is made of them.
#include "solver/speed/speed_registry.h"
#include "level_sets.h"
#include "solver/speed/cached_speed.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::speed_registry_test {

using namespace tidemark::solver;

namespace {

SpeedInputs ramp_inputs() {
  SpeedInputs inputs;
  inputs.source = volume_of(grid({16, 8, 8}), [](glm::dvec3 p) { return 10.0 * p.x; });
  inputs.parameters.target = 50.0;
  inputs.parameters.range = 40.0;
  return inputs;
}

SpeedSetting setting(std::vector<SpeedTerm> terms, Combine combine = Combine::least) {
  return {std::move(terms), combine};
}

double speed_at(const SpeedFunction& function, Index3 voxel) {
  double speed = 0.0;
  function.evaluate({voxel, Index3(1)}, &speed);
  return speed;
}

}  // namespace

class SpeedRegistryTest : public QObject {
  Q_OBJECT

 private slots:
  void every_kind_says_what_it_is() {
    QVERIFY(!speed_kinds().empty());
    for (const SpeedKind& kind : speed_kinds()) {
      QVERIFY2(speed_kind(kind.name) == &kind, kind.name);
      QVERIFY2(kind.make != nullptr, kind.name);
      QVERIFY2(QString(kind.text).endsWith('.') && !QString(kind.title).isEmpty(), kind.name);
      for (const SpeedParameter& number : kind.parameters) {
        QVERIFY2(number.low <= number.initial && number.initial <= number.high, number.name);
        QVERIFY2(QString(number.text).endsWith('.') && !QString(number.title).isEmpty(), number.name);
        const auto words = static_cast<double>(number.choices.size());
        QVERIFY2(words == 0.0 || words == number.high - number.low + 1.0, number.name);
      }
    }
    QVERIFY(speed_kind("brightness") == nullptr);
  }

  void what_no_function_has_is_refused_by_name() {
    QVERIFY(
        failure(check(setting({{"brightness", {}}}))).contains("there is no speed function \"brightness\""));
    QCOMPARE(failure(check(setting({{"tent", {{"radius", 3.0}}}}))),
             QString("the speed function tent has no number \"radius\""));
    QVERIFY(failure(check(setting({{"image", {{"form", 0.5}}}}))).contains("form must be a whole number"));
    QCOMPARE(failure(check(setting({}))), QString("no speed function is chosen"));
    QCOMPARE(failure(check(SpeedSetting())), QString());
    QVERIFY(!make_speed(setting({{"brightness", {}}}), ramp_inputs()));
  }

  void the_tent_alone_is_left_to_executors() {
    const auto made = make_speed(SpeedSetting(), ramp_inputs());
    QCOMPARE(failure(made), QString());
    QVERIFY(*made == nullptr);
  }

  void the_least_of_functions_lets_grow_where_all_do() {
    const auto made = make_speed(setting({{"tent", {}}, {"tent", {}}}), ramp_inputs());
    QCOMPARE(failure(made), QString());
    for (int x = 0; x < 16; ++x) {
      const double tent = std::max(-1.0, 1.0 - std::abs(10.0 * x - 50.0) / 40.0);
      QVERIFY(std::abs(speed_at(**made, {x, 3, 3}) - tent) < 1e-6);
    }
  }

  void the_product_is_that_of_probabilities() {
    const auto made = make_speed(setting({{"tent", {}}, {"tent", {}}}, Combine::product), ramp_inputs());
    QCOMPARE(failure(made), QString());
    for (int x = 0; x < 16; ++x) {
      const double p = 0.5 + 0.5 * std::max(-1.0, 1.0 - std::abs(10.0 * x - 50.0) / 40.0);
      QVERIFY(std::abs(speed_at(**made, {x, 3, 3}) - (2.0 * p * p - 1.0)) < 1e-6);
    }
  }

  void the_raw_tent_is_not_joined() {
    SpeedInputs inputs = ramp_inputs();
    inputs.parameters.data_form = DataForm::raw;
    QCOMPARE(failure(make_speed(setting({{"tent", {}}, {"tent", {}}}), inputs)),
             QString("the raw form of the tent cannot be joined with other speed functions"));
  }

  void a_cancelled_function_is_not_made() {
    std::stop_source stop;
    stop.request_stop();
    const auto made =
        make_speed(setting({{"tent", {}}, {"tent", {}}}), ramp_inputs(), {nullptr, stop.get_token()});
    QVERIFY(!made && made.error().kind == ErrorKind::cancelled);
  }
};

TIDEMARK_TEST(SpeedRegistryTest)

}  // namespace tidemark::test::speed_registry_test

#include "speed_registry_test.moc"
