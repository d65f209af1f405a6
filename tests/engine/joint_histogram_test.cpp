// The joint histogram of two images, and where strokes lie in it.
#include "engine/joint_histogram.h"

#include <QSignalSpy>
#include <QTest>
#include <numeric>

#include "tests/support/test_program.h"

namespace tidemark::test::joint_histogram_test {

using namespace std::chrono_literals;

namespace {

// Of 40 x 40 x 2 voxels: the first image rises along x, the second along y.
std::shared_ptr<const Volume> ramp(int axis) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = {40, 40, 2};
  std::vector<float> values;
  for (int i = 0; i < 3200; ++i)
    values.push_back(static_cast<float>(axis == 0 ? i % 40 : i / 40 % 40) * 10.0F);
  volume->voxels = std::move(values);
  return volume;
}

std::shared_ptr<document::CaseImage> image(int axis) {
  auto made = std::make_shared<document::CaseImage>();
  made->volume = ramp(axis);
  return made;
}

}  // namespace

class JointHistogramTest : public QObject {
  Q_OBJECT

 private slots:
  void every_voxel_counts_at_its_pair_of_values() {
    const engine::JointHistogram joint = engine::joint_histogram(*ramp(0), *ramp(1), nullptr);
    QCOMPARE(std::accumulate(joint.counts.begin(), joint.counts.end(), std::int64_t{0}), std::int64_t{3200});
    QCOMPARE(joint.ranges[0], ramp(0)->common_range());
    // Independent images: all 40 x 40 pairs, two voxels each, but for the ends that are gathered in one bin.
    const auto filled = std::ranges::count_if(joint.counts, [](std::int64_t count) { return count == 2; });
    QVERIFY2(filled >= 36 * 36, qPrintable(QString::number(filled)));
    QVERIFY(joint.inside.empty() && joint.outside.empty());
    // An image against itself: on the diagonal alone.
    const engine::JointHistogram same = engine::joint_histogram(*ramp(0), *ramp(0), nullptr);
    for (int y = 0; y < engine::JointHistogram::kBins; ++y) {
      for (int x = 0; x < engine::JointHistogram::kBins; ++x)
        QVERIFY(x == y || same.counts[static_cast<std::size_t>(x + engine::JointHistogram::kBins * y)] == 0);
    }
  }

  void what_lies_far_beyond_the_common_values_is_in_the_last_bin() {
    const auto bright = std::make_shared<Volume>(*ramp(1));
    std::get<std::vector<float>>(bright->voxels).front() = 3e38F;
    QCOMPARE(bright->common_range(), ramp(1)->common_range());
    std::vector<std::int64_t> expected = engine::joint_histogram(*ramp(0), *ramp(1), nullptr).counts;
    --expected.front();
    ++expected[static_cast<std::size_t>(engine::JointHistogram::kBins) * (engine::JointHistogram::kBins - 1)];
    QCOMPARE(engine::joint_histogram(*ramp(0), *bright, nullptr).counts, expected);
  }

  void strokes_are_points_at_their_values() {
    solver::Strokes strokes;
    strokes.inside = {10 + 40 * 30};
    strokes.outside = {39, 40 * 39};
    const engine::JointHistogram joint = engine::joint_histogram(*ramp(0), *ramp(1), &strokes);
    QCOMPARE(joint.inside.size(), std::size_t{1});
    QVERIFY(std::abs(joint.inside[0][0] - 10.0F / 39.0F) < 0.02F);
    QVERIFY(std::abs(joint.inside[0][1] - 30.0F / 39.0F) < 0.02F);
    QCOMPARE(joint.outside.size(), std::size_t{2});
    QVERIFY(joint.outside[0][0] > 0.98F && joint.outside[0][1] < 0.02F);
    QVERIFY(joint.outside[1][0] < 0.02F && joint.outside[1][1] > 0.98F);
  }

  void the_newest_question_is_answered() {
    engine::JointCounter counter;
    auto strokes = std::make_shared<solver::Strokes>();
    strokes->inside = {0};
    counter.ask({ramp(0), image(0), nullptr});
    counter.ask({ramp(0), image(1), strokes});
    QVERIFY(!counter.answer());  // counted elsewhere
    QTRY_VERIFY(counter.answer());
    QCOMPARE(counter.answer()->inside.size(), std::size_t{1});
    counter.forget();
    QVERIFY(!counter.answer());
  }

  void other_images_have_no_answer_until_they_are_counted() {
    engine::JointCounter counter;
    const auto first = ramp(0);
    const auto second = image(1);
    counter.ask({first, second, nullptr});
    QTRY_VERIFY(counter.answer());
    counter.ask({first, second, std::make_shared<solver::Strokes>()});
    QVERIFY(counter.answer());  // of the same images
    counter.ask({first, image(0), nullptr});
    QVERIFY(!counter.answer());
    QTRY_VERIFY(counter.answer());
  }

  void images_that_share_no_place_are_told_of() {
    engine::JointCounter counter;
    const auto first = ramp(0);
    const auto elsewhere = image(1);
    elsewhere->to_case[3] = {1000.0, 0.0, 0.0, 1.0};
    counter.ask({first, elsewhere, nullptr});
    QTRY_VERIFY(!counter.problem().isEmpty());
    QVERIFY2(counter.problem().contains("elsewhere"), qPrintable(counter.problem()));
    QVERIFY(!counter.answer());
    QSignalSpy answered(&counter, &engine::JointCounter::answered);
    counter.ask({first, elsewhere, nullptr});
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
    QCOMPARE(answered.size(), 0);  // nothing has changed
  }

  void a_count_that_lacks_memory_can_be_asked_for_again() {
    engine::JointCounter counter;
    counter.ask({ramp(0), image(1), nullptr});
    QTRY_VERIFY(counter.answer());
    const auto huge = std::make_shared<Volume>();
    huge->geometry.size = {1 << 21, 1 << 20, 1 << 20};  // no vector can be so long
    const engine::JointCounter::Question question{huge, image(1), nullptr};
    QSignalSpy answered(&counter, &engine::JointCounter::answered);
    for (int times = 1; times <= 2; ++times) {
      counter.ask(question);
      QTRY_COMPARE(answered.size(), times);
      QVERIFY(!counter.answer());
      QVERIFY(!counter.problem().isEmpty());
    }
  }
};

TIDEMARK_TEST(JointHistogramTest)

}  // namespace tidemark::test::joint_histogram_test

#include "joint_histogram_test.moc"
