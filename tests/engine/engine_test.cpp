// The thread that computes and draws: what it does first, what it forgets, and what becomes of its context.
#include "engine/engine.h"

#include <QTest>
#include <latch>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/test_program.h"

namespace tidemark::test::engine_test {
namespace {

// Holds the engine's thread until it is released, so that jobs wait behind it.
class Hold {
 public:
  explicit Hold(engine::Engine& engine, engine::Priority priority = engine::Priority::edit,
                const void* owner = nullptr) {
    engine.post(priority, owner, [state = state_](const std::stop_token& stop) {
      state->begun.count_down();
      state->released.wait();
      state->told_to_stop = stop.stop_requested();
      state->ended.count_down();
    });
    state_->begun.wait();
  }
  // Whether the job saw a request to stop.
  bool release() {
    state_->released.count_down();
    state_->ended.wait();
    return state_->told_to_stop;
  }

 private:
  struct State {
    std::latch begun{1};
    std::latch released{1};
    std::latch ended{1};
    bool told_to_stop = false;
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

// Writes down on which thread it dies.
struct Mortal {
  QThread*& died_on;
  explicit Mortal(QThread*& thread) : died_on(thread) {}
  ~Mortal() { died_on = QThread::currentThread(); }
};

void wait_until_idle(const engine::Engine& engine) {
  QTRY_VERIFY_WITH_TIMEOUT(engine.idle(), 10000);
}

}  // namespace

class EngineTest : public QObject {
  Q_OBJECT

 private slots:
  void what_a_job_throws_ends_it_alone() {
    engine::Engine engine(false);
    std::vector<Error> errors;
    const auto note = [&errors](const Error& error) { errors.push_back(error); };
    engine.post(
        engine::Priority::edit, this, [](const std::stop_token&) { throw std::bad_alloc(); }, note);
    engine.post(
        engine::Priority::step, this, [](const std::stop_token&) { throw std::runtime_error("why"); }, note);
    engine.post(engine::Priority::step, this, [](const std::stop_token&) { throw std::bad_alloc(); });
    bool done = false;
    engine.post(engine::Priority::background, this, [&done](const std::stop_token&) { done = true; });
    wait_until_idle(engine);
    QVERIFY(done);
    QCOMPARE(errors.size(), std::size_t{2});
    QVERIFY(errors[0].kind == ErrorKind::capability);
    QCOMPARE(errors[1].message, std::string("why"));
  }

  void jobs_are_done_by_priority_and_then_as_they_came() {
    engine::Engine engine(false);
    Hold hold(engine);
    std::string done;  // written by the engine's thread alone, read when it is idle
    const auto post = [&](engine::Priority priority, char name) {
      engine.post(priority, this, [&done, name](const std::stop_token&) { done += name; });
    };
    post(engine::Priority::background, 'g');
    post(engine::Priority::refine, 'f');
    post(engine::Priority::step, 'e');
    post(engine::Priority::picture, 'c');
    post(engine::Priority::edit, 'a');
    post(engine::Priority::edit, 'b');
    post(engine::Priority::picture, 'd');
    QVERIFY(!hold.release());
    wait_until_idle(engine);
    QCOMPARE(done, std::string("abcdefg"));
  }

  void jobs_of_an_owner_are_forgotten_and_the_running_one_is_told() {
    engine::Engine engine(false);
    const int one = 0;
    const int other = 0;
    Hold hold(engine, engine::Priority::step, &one);
    std::string done;
    const auto freed = std::make_shared<int>();
    engine.post(engine::Priority::edit, &one, [&done, freed](const std::stop_token&) { done += "one"; });
    engine.post(engine::Priority::edit, &other, [&done](const std::stop_token&) { done += "other"; });
    QCOMPARE(freed.use_count(), 2L);
    engine.cancel(&one);
    QCOMPARE(freed.use_count(), 1L);
    QVERIFY(hold.release());
    wait_until_idle(engine);
    QCOMPARE(done, std::string("other"));
  }

