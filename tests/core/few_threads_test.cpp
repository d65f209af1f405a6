// A thread pool where the system gives fewer threads than it is asked for.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "core/thread_pool.h"
#include "tests/support/child_process.h"
#include "tests/support/test_program.h"

namespace tidemark::test::few_threads_test {

class FewThreadsTest : public QObject {
  Q_OBJECT

 private slots:
  void those_that_there_are_do_the_work() {
    constexpr int kWanted = 64;
    const auto work = []() -> Status {
      ::alarm(5);  // what hangs is killed
      ThreadPool pool(kWanted);
      if (pool.threads() == kWanted) return fail(ErrorKind::internal, "the system gave all of them");
      for (const std::int64_t count : {1, 64, 997}) {
        std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
        pool.for_each(count, 3, [&](std::int64_t begin, std::int64_t end, int) {
          for (std::int64_t i = begin; i < end; ++i) visits[static_cast<std::size_t>(i)]++;
        });
        if (!std::ranges::all_of(visits, [](const auto& visit) { return visit == 1; }))
          return fail(ErrorKind::internal, "an index was left out or done twice");
      }
      return {};
    };
    // The stack of a thread takes 2 MiB or more.
    const Ended ended = run_in_child(work, {.more_memory = std::int64_t{32} << 20});
    QVERIFY(!ended.was_killed);
    QCOMPARE(QString::fromStdString(ended.failure), QString());
  }
};

TIDEMARK_TEST(FewThreadsTest)

}  // namespace tidemark::test::few_threads_test

#include "few_threads_test.moc"
