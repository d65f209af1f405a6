#include "document/cohort/runner.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <list>
#include <map>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/atomic_file.h"
#include "core/stopwatch.h"
#include "core/unfinished.h"
#include "document/cohort/lease.h"
#include "document/cohort/worker.h"
#include "imaging/archive/private_folder.h"

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kGroup = 16;          // cases that are synced together
constexpr double kLongestWait_s = 0.1;      // of a case that is complete, for others to be synced with it
constexpr int kLook_ms = 50;                // between looks at limits and at the request to stop
constexpr const char* kFormer = ".former";  // behind the name of a case that is being replaced

bool is_in_shard(std::size_t row, const RunOptions& options) {
  return options.shards == 0 || static_cast<std::int64_t>(row) % options.shards == options.shard - 1;
}

fs::path staging_folder(const fs::path& folder, const std::string& id, std::int64_t number) {
  return folder / fmt::format("{}.{}", id, number);
}

// A folder that goes away with it.
class Staging {
 public:
  Staging(const fs::path& folder, const Lease& lease)
      : path_(staging_folder(folder, lease.id(), lease.number())), unfinished_(path_) {}
  ~Staging() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  // Who held the case before has left as much as it wrote.
  Status make(const fs::path& folder, const Lease& lease) const {
    std::error_code error;
    for (int number = 1; number <= lease.number(); ++number) {
      for (const char* kind : {"", kFormer}) {
        fs::remove_all(folder / fmt::format("{}.{}{}", lease.id(), number, kind), error);
      }
    }
    fs::create_directory(path_, error);
    if (!error) return {};
    return fail(ErrorKind::write, "{}: cannot be made: {}", path_.string(), error.message());
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  Unfinished unfinished_;
};

// A case that this run holds.
struct Job {
  Job(const WorkRow& case_row, Lease case_lease, const fs::path& folder)
      : row(case_row), lease(std::move(case_lease)), staging(folder, lease) {}

  const WorkRow& row;
  Lease lease;
  Staging staging;
  std::optional<Worker> worker;  // while it computes
  bool timed_out = false;
  Stopwatch watch;  // since it began; then since it was complete
  CaseOutcome outcome = CaseOutcome::failed;
  std::int64_t attempt = 1;
};

class Runner {
 public:
  Runner(const CohortFolder& folder, const WorkList& list, const RunOptions& options,
         const ComputeCase& compute, const Progress& progress)
      : folder_(folder), list_(list), options_(options), compute_(compute), progress_(progress) {}

  Result<RunTally> run();

 private:
  Status look_at_what_is_done();
  void sweep();
  void choose_rows();
  Status go_on();
  [[nodiscard]] bool is_some_left() const;
  [[nodiscard]] bool may_start() const;
  Status start_some();
  Status try_to_start(const WorkRow& row);
  Result<Worker> start_worker();
  [[nodiscard]] bool is_done(const WorkRow& row) const;
  Status wait_for_some();
  void end_those_over_time();
  Status collect(Job& job);
  Status write_status_for(Job& job, const WorkEnd& end);
  Status publish_if_due(bool at_once);
  Status publish(Job& job);
  void look_at_leases();
  void report();

  const CohortFolder& folder_;
  const WorkList& list_;
  const RunOptions& options_;
  const ComputeCase& compute_;
  const Progress& progress_;