  void only_what_is_less_urgent_and_of_that_owner_is_interrupted() {
    engine::Engine engine(false);
    const int one = 0;
    const int other = 0;
    const auto told = [&](engine::Priority running, engine::Priority asks, const void* whose) {
      Hold hold(engine, running, &one);
      engine.interrupt(asks, whose);
      return hold.release();
    };
    QVERIFY(told(engine::Priority::refine, engine::Priority::step, &one));
    QVERIFY(told(engine::Priority::refine, engine::Priority::step, nullptr));
    QVERIFY(!told(engine::Priority::refine, engine::Priority::step, &other));
    QVERIFY(!told(engine::Priority::step, engine::Priority::step, &one));
    QVERIFY(!told(engine::Priority::picture, engine::Priority::step, &one));
  }

  void an_engine_that_closes_does_its_edits_and_forgets_the_rest() {
    auto engine = std::make_unique<engine::Engine>(false);
    std::string done;
    const auto freed = std::make_shared<int>();
    engine->post(engine::Priority::edit, this, [&, engine = engine.get()](const std::stop_token& first) {
      // These wait behind this one when the engine closes.
      engine->post(engine::Priority::step, this, [&done, freed](const std::stop_token&) { done += "step"; });
      engine->post(engine::Priority::edit, this, [&done](const std::stop_token& stop) {
        done += stop.stop_requested() ? "edit, told to stop" : "edit";
      });
      while (!first.stop_requested()) QThread::yieldCurrentThread();
    });
    engine.reset();
    QCOMPARE(done, std::string("edit, told to stop"));
    QCOMPARE(freed.use_count(), 1L);
  }

  void what_jobs_hold_may_post_as_it_dies() {
    QThread* died_on = nullptr;
    auto engine = std::make_unique<engine::Engine>(false);
    {
      Hold hold(*engine);
      auto shared = engine->share(std::make_unique<Mortal>(died_on));
      engine->post(engine::Priority::background, this, [shared](const std::stop_token&) {});
      shared.reset();
      engine->cancel(this);  // here its last holder drops it
      hold.release();
    }
    wait_until_idle(*engine);
    QVERIFY(died_on != nullptr);
    QVERIFY(died_on != QThread::currentThread());
    // And while the engine closes.
    died_on = nullptr;
    Hold hold(*engine);
    engine->post(engine::Priority::background, this,
                 [shared = engine->share(std::make_unique<Mortal>(died_on))](const std::stop_token&) {});
    hold.release();
    engine.reset();
    QVERIFY(died_on != nullptr);
    QVERIFY(died_on != QThread::currentThread());
  }

  void without_opengl_it_computes_and_draws_all_the_same_data() {
    QTest::addColumn<QByteArray>("asked");
    QTest::addColumn<QString>("reason");
    QTest::newRow("auto") << QByteArray("auto") << "there is no OpenGL";
    QTest::newRow("host") << QByteArray("host") << "TIDEMARK_RENDERER asks for it";
    QTest::newRow("gl") << QByteArray("gl") << "there is no OpenGL for gl, which TIDEMARK_RENDERER asks for";
  }
  void without_opengl_it_computes_and_draws_all_the_same() {
    QFETCH(QByteArray, asked);
    QFETCH(QString, reason);
    const test::Variable renderer("TIDEMARK_RENDERER", asked);
    engine::Engine engine(false);
    QCOMPARE(engine.graphics(), engine::Engine::Graphics::none);
    QCOMPARE(engine.renderer(), renderer::RendererKind::host);
    QCOMPARE(QString::fromStdString(engine.renderer_reason()), reason);
    QCOMPARE(engine.pictures(), engine::Engine::Pictures::images);
    QVERIFY(!engine.graphics_problem().empty());
    QCOMPARE(engine.contexts_made(), 0);
    bool has_device = true;
    Status renewed;
    engine.post(engine::Priority::edit, this, [&](const std::stop_token&) {
      has_device = engine.device() != nullptr;
      renewed = engine.renew_graphics();
    });
    wait_until_idle(engine);
    QVERIFY(!has_device);
    QVERIFY(!renewed);
    QCOMPARE(renewed.error().kind, ErrorKind::capability);
  }

