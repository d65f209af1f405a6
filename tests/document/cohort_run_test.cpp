// The run of a cohort with work that fails in every way, and that is killed at any moment.
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <new>
#include <random>
#include <set>
#include <thread>

#include "core/atomic_file.h"
#include "document/cohort/runner.h"
#include "document/cohort/worker.h"
#include "tests/app/folder_events.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cohort_run_test {

using cohort::CaseOutcome;
using cohort::CaseStatus;
using cohort::WorkRow;

namespace {

namespace fs = std::filesystem;

cohort::WorkList list_of(const std::vector<std::string>& ids) {
  cohort::WorkList list;
  for (const std::string& id : ids) {
    WorkRow row;
    row.id = id;
    row.input = "/data/" + id;
    list.rows.push_back(row);
  }
  return list;
}

std::vector<std::string> numbered(int count) {
  std::vector<std::string> ids;
  for (int i = 0; i < count; ++i) ids.push_back(fmt::format("case{}", i));
  return ids;
}

// An empty cohort.
class Planned {
 public:
  Planned() {
    if (!folder().write_plan({}, {}, {})) qFatal("no plan was written");
  }
  [[nodiscard]] cohort::CohortFolder folder() const { return cohort::CohortFolder(folder_.path()); }
  [[nodiscard]] CaseStatus status(const std::string& id) const {
    auto status = CaseStatus::load(folder().status(id));
    if (!status) qFatal("%s", status.error().message.c_str());
    return std::move(*status);
  }
  [[nodiscard]] std::set<std::string> done() const {
    std::set<std::string> ids;
    const auto finished = folder().finished_ids();
    if (finished) ids.insert(finished->begin(), finished->end());
    return ids;
  }
  // What lies where only the work of runs does.
  [[nodiscard]] QString left() const {
    QStringList names;
    for (const fs::path& place : {folder().leases(), folder().staging()}) {
      for (const auto& entry : fs::directory_iterator(place))
        names << QStringLiteral("%1 (%2 bytes)").arg(entry.path().filename().c_str()).arg(entry.file_size());
    }
    return names.join(' ');
  }

 private:
  test::TemporaryFolder folder_;
};

Result<CaseStatus> succeed(const WorkRow& row, const fs::path& folder) {
  CaseStatus status;
  status.id = row.id;
  status.outcome = CaseOutcome::done;
  std::ofstream(folder / "mask") << row.id;
  return status;
}

#ifdef TIDEMARK_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

// What the name of the case asks for.
Result<CaseStatus> misbehave(const WorkRow& row, const fs::path& folder) {
  if (row.id == "crash") std::abort();
  if (row.id == "segfault") ::raise(SIGSEGV);
  if (row.id == "hang") {
    for (;;) ::pause();
  }
  if (row.id == "eat") {
    std::vector<std::vector<char>> eaten;
    for (;;) eaten.emplace_back(std::size_t{16} << 20, 'x');
  }
  if (row.id == "throw") throw std::runtime_error("thrown");
  if (row.id == "exit") ::_exit(7);
  if (row.id == "killed") ::raise(SIGKILL);
  return succeed(row, folder);
}

// Memory that is touched and given back at once, whoever allocates.
void touch(std::size_t bytes) {
  void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return;
  std::memset(memory, 1, bytes);
  ::munmap(memory, bytes);
}

// The peaks of two pieces of work in one worker, in KiB; the first one touches so much more.
std::pair<long, long> peaks_of_two(std::size_t bytes) {
  const auto work = [&](const cohort::WorkRequest& request) -> Status {
    if (request.row == 0) touch(bytes);
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return fail(ErrorKind::input, "{}", usage.ru_maxrss);
  };
  auto worker = cohort::Worker::start(work, 0);
  if (!worker) return {};
  long peaks[2];
  for (int row = 0; row < 2; ++row) {
    worker->send({row, 1, 1});
    peaks[row] = std::atol(worker->answer().error.message.c_str());
  }
  return {peaks[0], peaks[1]};
}

}  // namespace

class CohortRunTest : public QObject {
  Q_OBJECT

 private slots:
  void each_case_is_computed_once();
  void a_case_that_fails_stops_no_other();
  void a_status_of_any_length_stops_no_other();
  void a_full_disk_is_no_fault_of_a_case();
  void what_is_out_of_reach_ends_no_case_beside_it();
  void cases_without_a_result_are_tried_again_when_asked();
  void shards_share_the_rows();
  void a_shard_ends_when_its_rows_are_done_though_another_was_killed_with_one();
  void cases_that_others_have_done_are_passed_over_without_a_lease();
  void the_peak_of_a_case_is_not_that_of_the_one_before();
  void a_stopped_run_gives_back_what_it_has_begun();
  void runs_side_by_side_do_no_case_twice();
  void killed_at_any_moment_no_case_is_lost_and_none_is_done_twice();
};

