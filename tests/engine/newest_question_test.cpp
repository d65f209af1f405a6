// Answers to the newest of many questions, where one is cut off.
#include "engine/newest_question.h"

#include <QTest>
#include <atomic>
#include <new>

#include "tests/support/test_program.h"

namespace tidemark::test::newest_question_test {

using namespace std::chrono_literals;

namespace {

using NumberQuestion = engine::NewestQuestion<int, int>;

}  // namespace

class NewestQuestionTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    lacks_memory_ = false;
    told_ = 0;
  }
  void cleanup() { QVERIFY(engine::BackgroundJob::finish_all(60s)); }

  void a_question_that_was_cut_off_has_no_answer_and_can_be_asked_again() {
    NumberQuestion question(this, work(), [this] { ++told_; });
    question.ask(1);
    QTRY_COMPARE(told_, 1);
    QVERIFY(question.newest() && *question.newest() == 10);
    lacks_memory_ = true;
    question.ask(2);
    QTRY_COMPARE(told_, 2);
    QVERIFY(!question.answer());
    QVERIFY(!question.waits());
    lacks_memory_ = false;
    question.ask(2);
    QTRY_COMPARE(told_, 3);
    QVERIFY(question.newest() && *question.newest() == 20);
  }

  void who_asks_the_same_when_told_does_not_ask_for_ever() {
    NumberQuestion* asked = nullptr;
    NumberQuestion question(this, work(), [this, &asked] {
      ++told_;
      asked->ask(1);
    });
    asked = &question;
    lacks_memory_ = true;
    question.ask(1);
    QTRY_COMPARE(told_, 1);
    QTest::qWait(100);
    QCOMPARE(told_, 1);
    QVERIFY(!question.waits());
  }

 private:
  NumberQuestion::Work work() {
    return [this](int number, const std::stop_token&) {
      if (lacks_memory_) throw std::bad_alloc();
      return 10 * number;
    };
  }

  std::atomic<bool> lacks_memory_ = false;
  int told_ = 0;
};

TIDEMARK_TEST(NewestQuestionTest)

}  // namespace tidemark::test::newest_question_test

#include "newest_question_test.moc"
