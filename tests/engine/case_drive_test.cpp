// A speed function is made in the background and drives the surface from then on.
#include <algorithm>
#include <optional>

#include "engine/case_balance.h"
#include "engine/speed_sampler.h"
#include "solver/speed/speed_registry.h"
#include "tests/engine/ball_case.h"
#include "tests/support/test_program.h"

namespace tidemark::test::case_drive_test {

constexpr int kPatience = 60'000;  // ms; learning takes long under a sanitizer

class CaseDriveTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    ball_.emplace();
    proxy_ = &ball_->proxy;
  }
  void cleanup() { ball_.reset(); }

  void a_function_is_made_and_undone() {
    document::Drive drive = proxy_->drive();
    drive.setting.terms = {{"edges", {}}};
    proxy_->set_drive(drive);
    QCOMPARE(proxy_->drive().setting, drive.setting);  // the wish, at once
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().speed && !proxy_->state().speed_waits, kPatience);
    QVERIFY(ball_->failures.isEmpty());
    QCOMPARE(proxy_->state().drive.setting, drive.setting);
    const auto first = proxy_->state().speed;

    // Numbers of one gesture are one entry.
    for (const double sigma : {0.8, 1.2, 1.5}) {
      drive.setting.terms.front().values[solver::speed_kind("edges")->parameters.front().name] = sigma;
      proxy_->set_drive(drive, 99);
    }
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().speed != first && !proxy_->state().speed_waits, kPatience);
    proxy_->undo();
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().drive.setting.terms.front().values.empty(), kPatience);
    QTRY_VERIFY_WITH_TIMEOUT(!proxy_->state().speed_waits, kPatience);
    proxy_->undo();
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().drive.setting.is_tent(), kPatience);
    QVERIFY(!proxy_->state().speed);
    QCOMPARE(proxy_->drive().setting, solver::SpeedSetting());
    QVERIFY(ball_->failures.isEmpty());
  }

  void a_function_that_follows_the_surface_is_seen_before_the_first_step() {
    const glm::dvec3 middle = ball_->middle();
    const auto speed_at = [&](glm::dvec3 place_mm) {
      double speed = 0.0;
      const Index3 voxel(glm::round(proxy_->volume().geometry.to_voxel(place_mm)));
      if (proxy_->state().speed) proxy_->state().speed->evaluate({voxel, Index3(1)}, &speed);
      return speed;
    };
    document::Drive drive = proxy_->drive();
    drive.setting.terms = {{"regions", {}}};
    proxy_->set_drive(drive);
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().speed && !proxy_->state().speed_waits, kPatience);
    QCOMPARE(speed_at(middle), 0.0);  // there is no surface to follow
    document::Start start;
    start.seeds.push_back({middle, 6.0});
    proxy_->begin(start);
    QTRY_VERIFY_WITH_TIMEOUT(speed_at(middle) > 0.5, kPatience);
    QVERIFY(speed_at(middle + glm::dvec3(1.8 * kBallRadius, 0.0, 0.0)) < -0.5);
    QCOMPARE(proxy_->state().step, std::int64_t{0});
    // Paint moves the means, before a step does.
    const double before = speed_at(middle);
    proxy_->paint({middle + glm::dvec3(1.2 * kBallRadius, 0.0, 0.0), 8.0}, solver::Brush::add, 7);
    QTRY_VERIFY_WITH_TIMEOUT(speed_at(middle) != before, kPatience);
    QCOMPARE(proxy_->state().step, std::int64_t{0});
    proxy_->step(1);
    QTRY_COMPARE(proxy_->state().step, std::int64_t{1});
    QVERIFY(speed_at(middle) > 0.5);
    QVERIFY(ball_->failures.isEmpty());
  }

  // The state that undo leads to is not known here by then.
  void an_edit_right_after_undo_brings_nothing_back() {
    ball_->begin();
    const Index3 first(5, 5, 5);
    const Index3 second(40, 30, 20);
    const auto wall_at = [size = proxy_->volume().geometry.size](Index3 voxel) {
      return [size, voxel](document::Drive& drive) {
        solver::Constraints walls = drive.constraints ? *drive.constraints : solver::Constraints(size);
        walls.set(std::vector<Index3>{voxel}, solver::Constraint::wall);
        drive.constraints = std::make_shared<const solver::Constraints>(std::move(walls));
      };
    };
    proxy_->change_drive(wall_at(first), engine::CaseProxy::new_gesture());
    ball_->wait_until_idle();
    QVERIFY(proxy_->state().drive.constraints->at(first) == solver::Constraint::wall);
    proxy_->undo();
    proxy_->change_drive(wall_at(second), engine::CaseProxy::new_gesture());
    ball_->wait_until_idle();
    const auto walls = proxy_->drive().constraints;
    QVERIFY(walls && walls == proxy_->state().drive.constraints);
    QVERIFY(walls->at(second) == solver::Constraint::wall);
    QVERIFY(walls->at(first) == solver::Constraint::none);

    const solver::Parameters before = proxy_->parameters();
    proxy_->change_parameters([](solver::Parameters& parameters) { parameters.alpha = 0.25; });
    ball_->wait_until_idle();
    proxy_->undo();
    proxy_->change_parameters([](solver::Parameters& parameters) { parameters.target = 70.0; });
    ball_->wait_until_idle();
    QCOMPARE(proxy_->state().parameters.alpha, before.alpha);
    QCOMPARE(proxy_->state().parameters.target, 70.0);
    QVERIFY(proxy_->parameters() == proxy_->state().parameters);
    QVERIFY(ball_->failures.isEmpty());
  }

  void one_that_cannot_be_made_is_told_of_and_the_surface_waits() {
    ball_->begin();
    document::Drive drive = proxy_->drive();
    drive.setting.terms = {{"image", {}}};  // there is no map
    proxy_->set_drive(drive);
    QTRY_COMPARE(ball_->failures.size(), 1);
    QVERIFY2(ball_->failures.front().contains("map"), qPrintable(ball_->failures.front()));
    proxy_->play();
    QTRY_COMPARE(ball_->failures.size(), 2);
    QTRY_VERIFY_WITH_TIMEOUT(!proxy_->state().playing, kPatience);
    QCOMPARE(proxy_->state().step, std::int64_t{0});
    // With the tent it goes on.
    proxy_->set_drive({});
    proxy_->play();
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().step > 0, kPatience);
    QCOMPARE(ball_->failures.size(), 2);
  }

  // T and epsilon, which the tent has, say nothing of it.
  void without_its_function_nothing_is_said_of_the_next_step() {
    engine::CaseProxy lacking(ball_->engine, ball_study(), solver::ExecutorKind::host,
                              {ball_without_its_map(), false});
    QTRY_VERIFY_WITH_TIMEOUT(lacking.state().phi && lacking.state().lacks_speed, kPatience);
    QVERIFY(lacking.state().begun);
    QVERIFY(!engine::step_inputs(lacking.state()));
    lacking.balance().ask(ball_->middle() + glm::dvec3(6.0, 0.0, 0.0));
    QVERIFY(!lacking.balance().waits());
    lacking.set_drive({});
    QTRY_VERIFY_WITH_TIMEOUT(!lacking.state().lacks_speed, kPatience);
    QVERIFY(engine::step_inputs(lacking.state()));
    QTRY_VERIFY_WITH_TIMEOUT(lacking.balance().place(), kPatience);
  }

  void a_function_that_a_raw_tent_cannot_be_joined_with_comes_with_the_clamped_one() {
    ball_->begin();
    const auto set_form = [&](solver::DataForm form) {
      proxy_->change_parameters([form](solver::Parameters& parameters) { parameters.data_form = form; });
    };
    set_form(solver::DataForm::raw);
    document::Drive drive = proxy_->drive();
    drive.setting.terms = {{"tent", {}}, {"edges", {}}};
    proxy_->set_drive(drive);
    QTRY_COMPARE_WITH_TIMEOUT(ball_->failures.size(), 1, kPatience);
    QVERIFY2(ball_->failures.front().contains("raw form"), qPrintable(ball_->failures.front()));
    // The tent alone does not move the surface meanwhile, and a step says why.
    proxy_->step(1);
    QTRY_COMPARE_WITH_TIMEOUT(ball_->failures.size(), 2, kPatience);
    ball_->wait_until_idle();
    QCOMPARE(proxy_->state().step, std::int64_t{0});
    set_form(solver::DataForm::clamped);
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().speed && !proxy_->state().speed_waits, kPatience);
    proxy_->step(1);
    QTRY_COMPARE_WITH_TIMEOUT(proxy_->state().step, std::int64_t{1}, kPatience);
    QCOMPARE(ball_->failures.size(), 2);
  }

  void undo_to_another_function_does_not_wait_for_it() {
    ball_->begin();
    proxy_->set_drive(learning(10.0));
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().speed, kPatience);
    const auto first = proxy_->state().speed;
    proxy_->set_drive(learning(200.0));
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().speed != first && !proxy_->state().speed_waits, kPatience);
    bool seen_without = false;
    connect(proxy_, &engine::CaseProxy::state_changed, this,
            [&] { seen_without |= proxy_->state().speed_waits && !proxy_->state().speed; });
    proxy_->undo();
    proxy_->play();
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().step > 0, kPatience);
    QVERIFY(seen_without);
    QVERIFY(proxy_->state().speed);
    QCOMPARE(proxy_->state().drive.setting.terms.front().values.at("trees"), 10.0);
    QVERIFY(ball_->failures.isEmpty());
  }

  // The former function would move its surface, and the recipe would say so.
  void cases_in_lock_step_wait_for_one_that_learns() {
    engine::CaseProxy other(ball_->engine, ball_study(), solver::ExecutorKind::host);
    document::Start start;
    start.seeds.push_back({ball_->middle(), 4.0});
    other.begin(start);
    ball_->begin();
    engine::CaseProxy::play_in_lock_step({proxy_, &other});
    proxy_->set_drive(learning(10.0));
    other.step(3);
    bool is_carried_out = false;
    other.after_commands([&] { is_carried_out = true; });
    QTRY_VERIFY_WITH_TIMEOUT(is_carried_out, kPatience);
    QCOMPARE(other.state().step, std::int64_t{0});
    QCOMPARE(proxy_->state().step, std::int64_t{0});
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().speed && !proxy_->state().speed_waits, kPatience);
    other.step(3);
    QTRY_COMPARE_WITH_TIMEOUT(other.state().step, std::int64_t{3}, kPatience);
    QTRY_COMPARE_WITH_TIMEOUT(proxy_->state().step, std::int64_t{3}, kPatience);
    engine::CaseProxy::play_in_lock_step({});
  }

  void the_source_is_smoothed_while_the_surface_moves() {
    ball_->begin();
    proxy_->set_drive(learning(10.0));
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().speed, kPatience);
    const auto former = proxy_->state().speed;
    proxy_->set_pause_at_convergence(false);
    proxy_->play();
    bool seen_waiting = false;
    connect(proxy_, &engine::CaseProxy::state_changed, this,
            [&] { seen_waiting |= proxy_->state().smoothing == 1.5 && proxy_->state().speed == former; });
    double reported = -1.0;
    connect(proxy_, &engine::CaseProxy::progressed, this,
            [&](double fraction, const QString&) { reported = fraction; });
    proxy_->smooth_source(1.5);
    QTRY_COMPARE(proxy_->state().smoothed_mm, 1.5);
    QVERIFY(seen_waiting);
    QVERIFY(!proxy_->state().smoothing);
    QVERIFY(proxy_->state().speed && proxy_->state().speed != former);
    QVERIFY(proxy_->source() != proxy_->study().volume);
    QCOMPARE(reported, 1.0);
    const auto step = proxy_->state().step;
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().step > step, kPatience);
    QVERIFY(ball_->failures.isEmpty());
  }

  void smoothing_can_be_given_up() {
    proxy_->smooth_source(2.0);
    proxy_->smooth_source(3.0);  // the newest wish wins
    QTRY_COMPARE(proxy_->state().smoothed_mm, 3.0);
    proxy_->smooth_source(1.0);
    proxy_->undo();
    QTRY_VERIFY_WITH_TIMEOUT(!proxy_->state().smoothing, kPatience);
    ball_->wait_until_idle();
    QTest::qWait(300);
    QCOMPARE(proxy_->state().smoothed_mm, 3.0);
    proxy_->smooth_source(-1.0);
    QTRY_COMPARE(ball_->failures.size(), 1);
    QVERIFY(!proxy_->state().smoothing);
    QCOMPARE(proxy_->state().smoothed_mm, 3.0);
  }

  void another_target_of_a_joined_tent_learns_nothing_anew() {
    ball_->begin();
    document::Drive drive = learning(10.0);
    drive.setting.terms.push_back({"tent", {}});
    proxy_->set_drive(drive);
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().speed, kPatience);
    const auto former = proxy_->state().speed;
    bool seen_waiting = false;
    connect(proxy_, &engine::CaseProxy::state_changed, this,
            [&] { seen_waiting |= proxy_->state().speed_waits; });
    solver::Parameters parameters = proxy_->parameters();
    parameters.target += 30.0;
    proxy_->set_parameters(parameters);
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().speed != former, kPatience);
    ball_->wait_until_idle();
    QVERIFY(!seen_waiting);
    QCOMPARE(proxy_->state().parameters.target, parameters.target);
  }

  void a_stroke_moves_the_surface_by_so_many_steps() {
    const glm::dvec3 middle = ball_->middle();
    const Geometry& geometry = proxy_->volume().geometry;
    const auto voxel_at = [&](glm::dvec3 place_mm) {
      return Index3(glm::round(geometry.to_voxel(place_mm)));
    };
    const auto stroke = [&](const document::Drive& drive, const std::vector<std::int64_t>& voxels) {
      proxy_->take_stroke(whole(drive), voxels, 20);
    };
    // One kind alone teaches nothing, and the surface does not begin.
    document::Drive drive = learning(10.0);
    const auto both = drive.strokes;
    auto one_kind = std::make_shared<solver::Strokes>();
    one_kind->inside = {geometry.offset(voxel_at(middle))};
    drive.strokes = one_kind;
    drive.setting = {};
    stroke(drive, one_kind->inside);
    ball_->wait_until_idle();
    QVERIFY(!proxy_->state().begun);

    // The first stroke of the other kind begins it, by what it teaches.
    drive = learning(10.0);
    drive.strokes = both;
    stroke(drive, both->outside);
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().step == 20 && !proxy_->state().playing, kPatience);
    QVERIFY(proxy_->state().speed);
    QVERIFY(proxy_->state().phi->at(voxel_at(middle)) > 0.0F);

    // It pauses until the next function is there: all of the steps are that one's.
    const auto former = proxy_->state().speed;
    bool moved_by_former = false;
    const auto seen = connect(proxy_, &engine::CaseProxy::state_changed, this, [&] {
      moved_by_former |= proxy_->state().speed == former && proxy_->state().step > 20;
    });
    const glm::dvec3 beside = middle + glm::dvec3(0.0, 2.0 * kBallRadius, 0.0);
    QVERIFY(proxy_->state().phi->at(voxel_at(beside)) <= 0.0F);
    auto more = std::make_shared<solver::Strokes>(*both);
    const std::int64_t far = geometry.offset(voxel_at(beside));
    std::erase(more->outside, far);
    if (!std::ranges::binary_search(more->inside, far))
      more->inside.insert(std::ranges::lower_bound(more->inside, far), far);
    drive.strokes = more;
    const std::size_t entries = proxy_->state().history->size();
    stroke(drive, {far});
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().drive.strokes == drive.strokes, kPatience);
    ball_->wait_until_idle();
    QVERIFY(!moved_by_former);
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().step > 20 && !proxy_->state().playing, kPatience);
    ball_->wait_until_idle();
    disconnect(seen);
    QVERIFY(proxy_->state().step <= 40);
    // The stroke with what it adds is one entry, the run another.
    QCOMPARE(proxy_->state().history->size(), entries + 2);

    // The way back takes both.
    proxy_->undo();
    proxy_->undo();
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().drive.strokes == both, kPatience);
    ball_->wait_until_idle();
    QCOMPARE(proxy_->state().step, std::int64_t{20});
    QVERIFY(proxy_->state().phi->at(voxel_at(beside)) <= 0.0F);
    QVERIFY(ball_->failures.isEmpty());
  }

  void whatever_else_is_done_calls_off_the_motion_after_a_stroke() {
    ball_->begin();
    const document::Drive drive = learning(200.0);  // takes a while to learn
    const auto rests = [&](std::int64_t step) {
      ball_->wait_until_idle();  // the state of what was done last is there
      QTRY_VERIFY_WITH_TIMEOUT(!proxy_->state().speed_waits, kPatience);
      ball_->wait_until_idle();
      QTest::qWait(300);
      QCOMPARE(proxy_->state().step, step);
      QVERIFY(!proxy_->state().playing);
    };
    const auto another = [&] {
      document::Drive copy = drive;
      copy.strokes = std::make_shared<solver::Strokes>(*drive.strokes);
      return copy;
    };
    proxy_->take_stroke(whole(another()), {}, 20);
    proxy_->undo();
    rests(0);
    proxy_->take_stroke(whole(another()), {}, 20);
    proxy_->pause();
    rests(0);
    QVERIFY(proxy_->state().speed);
    // Play goes on until the surface rests.
    proxy_->take_stroke(whole(another()), {}, 1);
    proxy_->play();
    QTRY_VERIFY_WITH_TIMEOUT(!proxy_->state().playing && proxy_->state().step > 1, kPatience);
    // Where nothing learns from strokes, they move nothing.
    ball_->wait_until_idle();
    const std::int64_t step = proxy_->state().step;
    document::Drive tent = another();
    tent.setting = {};
    proxy_->take_stroke(whole(tent), {}, 20);
    rests(step);
    QVERIFY(!proxy_->state().speed);
    QVERIFY(ball_->failures.isEmpty());
  }

  void samples_come_from_another_thread() {
    document::Drive drive = proxy_->drive();
    drive.setting.terms = {{"edges", {}}};
    proxy_->set_drive(drive);
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().speed, kPatience);
    engine::SpeedSampler sampler;
    const Index3 size = proxy_->volume().geometry.size;
    const Index3 slice(size.x, size.y, 1);
    sampler.ask({proxy_->state().speed, {0, 0, 3}, slice});
    sampler.ask({proxy_->state().speed, {0, 0, size.z / 2}, slice});  // the newest wins
    QVERIFY(!sampler.answer());
    QTRY_VERIFY_WITH_TIMEOUT(sampler.answer(), kPatience);
    std::vector<double> expected(static_cast<std::size_t>(size.x * size.y));
    proxy_->state().speed->evaluate({{0, 0, size.z / 2}, slice}, expected.data());
    QVERIFY(*sampler.answer() == expected);
    QVERIFY(std::ranges::any_of(expected, [&](double value) { return value != expected.front(); }));
    sampler.ask({});
    QVERIFY(!sampler.answer());
  }

 private:
  // That drive in place of the present one.
  static engine::CaseProxy::DriveChange whole(const document::Drive& drive) {
    return [drive](document::Drive& present) { present = drive; };
  }
  [[nodiscard]] document::Drive learning(double trees) const {
    auto strokes = std::make_shared<solver::Strokes>();
    for (std::int64_t offset = 0; offset < proxy_->volume().geometry.voxel_count(); offset += 31)
      (proxy_->volume().value(offset) > 50.0F ? strokes->inside : strokes->outside).push_back(offset);
    document::Drive drive;
    drive.setting.terms = {{"examples", {{"trees", trees}}}};
    drive.strokes = std::move(strokes);
    return drive;
  }

  std::optional<BallCase> ball_;
  engine::CaseProxy* proxy_ = nullptr;  // its
};

TIDEMARK_TEST(CaseDriveTest)

}  // namespace tidemark::test::case_drive_test

#include "case_drive_test.moc"