void CohortRunTest::each_case_is_computed_once() {
  const Planned planned;
  const auto list = list_of(numbered(40));
  cohort::RunOptions options;
  options.jobs = 3;
  const auto tally = cohort::run_cohort(planned.folder(), list, options, succeed);
  QCOMPARE(test::failure(tally), QString());
  QCOMPARE(tally->outcomes[0], std::int64_t{40});
  QCOMPARE(planned.done().size(), std::size_t{40});
  QCOMPARE(test::bytes_of(planned.folder().case_folder("case7") / "mask"), QByteArray("case7"));
  QCOMPARE(planned.left(), QString());
  const auto again = cohort::run_cohort(planned.folder(), list, options, succeed);
  QCOMPARE(again->before, std::int64_t{40});
  QCOMPARE(again->computed(), std::int64_t{0});
}

void CohortRunTest::a_case_that_fails_stops_no_other() {
  const Planned planned;
  cohort::RunOptions options;
  options.jobs = 2;
  options.timeout_s = 2.0;
  options.memory_bytes = std::int64_t{64} << 20;
  // A sanitizer ends a process that gets no memory, before the process can say why.
  const CaseOutcome without_memory = kSanitized ? CaseOutcome::failed : CaseOutcome::out_of_memory;
  const std::vector<std::pair<std::string, CaseOutcome>> expected{
      {"crash", CaseOutcome::failed},         {"segfault", CaseOutcome::failed},
      {"hang", CaseOutcome::timed_out},       {"eat", without_memory},
      {"throw", CaseOutcome::failed},         {"exit", CaseOutcome::failed},
      {"killed", CaseOutcome::out_of_memory}, {"good", CaseOutcome::done}};
  std::vector<std::string> ids;
  for (const auto& [id, outcome] : expected) ids.push_back(id);
  const auto tally = cohort::run_cohort(planned.folder(), list_of(ids), options, misbehave);
  QCOMPARE(test::failure(tally), QString());
  for (const auto& [id, outcome] : expected) {
    const CaseStatus status = planned.status(id);
    QVERIFY2(status.outcome == outcome, fmt::format("{}: {}", id, status.reason).c_str());
    if (outcome != CaseOutcome::done) QVERIFY2(!status.reason.empty(), id.c_str());
  }
  QVERIFY(QString::fromStdString(planned.status("segfault").reason).contains("signal 11"));
  QCOMPARE(QString::fromStdString(planned.status("throw").reason), QString("thrown"));
  QCOMPARE(tally->without_result(), std::int64_t{7});
  QCOMPARE(planned.left(), QString());
}

