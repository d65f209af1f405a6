// Speed functions made in the background, where memory or threads are short.
#include "engine/speed_maker.h"

#include <pthread.h>

#include <QTest>
#include <future>
#include <new>
#include <optional>

#include "tests/support/test_program.h"

namespace tidemark::test::speed_maker_test {

using namespace std::chrono_literals;

namespace {

// Meanwhile no thread can be had: a stack is to be larger than all addresses.
class NoThreads {
 public:
  NoThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t endless;
    pthread_attr_init(&endless);
    pthread_attr_setstacksize(&endless, std::size_t{1} << 60U);
    pthread_setattr_default_np(&endless);
    pthread_attr_destroy(&endless);
  }
  ~NoThreads() {
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;

 private:
  pthread_attr_t before_{};
};

std::shared_ptr<const Volume> small_volume() {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = {12, 12, 12};
  volume->voxels = std::vector<float>(12 * 12 * 12, 1.0F);
  return volume;
}

engine::SpeedOrigin edges_of(const std::shared_ptr<const Volume>& volume) {
  engine::SpeedOrigin origin;
  origin.setting.terms = {{"edges", {}}};
  origin.volume = volume;
  return origin;
}

}  // namespace

class SpeedMakerTest : public QObject {
  Q_OBJECT

 private slots:
  void what_cannot_be_handed_over_is_told() {
    const auto volume = small_volume();
    engine::SpeedMaker maker;
    int calls = 0;
    std::promise<std::optional<ErrorKind>> told;
    maker.make(edges_of(volume), volume, {}, [&](const engine::SpeedMaker::Made& made) {
      if (++calls == 1) throw std::bad_alloc();
      told.set_value(made ? std::nullopt : std::optional(made.error().kind));
    });
    auto answer = told.get_future();
    QCOMPARE(answer.wait_for(60s), std::future_status::ready);
    QVERIFY(answer.get() == ErrorKind::capability);
  }

  void without_a_thread_there_is_an_error_at_once() {
    const auto volume = small_volume();
    engine::SpeedMaker maker;
    std::optional<engine::SpeedMaker::Made> refused;
    {
      const NoThreads none;
      maker.make(edges_of(volume), volume, {},
                 [&](engine::SpeedMaker::Made made) { refused = std::move(made); });
    }
    QVERIFY(refused);
    QVERIFY(!*refused);
    // The next one is made again.
    std::promise<bool> made_again;
    maker.make(edges_of(volume), volume, {},
               [&](const engine::SpeedMaker::Made& made) { made_again.set_value(made.has_value()); });
    auto answer = made_again.get_future();
    QCOMPARE(answer.wait_for(60s), std::future_status::ready);
    QVERIFY(answer.get());
  }
};

TIDEMARK_TEST(SpeedMakerTest)

}  // namespace tidemark::test::speed_maker_test

#include "speed_maker_test.moc"