  void an_unknown_renderer_counts_as_unset_and_is_told() {
    {
      const test::Variable renderer("TIDEMARK_RENDERER", "fast");
      const engine::Engine engine(false);
      QCOMPARE(engine.renderer_reason(), std::string("there is no OpenGL"));
      QCOMPARE(engine.renderer_problem(),
               std::string("TIDEMARK_RENDERER: 'fast' is unknown; use auto, host or gl"));
    }
    const test::Variable renderer("TIDEMARK_RENDERER", "host");
    QCOMPARE(engine::Engine(false).renderer_problem(), std::string());
  }

  void the_context_belongs_to_its_thread_and_can_be_made_anew() {
    engine::Engine engine;
    QVERIFY2(engine.graphics() != engine::Engine::Graphics::none, engine.graphics_problem().c_str());
    QCOMPARE(engine.contexts_made(), 1);
    QVERIFY(engine.context() != nullptr);
    QVERIFY(engine.context()->thread() != QThread::currentThread());
    std::weak_ptr<gpu::Device> first;
    bool current = false;
    engine.post(engine::Priority::edit, this, [&](const std::stop_token&) {
      first = engine.device();
      current = QOpenGLContext::currentContext() == engine.context();
    });
    wait_until_idle(engine);
    QVERIFY(current);
    QVERIFY(!first.expired());
    Status renewed;
    engine.post(engine::Priority::edit, this,
                [&](const std::stop_token&) { renewed = engine.renew_graphics(); });
    wait_until_idle(engine);
    QVERIFY(renewed);
    QCOMPARE(engine.contexts_made(), 2);
    QVERIFY(first.expired());
  }

  void the_environment_says_who_draws_and_how_pictures_are_handed_on_data() {
    QTest::addColumn<QByteArray>("renderer");
    QTest::addColumn<QByteArray>("pictures");
    QTest::addColumn<bool>("by_gl");
    QTest::addColumn<bool>("textures");
    QTest::newRow("gl, images") << QByteArray("gl") << QByteArray("images") << true << false;
    QTest::newRow("gl, textures") << QByteArray("gl") << QByteArray("textures") << true << true;
    QTest::newRow("host") << QByteArray("host") << QByteArray("textures") << false << false;
  }
  void the_environment_says_who_draws_and_how_pictures_are_handed_on() {
    QFETCH(QByteArray, renderer);
    QFETCH(QByteArray, pictures);
    QFETCH(bool, by_gl);
    QFETCH(bool, textures);
    const test::Variable asked_renderer("TIDEMARK_RENDERER", renderer);
    const test::Variable asked_pictures("TIDEMARK_PICTURES", pictures);
    const engine::Engine engine;
    QCOMPARE(engine.renderer() == renderer::RendererKind::gl, by_gl);
    QCOMPARE(engine.renderer_reason(), std::string("TIDEMARK_RENDERER asks for it"));
    QCOMPARE(engine.pictures() == engine::Engine::Pictures::textures, textures);
  }

  void a_gpu_draws_and_else_the_processor() {
    const engine::Engine engine;
    const bool has_gpu = engine.graphics() == engine::Engine::Graphics::hardware;
    QCOMPARE(engine.renderer() == renderer::RendererKind::gl, has_gpu);
    QCOMPARE(engine.renderer_reason(), std::string(has_gpu ? "there is a GPU" : "there is no GPU"));
  }
};

TIDEMARK_TEST(EngineTest)

}  // namespace tidemark::test::engine_test

#include "engine_test.moc"