  std::vector<const WorkRow*> rows_;  // to be computed, in this run's order
  std::size_t next_ = 0;
  std::vector<const WorkRow*> held_;                        // by other programs, and to be looked at again
  std::unordered_set<std::string> done_;                    // when the run began
  std::unordered_map<std::string, std::int64_t> attempts_;  // of cases to retry, those so far
  std::list<Job> computing_;
  std::vector<Worker> idle_;
  std::list<Job> complete_;            // to be published
  Stopwatch since_look_;               // at leases
  std::optional<Error> out_of_reach_;  // what a case needs and cannot get now: the run begins no others
  RunTally tally_;
};

Status Runner::look_at_what_is_done() {
  const auto ids = folder_.finished_ids();
  if (!ids) return pass_on(ids);
  done_.insert(ids->begin(), ids->end());
  if (!options_.retry) return {};
  for (const std::string& id : *ids) {
    const auto status = CaseStatus::load(folder_.status(id));
    if (status && status->outcome == CaseOutcome::done) continue;
    attempts_[id] = status ? status->attempt : 1;
    done_.erase(id);
  }
  return {};
}

// What killed runs have left of cases that are done. Of others, their next holder removes it.
void Runner::sweep() {
  sweep_leases(folder_.leases(), options_.stale_after_s,
               [&](const std::string& id) { return done_.contains(id); });
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(folder_.staging(), error), end; !error && entry != end;
       entry.increment(error)) {
    fs::path name = entry->path().filename();
    if (name.extension() == kFormer) name.replace_extension();
    const std::string id = name.replace_extension().string();
    const bool held = fs::exists(folder_.leases() / (id + ".1"), error);
    if (done_.contains(id) && !held) left.push_back(entry->path());
  }
  for (const fs::path& path : left) fs::remove_all(path, error);
}

// Runs that begin together start at different rows: they would meet at each case otherwise.
void Runner::choose_rows() {
  for (std::size_t i = 0; i < list_.rows.size(); ++i) {
    if (!is_in_shard(i, options_)) continue;
    ++tally_.rows;
    if (done_.contains(list_.rows[i].id)) {
      ++tally_.before;
    } else {
      rows_.push_back(&list_.rows[i]);
    }
  }
  if (rows_.empty()) return;
  const std::size_t first =
      std::hash<std::string>()(fmt::format("{} {}", this_machine(), ::getpid())) % rows_.size();
  std::rotate(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(first), rows_.end());
}

// By the disk as it is now. A case to retry is not, while nobody else has.
bool Runner::is_done(const WorkRow& row) const {
  std::error_code ignored;
  if (!fs::exists(folder_.case_folder(row.id), ignored)) return false;
  const auto known = attempts_.find(row.id);
  if (known == attempts_.end()) return true;
  const auto status = CaseStatus::load(folder_.status(row.id));
  return status && (status->outcome == CaseOutcome::done || status->attempt > known->second);
}

Status Runner::try_to_start(const WorkRow& row) {
  if (is_done(row)) {
    ++tally_.elsewhere;
    return {};
  }
  auto lease = Lease::take(folder_.leases(), row.id, options_.stale_after_s);
  if (!lease) return pass_on(lease);
  if (!*lease) {
    if (options_.shards > 0) {
      held_.push_back(&row);
    } else {
      ++tally_.elsewhere;
    }
    return {};
  }
  if (is_done(row)) {  // meanwhile
    (*lease)->finish();
    ++tally_.elsewhere;
    return {};
  }
  Job& job = computing_.emplace_back(row, std::move(**lease), folder_.staging());
  if (const auto known = attempts_.find(row.id); known != attempts_.end()) job.attempt = known->second + 1;
  TIDEMARK_TRY(job.staging.make(folder_.staging(), job.lease));
  if (idle_.empty()) {
    auto worker = start_worker();
    if (!worker) return pass_on(worker);
    job.worker = std::move(*worker);
  } else {
    job.worker = std::move(idle_.back());
    idle_.pop_back();
  }
  job.watch.restart();
  job.worker->send({&row - list_.rows.data(), job.lease.number(), job.attempt});
  return {};
}

Result<Worker> Runner::start_worker() {
  const auto work = [this](const WorkRequest& request) -> Status {
    const SyncLater later;
    const WorkRow& row = list_.rows[static_cast<std::size_t>(request.row)];
    const fs::path folder = staging_folder(folder_.staging(), row.id, request.number);
    auto status = compute_(row, folder);
    if (!status) return pass_on(status);
    status->attempt = request.attempt;
    return write_file(folder / "status.json", status->to_text());
  };
  return Worker::start(work, options_.memory_bytes);
}

bool Runner::may_start() const {
  return !out_of_reach_ && next_ < rows_.size() && static_cast<int>(computing_.size()) < options_.jobs;
}