void CohortRunTest::a_status_of_any_length_stops_no_other() {
  const Planned planned;
  const auto tell_much = [](const WorkRow& row, const fs::path& folder) {
    auto status = succeed(row, folder);
    if (row.id == "reason") {
      status->outcome = CaseOutcome::refused;
      status->reason = "x";
      for (int i = 0; i < 35'000; ++i) status->reason += "é";
    }
    if (row.id == "remarks") status->remarks.assign(2'000, std::string(5'000, 'x'));
    if (row.id == "series") status->series.assign(5'000, '1');
    return status;
  };
  const auto list = list_of({"reason", "remarks", "series", "good"});
  const auto tally = cohort::run_cohort(planned.folder(), list, {}, tell_much);
  QCOMPARE(test::failure(tally), QString());
  QCOMPARE(planned.status("reason").outcome, CaseOutcome::refused);
  QCOMPARE(planned.status("reason").reason.size(), std::size_t{65'535});  // of whole letters
  QCOMPARE(planned.status("remarks").outcome, CaseOutcome::done);
  QVERIFY(!planned.status("remarks").remarks.empty());
  QCOMPARE(planned.status("series").outcome, CaseOutcome::failed);  // what is too long there is a defect
  QVERIFY(QString::fromStdString(planned.status("series").reason).contains("status.json: series: "));
  QCOMPARE(planned.status("good").outcome, CaseOutcome::done);
  QCOMPARE(planned.left(), QString());
}

void CohortRunTest::a_full_disk_is_no_fault_of_a_case() {
  const Planned planned;
  const auto full = [](const WorkRow& row, const fs::path& folder) -> Result<CaseStatus> {
    if (row.id == "case3")
      return fail(ErrorKind::write, "mask.nii.gz: cannot write: No space left on device");
    return succeed(row, folder);
  };
  const auto tally = cohort::run_cohort(planned.folder(), list_of(numbered(8)), {}, full);
  QVERIFY(!tally);
  QCOMPARE(tally.error().kind, ErrorKind::write);
  QVERIFY(!planned.done().contains("case3"));
  const auto again = cohort::run_cohort(planned.folder(), list_of(numbered(8)), {}, succeed);
  QCOMPARE(test::failure(again), QString());
  QCOMPARE(planned.done().size(), std::size_t{8});
  QCOMPARE(planned.left(), QString());
}

void CohortRunTest::what_is_out_of_reach_ends_no_case_beside_it() {
  const Planned planned;
  const test::TemporaryFolder notes;
  const auto reach = [&](const WorkRow& row, const fs::path& folder) -> Result<CaseStatus> {
    if (row.id == "far") {
      while (!fs::exists(notes / "begun")) ::usleep(1'000);
      return fail(ErrorKind::input, "main: does not answer");
    }
    std::ofstream(notes / "begun") << "x";
    ::usleep(300'000);
    return succeed(row, folder);
  };
  cohort::RunOptions options;
  options.jobs = 2;
  const auto tally = cohort::run_cohort(planned.folder(), list_of({"far", "near"}), options, reach);
  QVERIFY(!tally);
  QCOMPARE(QString::fromStdString(tally.error().message), QString("main: does not answer"));
  QCOMPARE(planned.done(), (std::set<std::string>{"near"}));
  const auto again = cohort::run_cohort(planned.folder(), list_of({"far", "near"}), options, succeed);
  QCOMPARE(test::failure(again), QString());
  QCOMPARE(again->before, std::int64_t{1});
  QCOMPARE(planned.left(), QString());
}

void CohortRunTest::cases_without_a_result_are_tried_again_when_asked() {
  const Planned planned;
  const auto list = list_of({"throw", "good"});
  QVERIFY(cohort::run_cohort(planned.folder(), list, {}, misbehave));
  cohort::RunOptions options;
  options.retry = true;
  const auto tally = cohort::run_cohort(planned.folder(), list, options, succeed);
  QCOMPARE(test::failure(tally), QString());
  QCOMPARE(tally->computed(), std::int64_t{1});
  QCOMPARE(planned.status("throw").outcome, CaseOutcome::done);
  QCOMPARE(planned.status("throw").attempt, std::int64_t{2});
  QCOMPARE(planned.left(), QString());
}

void CohortRunTest::shards_share_the_rows() {
  const Planned planned;
  const auto list = list_of(numbered(10));
  for (int shard = 1; shard <= 3; ++shard) {
    cohort::RunOptions options;
    options.shard = shard;
    options.shards = 3;
    QVERIFY(cohort::run_cohort(planned.folder(), list, options, succeed));
    QCOMPARE(planned.done().size(), std::size_t(shard == 1 ? 4 : shard == 2 ? 7 : 10));
  }
}

void CohortRunTest::a_shard_ends_when_its_rows_are_done_though_another_was_killed_with_one() {
  const Planned planned;
  const auto list = list_of(numbered(3));
  std::ofstream(planned.folder().leases() / "case1.1") << "another machine\n1\n1\n";
  // A run that shares its rows leaves it to the other.
  const auto shared = cohort::run_cohort(planned.folder(), list, {}, succeed);
  QCOMPARE(test::failure(shared), QString());
  QCOMPARE(shared->elsewhere, std::int64_t{1});
  QCOMPARE(planned.done(), (std::set<std::string>{"case0", "case2"}));
  cohort::RunOptions options;
  options.shard = 2;
  options.shards = 1'000;
  options.stale_after_s = 0.4;
  const auto tally = cohort::run_cohort(planned.folder(), list, options, succeed);
  QCOMPARE(test::failure(tally), QString());
  QCOMPARE(tally->computed(), std::int64_t{1});
  QCOMPARE(planned.done().size(), std::size_t{3});
  QCOMPARE(planned.left(), QString());
}

void CohortRunTest::cases_that_others_have_done_are_passed_over_without_a_lease() {
  const Planned planned;
  const auto list = list_of(numbered(20));
  const auto compute = [&](const WorkRow& row, const fs::path& folder) {
    for (const WorkRow& other : list.rows) {
      if (other.id != row.id) fs::create_directory(planned.folder().case_folder(other.id));
    }
    return succeed(row, folder);
  };
  FolderEvents events(planned.folder().leases(), IN_CREATE);
  const auto tally = cohort::run_cohort(planned.folder(), list, {}, compute);
  QCOMPARE(test::failure(tally), QString());
  QCOMPARE(tally->computed(), std::int64_t{1});
  QCOMPARE(tally->elsewhere, std::int64_t{19});
  QStringList leases = events.by_name().keys();
  leases.removeIf([](const QString& name) { return name.startsWith('.'); });  // not yet leases
  QCOMPARE(leases.size(), 1);
}

// Root may do what users may not.
void CohortRunTest::the_peak_of_a_case_is_not_that_of_the_one_before() {
  constexpr std::size_t kBytes = std::size_t{256} << 20;
  const pid_t process = ::fork();
  if (process == 0) {
    constexpr uid_t kNobody = 65534;
    if (::geteuid() == 0 && (::setgid(kNobody) != 0 || ::setuid(kNobody) != 0)) ::_exit(2);
    ::prctl(PR_SET_DUMPABLE, 1);  // as a program that was never root is
    const auto [first, second] = peaks_of_two(kBytes);
    ::_exit(second > 0 && first - second > static_cast<long>(kBytes / 2 / 1024) ? 0 : 1);
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  QCOMPARE(status, 0);
}

void CohortRunTest::a_stopped_run_gives_back_what_it_has_begun() {
  const Planned planned;
  std::stop_source stop;
  const std::jthread stopper([&] {
    ::usleep(200'000);
    stop.request_stop();
  });
  const auto tally = cohort::run_cohort(planned.folder(), list_of({"hang", "good"}), {}, misbehave,
                                        Progress{nullptr, stop.get_token()});
  QVERIFY(!tally);
  QCOMPARE(tally.error().kind, ErrorKind::cancelled);
  QVERIFY(fs::is_empty(planned.folder().staging()));
  const auto again = cohort::run_cohort(planned.folder(), list_of({"hang", "good"}), {}, succeed);
  QCOMPARE(test::failure(again), QString());
  QCOMPARE(planned.done().size(), std::size_t{2});
}

// Notes each computation in a file of its own, then succeeds.
void CohortRunTest::runs_side_by_side_do_no_case_twice() {
  const Planned planned;
  const test::TemporaryFolder notes;
  const auto list = list_of(numbered(60));
  const auto compute = [&](const WorkRow& row, const fs::path& folder) {
    std::ofstream(notes / fmt::format("{}-{}", row.id, ::getpid())) << "x";
    return succeed(row, folder);
  };
  std::vector<pid_t> processes;
  for (int i = 0; i < 4; ++i) {
    const pid_t process = ::fork();
    if (process == 0) ::_exit(cohort::run_cohort(planned.folder(), list, {}, compute) ? 0 : 1);
    processes.push_back(process);
  }
  for (const pid_t process : processes) {
    int status = 0;
    ::waitpid(process, &status, 0);
    QCOMPARE(status, 0);
  }
  QCOMPARE(planned.done().size(), std::size_t{60});
  QCOMPARE(std::distance(fs::directory_iterator(notes.path()), fs::directory_iterator()), std::ptrdiff_t{60});
  QCOMPARE(planned.left(), QString());
}

void CohortRunTest::killed_at_any_moment_no_case_is_lost_and_none_is_done_twice() {
  constexpr int kCases = 300;
  const Planned planned;
  const auto list = list_of(numbered(kCases));
  const auto compute = [](const WorkRow& row, const fs::path& folder) {
    ::usleep(2'000);
    return succeed(row, folder);
  };
  cohort::RunOptions options;
  options.jobs = 2;
  std::mt19937 random(7);
  std::map<std::string, fs::file_time_type> seen;
  for (int kill = 0; kill < 20; ++kill) {
    const pid_t process = ::fork();
    if (process == 0) {
      static_cast<void>(cohort::run_cohort(planned.folder(), list, options, compute));
      ::_exit(0);
    }
    ::usleep(10'000 + random() % 250'000);
    ::kill(process, SIGKILL);
    int status = 0;
    ::waitpid(process, &status, 0);
    for (const std::string& id : planned.done()) {
      const auto time = fs::last_write_time(planned.folder().status(id));
      const auto [known, is_new] = seen.emplace(id, time);
      QVERIFY2(known->second == time, id.c_str());  // it was not done again
    }
  }
  QVERIFY(!seen.empty());
  const auto tally = cohort::run_cohort(planned.folder(), list, options, compute);
  QCOMPARE(test::failure(tally), QString());
  QCOMPARE(planned.done().size(), std::size_t{kCases});
  QCOMPARE(tally->before + tally->computed(), std::int64_t{kCases});
  for (const auto& [id, time] : seen)
    QVERIFY2(fs::last_write_time(planned.folder().status(id)) == time, id.c_str());
  for (const std::string& id : planned.done()) {
    QCOMPARE(test::bytes_of(planned.folder().case_folder(id) / "mask"), QByteArray::fromStdString(id));
  }
  QCOMPARE(planned.left(), QString());
}

TIDEMARK_TEST(CohortRunTest)

}  // namespace tidemark::test::cohort_run_test

#include "cohort_run_test.moc"
