// Leases: one program at a time has a case, whatever happens to the others.
#include <fcntl.h>
#include <sched.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "document/cohort/lease.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cohort_lease_test {

using cohort::Lease;

namespace {

constexpr double kNever = 1e6;  // seconds

std::optional<Lease> take(const std::filesystem::path& folder, const std::string& id, double stale_after_s) {
  auto lease = Lease::take(folder, id, stale_after_s);
  if (!lease) qFatal("%s", lease.error().message.c_str());
  return std::move(*lease);
}

pid_t in_a_process(const std::function<void()>& work) {
  const pid_t process = ::fork();
  if (process == 0) {
    work();
    ::_exit(0);
  }
  return process;
}

void wait_for(pid_t process) {
  int status = 0;
  ::waitpid(process, &status, 0);
}

// A file whose last sign of life is that old.
void write_aged(const std::filesystem::path& file, const char* text, int age_s) {
  std::ofstream(file) << text;
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  const timespec times[2] = {{now.tv_sec - age_s, 0}, {now.tv_sec - age_s, 0}};
  ::utimensat(AT_FDCWD, file.c_str(), times, 0);
}

// A lease of another machine: nothing is known of its process.
void hold_elsewhere(const std::filesystem::path& file, int age_s) {
  write_aged(file, "elsewhere\n1\n1\n", age_s);
}

int files_in(const std::filesystem::path& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

}  // namespace

class CohortLeaseTest : public QObject {
  Q_OBJECT