// Not for long, as others may have done many rows: what computes has to be looked at.
Status Runner::start_some() {
  const Stopwatch watch;
  while (may_start() && watch.seconds() < kLook_ms * 1e-3) {
    if (progress_.cancelled()) return cancelled_error();
    TIDEMARK_TRY(try_to_start(*rows_[next_++]));
  }
  return {};
}

void Runner::end_those_over_time() {
  if (options_.timeout_s <= 0.0) return;
  for (Job& job : computing_) {
    if (job.timed_out || job.watch.seconds() <= options_.timeout_s) continue;
    job.timed_out = true;
    job.worker->kill();
  }
}

// Waits until a case ends, but not for long, and not where another can be started.
Status Runner::wait_for_some() {
  std::vector<pollfd> polled;
  for (const Job& job : computing_) polled.push_back({job.worker->descriptor(), POLLIN, 0});
  if (polled.empty() && held_.empty()) return {};
  ::poll(polled.data(), polled.size(), may_start() ? 0 : kLook_ms);
  std::size_t at = 0;
  for (auto job = computing_.begin(); job != computing_.end(); ++at) {
    const auto present = job++;
    if (polled[at].revents == 0) continue;
    Status collected = collect(*present);
    if (collected) {
      complete_.splice(complete_.end(), computing_, present);
      continue;
    }
    computing_.erase(present);  // given back
    if (collected.error().kind != ErrorKind::input) return collected;
    out_of_reach_ = std::move(collected.error());
  }
  return {};
}

// The status of a case whose process has written none that can be read.
Status Runner::write_status_for(Job& job, const WorkEnd& end) {
  CaseStatus status;
  status.outcome = job.timed_out                                           ? CaseOutcome::timed_out
                   : end.killed || end.error.kind == ErrorKind::capability ? CaseOutcome::out_of_memory
                                                                           : CaseOutcome::failed;
  status.reason = job.timed_out ? fmt::format("not done within {} s", options_.timeout_s)
                  : end.killed  ? "ended by the system (signal 9), which does so when memory is short"
                                : end.error.message;
  status.id = job.row.id;
  status.input = job.row.place();
  status.series = job.row.series;
  status.attempt = job.attempt;
  status.program = options_.program;
  status.machine = this_machine();
  status.finished = utc_now();
  status.seconds = job.watch.seconds();
  status.peak_memory_bytes = end.peak_memory_bytes;
  job.outcome = status.outcome;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(job.staging.path(), ignored)) {
    fs::remove_all(entry.path(), ignored);
  }
  const SyncLater later;
  return write_file(job.staging.path() / "status.json", status.to_text());
}

Status Runner::collect(Job& job) {
  const WorkEnd end = job.worker->answer();
  if (job.worker->is_fit() && !job.timed_out) idle_.push_back(std::move(*job.worker));
  job.worker.reset();
  if (!end.good) {
    const ErrorKind kind = end.error.kind;
    const bool is_no_fault_of_it =
        kind == ErrorKind::write || kind == ErrorKind::input || kind == ErrorKind::cancelled;
    if (!job.timed_out && is_no_fault_of_it) return tl::unexpected(end.error);
    TIDEMARK_TRY(write_status_for(job, end));
  } else {
    const auto status = CaseStatus::load(job.staging.path() / "status.json");
    if (status) {
      job.outcome = status->outcome;
    } else {
      TIDEMARK_TRY(write_status_for(job, {false, status.error(), false, 0}));
    }
  }
  job.watch.restart();
  return {};
}

Status Runner::publish(Job& job) {
  const fs::path target = folder_.case_folder(job.row.id);
  if (!job.lease.held()) {  // this program was held up, and another has it
    ++tally_.elsewhere;
    return {};
  }
  std::error_code error;
  fs::path former;
  if (attempts_.contains(job.row.id)) {
    former = job.staging.path().string() + kFormer;
    fs::rename(target, former, error);
  }
  fs::rename(job.staging.path(), target, error);
  if (error == std::errc::directory_not_empty || error == std::errc::file_exists) {
    ++tally_.elsewhere;
  } else if (error) {
    return fail(ErrorKind::write, "{}: cannot write: {}", target.string(), error.message());
  } else {
    ++tally_.outcomes[static_cast<int>(job.outcome)];
  }
  if (!former.empty()) fs::remove_all(former, error);
  return {};
}

