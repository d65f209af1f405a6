// How a surface has ended is told above the case, with what to try.
#include <QPushButton>
#include <random>

#include "imaging/files/volume_file.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/message_bar.h"

namespace tidemark::test::outcome_story_test {
namespace {

constexpr int kPatience = 60'000;  // ms

// A bright ball of 12 mm in the dark, with noise.
void write_noisy_ball(const std::filesystem::path& file, double deviation) {
  Volume volume;
  volume.geometry.size = Index3(40);
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, deviation);
  std::vector<std::int16_t> voxels;
  for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
    const glm::dvec3 away = glm::dvec3(volume.geometry.voxel_at(offset)) - 19.5;
    const double tissue = glm::dot(away, away) < 144.0 ? 300.0 : 0.0;
    voxels.push_back(static_cast<std::int16_t>(std::lround(tissue + noise(random))));
  }
  volume.voxels = std::move(voxels);
  const Status written = imaging::write_volume_file(volume, file);
  if (!written) qFatal("%s", written.error().message.c_str());
}

}  // namespace

class OutcomeStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() { desktop_.reset(); }
  void an_end_that_is_none_is_told_with_advice_data();
  void an_end_that_is_none_is_told_with_advice();
  void a_range_that_is_too_narrow_is_widened_by_a_click();

 private:
  void open_ball(double deviation);
  void play_to_the_end(double target, double range, double alpha, double radius_mm);
  [[nodiscard]] ui::MessageBar& bar() const { return *desktop_->window().findChild<ui::MessageBar*>(); }

  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
};

void OutcomeStoryTest::open_ball(double deviation) {
  write_noisy_ball(folder_ / "ball.nrrd", deviation);
  desktop_ = std::make_unique<Desktop>(story_executor(), QSize(900, 620));
  QVERIFY(desktop_->open(QString::fromStdString((folder_ / "ball.nrrd").string())));
  desktop_->wait_until_idle();
  bar().dismiss();  // what was told of loading
}

// From a ball in the middle, with the key that plays.
void OutcomeStoryTest::play_to_the_end(double target, double range, double alpha, double radius_mm) {
  solver::Parameters parameters = desktop_->proxy().parameters();
  parameters.target = target;
  parameters.range = range;
  parameters.alpha = alpha;
  desktop_->proxy().set_parameters(parameters);
  document::Start start;
  start.seeds.push_back({renderer::middle_of(desktop_->proxy().volume().geometry), radius_mm});
  desktop_->proxy().begin(start);
  desktop_->wait_until_idle();
  QCOMPARE(bar().text(), QString());
  desktop_->press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop_->state().converged && !desktop_->state().playing; },
                            kPatience));
  desktop_->wait_until_idle();
}

void OutcomeStoryTest::an_end_that_is_none_is_told_with_advice_data() {
  QTest::addColumn<double>("target");
  QTest::addColumn<double>("range");
  QTest::addColumn<double>("alpha");
  QTest::addColumn<QString>("function");
  QTest::addColumn<QString>("told");
  QTest::newRow("shrinks") << 300.0 << 100.0 << 0.0 << "tent"
                           << "has shrunk to nothing. Try a larger start, a wider";
  QTest::newRow("outside") << 900.0 << 100.0 << 0.8 << "tent"
                           << "no value where it began is within T";
  QTest::newRow("fills") << 150.0 << 900.0 << 0.9 << "tent"
                         << "has filled the volume";
  QTest::newRow("shrinks, without a range") << 300.0 << 100.0 << 0.0 << "edges"
                                            << "has shrunk to nothing. Try a larger start, a larger α";
}

void OutcomeStoryTest::an_end_that_is_none_is_told_with_advice() {
  QFETCH(double, target);
  QFETCH(double, range);
  QFETCH(double, alpha);
  QFETCH(QString, function);
  QFETCH(QString, told);
  open_ball(5.0);
  document::Drive drive;
  drive.setting.terms.front().function = function.toStdString();
  desktop_->proxy().set_drive(drive);
  desktop_->wait_until_idle();
  play_to_the_end(target, range, alpha, 6.0);
  QVERIFY2(bar().text().contains(told), qPrintable(bar().text()));
  QVERIFY(bar().text().contains("Try ") || bar().text().contains("Probe "));
  desktop_->screenshot(QStringLiteral("outcome-%1").arg(QTest::currentDataTag()));
  // A surface that ends well is the end of the advice.
  solver::Parameters good = desktop_->proxy().parameters();
  good.target = 300.0;
  good.range = 100.0;
  good.alpha = 0.8;
  desktop_->proxy().set_drive({});
  desktop_->proxy().set_parameters(good);
  document::Start start;
  start.seeds.push_back({renderer::middle_of(desktop_->proxy().volume().geometry), 6.0});
  desktop_->proxy().begin(start);
  desktop_->wait_until_idle();
  QCOMPARE(bar().text(), QString());
}

void OutcomeStoryTest::a_range_that_is_too_narrow_is_widened_by_a_click() {
  open_ball(20.0);
  play_to_the_end(300.0, 14.0, 0.95, 5.0);
  const double narrow_ml = desktop_->state().surface.volume_ml;
  QVERIFY2(bar().text().contains("stopped inside of like tissue"), qPrintable(bar().text()));
  const auto wider = desktop_->state().wider_range;
  QVERIFY(wider && *wider > 20.0);
  desktop_->screenshot("outcome-narrow");
  QPushButton* offer = nullptr;
  for (QPushButton* button : bar().findChildren<QPushButton*>()) {
    if (button->isVisible() && button->text().startsWith("Widen the range to")) offer = button;
  }
  QVERIFY(offer);
  const std::int64_t stopped_at = desktop_->state().step;
  QTest::mouseClick(offer, Qt::LeftButton);
  // The run may begin and end between two looks at the state.
  QVERIFY(Desktop::wait_for(
      [&] {
        const engine::CaseState& now = desktop_->state();
        return now.step > stopped_at && now.converged && !now.playing;
      },
      kPatience));
  desktop_->wait_until_idle();
  QCOMPARE(desktop_->state().parameters.range, *wider);
  QCOMPARE(bar().text(), QString());
  // The ball has 7.2 ml.
  const double found_ml = desktop_->state().surface.volume_ml;
  QVERIFY2(narrow_ml < 5.0 && std::abs(found_ml - 7.2) < 0.7,
           qPrintable(QStringLiteral("%1 and %2 ml").arg(narrow_ml).arg(found_ml)));
}

TIDEMARK_TEST(OutcomeStoryTest)

}  // namespace tidemark::test::outcome_story_test

#include "outcome_story_test.moc"
