// Another band: the level set begins again, and the history leads back to the old one.
#include "cases.h"
#include "document/session_contents.h"
#include "document/session_file.h"
#include "tests/support/test_program.h"

namespace tidemark::test::band_test {

namespace {

solver::Parameters with_band(solver::Parameters parameters, std::optional<double> band) {
  parameters.band = band;
  return parameters;
}

float largest(const Seen& seen) {
  float most = 0.0F;
  for (const float value : seen.phi) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

class BandTest : public QObject {
  Q_OBJECT

 private slots:
  void another_band_begins_again_as_a_case_that_had_it_from_the_start_data() { add_executors(); }
  void another_band_begins_again_as_a_case_that_had_it_from_the_start() {
    const auto document = begun_case(this_executor());
    document::LevelSet& level_set = document->level_set();
    const auto sphere = ball_at(*document->volume(), {4, 0, 0}, 3.0);
    QCOMPARE(failure(level_set.paint(sphere, solver::Brush::add)), QString());
    run(level_set, 12);
    QCOMPARE(failure(level_set.set_parameters(with_band(level_set.parameters(), 4.0))), QString());
    QCOMPARE(level_set.step(), std::int64_t{0});
    QCOMPARE(level_set.executor().band(), 4.0);
    QVERIFY(level_set.begun());
    QCOMPARE(largest(Seen(level_set)), 4.0F);

    const auto other = make_case(lumpy_volume(), this_executor());
    document::LevelSet& from_the_start = other->level_set();
    QCOMPARE(failure(from_the_start.set_parameters(with_band(from_the_start.parameters(), 4.0))), QString());
    QCOMPARE(failure(from_the_start.begin(seed_in(*other->volume()))), QString());
    QCOMPARE(failure(from_the_start.paint(sphere, solver::Brush::add)), QString());
    QVERIFY(Seen(level_set).phi == Seen(from_the_start).phi);
    run(level_set, 9);
    run(from_the_start, 9);
    QVERIFY(Seen(level_set).phi == Seen(from_the_start).phi);
    QCOMPARE(failure(level_set.executor().validate()), QString());
  }

  void undo_leads_back_to_the_old_band_data() { add_executors(); }
  void undo_leads_back_to_the_old_band() {
    const auto document = begun_case(this_executor());
    document::LevelSet& level_set = document->level_set();
    run(level_set, 12);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen narrow(level_set);
    const std::uint64_t there = document->history().last_state();
    QCOMPARE(failure(level_set.set_parameters(with_band(level_set.parameters(), 4.0))), QString());
    run(level_set, 5);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen wide(level_set);
    const solver::Field shown = level_set.phi_at(there);
    QVERIFY(shown.dense() == narrow.phi);
    QVERIFY(shown.band < 4.0);

    QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(Seen(level_set) == narrow);
    QCOMPARE(failure(level_set.executor().validate()), QString());
    QCOMPARE(failure(document->redo()), QString());
    QCOMPARE(failure(document->redo()), QString());
    QVERIFY(Seen(level_set) == wide);
    QCOMPARE(failure(level_set.step_back(2)), QString());
    QCOMPARE(level_set.executor().band(), 4.0);
    QCOMPARE(failure(level_set.restart()), QString());
    QCOMPARE(level_set.executor().band(), 4.0);
  }

  void a_session_keeps_the_states_of_its_band() {
    const TemporaryFolder folder;
    document::StudyOrigin origin;
    origin.phantom = "lumpy";
    solver::ExecutorOptions options;
    options.threads = 1;
    const auto made = document::Case::create(lumpy_volume(), origin, lumpy_parameters(),
                                             solver::ExecutorKind::host, options);
    QCOMPARE(failure(made), QString());
    const auto& document = *made;
    document::LevelSet& level_set = document->level_set();
    QCOMPARE(failure(level_set.begin(seed_in(*document->volume()))), QString());
    run(level_set, 6);
    QCOMPARE(failure(level_set.set_parameters(with_band(level_set.parameters(), 4.0))), QString());
    run(level_set, 6);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen wide(level_set);
    const auto written = folder.path() / "band.tidemark";
    QCOMPARE(failure(document::save_session(*document, written)), QString());
    const auto read = document::load_session(written);
    QCOMPARE(failure(read), QString());
    QCOMPARE(read->history.states.size(), std::size_t{2});
    const auto restored =
        document::restore_case(*read, document->volume(), solver::ExecutorKind::host, options);
    QCOMPARE(failure(restored), QString());
    QVERIFY(Seen((*restored)->level_set()) == wide);
    QCOMPARE(failure((*restored)->undo()), QString());
    QCOMPARE((*restored)->level_set().step(), std::int64_t{0});
    QCOMPARE((*restored)->level_set().executor().band(), 4.0);
    QVERIFY(undo_text(**restored).empty());
  }

  void before_a_start_another_band_is_taken_at_once() {
    const auto document = make_case(lumpy_volume());
    document::LevelSet& level_set = document->level_set();
    QCOMPARE(failure(level_set.set_parameters(with_band(level_set.parameters(), 3.5))), QString());
    QVERIFY(!level_set.begun());
    QCOMPARE(level_set.executor().band(), 3.5);
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(level_set.executor().band() != 3.5);
    QCOMPARE(failure(level_set.set_parameters(with_band(level_set.parameters(), 1.0))),
             QStringLiteral("band W must be at least 2 voxels, got 1"));
  }

  void a_field_of_another_band_begins_again_too() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    document::Start start;
    start.from = document::FieldStart{level_set.checkpoint().value(), "another"};
    QCOMPARE(failure(level_set.begin(start)), QString());
    run(level_set, 4);
    QCOMPARE(failure(level_set.set_parameters(with_band(level_set.parameters(), 2.0))), QString());
    QCOMPARE(level_set.step(), std::int64_t{0});
    QCOMPARE(largest(Seen(level_set)), 2.0F);
    QCOMPARE(failure(level_set.executor().validate()), QString());
  }
};

TIDEMARK_TEST(BandTest)

}  // namespace tidemark::test::band_test

#include "band_test.moc"