// A name in cases/ says that all below it is on the disk.
Status Runner::publish_if_due(bool at_once) {
  if (complete_.empty()) return {};
  const bool due = complete_.size() >= kGroup || complete_.front().watch.seconds() > kLongestWait_s;
  if (!due && !at_once) return {};
  TIDEMARK_TRY(sync_file_system(folder_.staging()));
  for (Job& job : complete_) {
    TIDEMARK_TRY(publish(job));
  }
  TIDEMARK_TRY(sync_to_disk(folder_.cases()));
  for (Job& job : complete_) {
    if (job.lease.held()) job.lease.finish();
  }
  complete_.clear();
  report();
  return {};
}

// Those of this run are made new. Those of others may have aged.
void Runner::look_at_leases() {
  if (since_look_.seconds() < options_.stale_after_s / 5.0) return;
  since_look_.restart();
  for (const auto* jobs : {&computing_, &complete_}) {
    for (const Job& job : *jobs) job.lease.refresh();
  }
  if (next_ < rows_.size()) return;
  rows_ = std::exchange(held_, {});
  next_ = 0;
}

void Runner::report() {
  const std::int64_t open = tally_.rows - tally_.before;
  const std::int64_t ended = tally_.computed() + tally_.elsewhere;
  if (open > 0) progress_(static_cast<double>(ended) / static_cast<double>(open), "computing cases");
}

bool Runner::is_some_left() const {
  const bool is_to_begin = next_ < rows_.size() || !held_.empty();
  return (is_to_begin && !out_of_reach_) || !computing_.empty();
}

Status Runner::go_on() {
  report();
  while (is_some_left()) {
    TIDEMARK_TRY(start_some());
    TIDEMARK_TRY(wait_for_some());
    if (progress_.cancelled()) return cancelled_error();
    end_those_over_time();
    look_at_leases();
    TIDEMARK_TRY(publish_if_due(false));
  }
  if (out_of_reach_) return tl::unexpected(*out_of_reach_);
  return {};
}

Result<RunTally> Runner::run() {
  TIDEMARK_TRY(look_at_what_is_done());
  sweep();
  choose_rows();
  const Status ended = go_on();
  computing_.clear();  // workers end with their jobs; leases are given back
  idle_.clear();
  // Images that a worker had brought when it was killed.
  std::error_code ignored;
  imaging::sweep_private_folders(fs::temp_directory_path(ignored));
  const Status published = publish_if_due(true);
  if (!ended) return tl::unexpected(ended.error());
  if (!published) return tl::unexpected(published.error());
  return tally_;
}

}  // namespace

std::int64_t RunTally::computed() const {
  return std::accumulate(std::begin(outcomes), std::end(outcomes), std::int64_t{0});
}

std::int64_t RunTally::without_result() const {
  return computed() - outcomes[static_cast<int>(CaseOutcome::done)];
}

std::int64_t finished_without_result(const CohortFolder& folder, const WorkList& list,
                                     const RunOptions& options) {
  std::int64_t count = 0;
  std::error_code ignored;
  for (std::size_t i = 0; i < list.rows.size(); ++i) {
    const std::string& id = list.rows[i].id;
    if (!is_in_shard(i, options) || !fs::exists(folder.case_folder(id), ignored)) continue;
    const auto status = CaseStatus::load(folder.status(id));
    if (!status || status->outcome != CaseOutcome::done) ++count;
  }
  return count;
}

Result<RunTally> run_cohort(const CohortFolder& folder, const WorkList& list, const RunOptions& options,
                            const ComputeCase& compute, const Progress& progress) {
  return Runner(folder, list, options, compute, progress).run();
}

}  // namespace tidemark::cohort