 private slots:
  void one_holder_at_a_time();
  void of_many_processes_one_gets_each_case();
  void of_many_processes_one_takes_an_old_lease_over();
  void a_process_that_was_killed_frees_its_lease_at_once();
  void a_process_that_nobody_can_look_at_keeps_its_lease();
  void a_lease_of_another_machine_ages_out();
  void a_refreshed_lease_does_not_age();
  void who_was_held_up_has_lost_it();
  void a_file_that_is_no_lease_ages_like_one();
  void a_folder_that_is_not_there_is_named();
};

void CohortLeaseTest::one_holder_at_a_time() {
  const test::TemporaryFolder folder;
  {
    auto first = take(folder.path(), "a", kNever);
    QVERIFY(first && first->held());
    QVERIFY(!take(folder.path(), "a", kNever));
    QVERIFY(take(folder.path(), "b", kNever));
  }
  auto again = take(folder.path(), "a", kNever);  // it was given back
  QVERIFY(again);
  QCOMPARE(again->number(), 2);
  again->finish();
  take(folder.path(), "b", kNever)->finish();
  QCOMPARE(files_in(folder.path()), 0);
}

void CohortLeaseTest::of_many_processes_one_gets_each_case() {
  constexpr int kProcesses = 6;
  constexpr int kCases = 100;
  const test::TemporaryFolder folder;
  const test::TemporaryFolder taken;
  std::vector<pid_t> processes;
  for (int process = 0; process < kProcesses; ++process) {
    processes.push_back(in_a_process([&] {
      std::vector<Lease> held;  // to the end: nobody else may have one
      for (int i = 0; i < kCases; ++i) {
        auto lease = take(folder.path(), std::to_string(i), kNever);
        if (!lease) continue;
        std::ofstream(taken / fmt::format("{}-{}", i, process)) << "x";
        held.push_back(std::move(*lease));
      }
      ::usleep(300'000);
      for (Lease& lease : held) lease.finish();
    }));
  }
  for (const pid_t process : processes) wait_for(process);
  QCOMPARE(files_in(taken.path()), kCases);
  QCOMPARE(files_in(folder.path()), 0);
}

void CohortLeaseTest::of_many_processes_one_takes_an_old_lease_over() {
  constexpr int kProcesses = 6;
  constexpr int kCases = 100;
  const test::TemporaryFolder folder;
  const test::TemporaryFolder taken;
  for (int i = 0; i < kCases; ++i) hold_elsewhere(folder / fmt::format("{}.1", i), 100);
  std::vector<pid_t> processes;
  for (int process = 0; process < kProcesses; ++process) {
    processes.push_back(in_a_process([&] {
      std::vector<Lease> held;
      for (int i = 0; i < kCases; ++i) {
        auto lease = take(folder.path(), std::to_string(i), 50.0);
        if (!lease) continue;
        std::ofstream(taken / fmt::format("{}-{}", i, process)) << "x";
        held.push_back(std::move(*lease));
      }
      ::usleep(300'000);
      for (Lease& lease : held) lease.finish();
    }));
  }
  for (const pid_t process : processes) wait_for(process);
  QCOMPARE(files_in(taken.path()), kCases);
  QCOMPARE(files_in(folder.path()), 0);
}

void CohortLeaseTest::a_process_that_was_killed_frees_its_lease_at_once() {
  const test::TemporaryFolder folder;
  const pid_t process = in_a_process([&] {
    const auto lease = take(folder.path(), "a", kNever);
    std::ofstream(folder / "ready") << "x";
    ::pause();
  });
  QTRY_VERIFY(std::filesystem::exists(folder / "ready"));
  QVERIFY(!take(folder.path(), "a", kNever));
  ::kill(process, SIGKILL);
  wait_for(process);
  QVERIFY(take(folder.path(), "a", kNever));
}

// A place without /proc hides it, as /proc may hide the processes of other users.
void CohortLeaseTest::a_process_that_nobody_can_look_at_keeps_its_lease() {
  const test::TemporaryFolder folder;
  const auto lease = take(folder.path(), "a", kNever);
  QVERIFY(lease);
  const pid_t process = ::fork();
  if (process == 0) {
    // Who is not root may go there as the root of a space of its own.
    if (::geteuid() != 0 && ::unshare(CLONE_NEWUSER) != 0) ::_exit(2);
    if (::chroot(folder.path().c_str()) != 0) ::_exit(3);
    ::_exit(take("/", "a", kNever) ? 1 : 0);
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  QCOMPARE(WEXITSTATUS(status), 0);
  QVERIFY(WIFEXITED(status) && lease->held());
}

void CohortLeaseTest::a_lease_of_another_machine_ages_out() {
  const test::TemporaryFolder folder;
  hold_elsewhere(folder / "a.1", 100);
  QVERIFY(!take(folder.path(), "a", 200.0));
  const auto lease = take(folder.path(), "a", 50.0);
  QVERIFY(lease);
  QCOMPARE(lease->number(), 2);
}

void CohortLeaseTest::a_refreshed_lease_does_not_age() {
  const test::TemporaryFolder folder;
  auto lease = take(folder.path(), "a", kNever);
  hold_elsewhere(folder / "a.1", 100);
  lease->refresh();
  QVERIFY(!take(folder.path(), "a", 50.0));
  QVERIFY(lease->held());
}

void CohortLeaseTest::who_was_held_up_has_lost_it() {
  const test::TemporaryFolder folder;
  auto slow = take(folder.path(), "a", kNever);
  hold_elsewhere(folder / "a.1", 100);
  auto next = take(folder.path(), "a", 50.0);
  QVERIFY(next);
  QVERIFY(!slow->held());
  slow.reset();  // and gives back nothing
  QVERIFY(next->held());
  QVERIFY(!take(folder.path(), "a", 50.0));
}

void CohortLeaseTest::a_file_that_is_no_lease_ages_like_one() {
  const test::TemporaryFolder folder;
  for (const char* text : {"", "x", "\n\n\n", "a\nb\nc\n", "a\n-1\n1\n", "a\n99999999999999999999\n1\n"}) {
    write_aged(folder / "a.1", text, 0);
    QVERIFY2(!take(folder.path(), "a", 50.0), text);
    write_aged(folder / "a.1", text, 100);
    auto lease = take(folder.path(), "a", 50.0);
    QVERIFY2(lease && lease->number() == 2, text);
    lease->finish();
  }
}

void CohortLeaseTest::a_folder_that_is_not_there_is_named() {
  const auto lease = Lease::take("/no/such/folder", "a", kNever);
  QVERIFY(!lease);
  QVERIFY(QString::fromStdString(lease.error().message).startsWith("/no/such/folder: cannot write"));
}

TIDEMARK_TEST(CohortLeaseTest)

}  // namespace tidemark::test::cohort_lease_test

#include "cohort_lease_test.moc"
