// An ITK filter that runs a few iterations at a time.
#pragma once

#include <itkCommand.h>
#include <itkMacro.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "bench/peers/contestants.h"
#include "bench/peers/itk_filters.h"

namespace tidemark::bench {

// ITK's filters run to their end in one call, and work on the whole volume before and after. This one runs
// in a thread of its own and is held at the end of each iteration until more are asked for, so that nothing
// but iterations is timed and several contestants can take turns.
template <class Filter>
class PacedFilter final : public Contestant {
 public:
  PacedFilter(typename Filter::Pointer filter, const Geometry& geometry)
      : filter_(filter), geometry_(geometry) {
    filter_->SetMaximumRMSError(0.0);
    filter_->SetNumberOfIterations(1000000000);
    auto command = itk::SimpleMemberCommand<PacedFilter>::New();
    command->SetCallbackFunction(this, &PacedFilter::end_iteration);
    filter_->AddObserver(itk::IterationEvent(), command);
    thread_ = std::jthread([this] { run(); });
    // Set-up and the first iteration, which is not told apart from it, are over when the filter waits.
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_ || ended_; });
  }
  ~PacedFilter() override { stop(); }

  Result<Cost> advance(std::int64_t steps) override {
    std::unique_lock lock(mutex_);
    if (ended_ && !error_.empty()) return fail(ErrorKind::internal, "ITK: {}", error_);
    Cost cost;
    if (ended_) return cost;
    const auto start = std::chrono::steady_clock::now();
    const std::int64_t before = iterations_;
    allowed_ = iterations_ + steps;
    waiting_ = false;
    changed_.notify_all();
    changed_.wait(lock, [&] { return waiting_ || ended_; });
    cost.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    cost.steps = iterations_ - before;
    return cost;
  }

  Mask finish() override {
    stop();
    return inside(*filter_->GetOutput(), geometry_);
  }

 private:
  void run() {
    try {
      filter_->Update();
    } catch (const itk::ExceptionObject& exception) {
      error_ = exception.GetDescription();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

  // In the filter's thread.
  void end_iteration() {
    std::unique_lock lock(mutex_);
    ++iterations_;
    if (iterations_ < allowed_) return;
    waiting_ = true;
    changed_.notify_all();
    changed_.wait(lock, [&] { return !waiting_ || stop_; });
    if (stop_) filter_->SetNumberOfIterations(1);
  }

  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
      changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
  }

  typename Filter::Pointer filter_;
  Geometry geometry_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t iterations_ = 0;
  std::int64_t allowed_ = 1;
  bool waiting_ = false;
  bool stop_ = false;
  bool ended_ = false;
  std::string error_;
  std::jthread thread_;
};

// Runs a filter to its own criterion. `make` is part of the time.
template <class Make>
Result<Convergence> converge_filter(const Geometry& geometry, Make make) {
  try {
    const auto start = std::chrono::steady_clock::now();
    const auto filter = make();
    filter->SetMaximumRMSError(kItkMaximumRmsError);
    filter->SetNumberOfIterations(static_cast<itk::IdentifierType>(kMostSteps));
    filter->Update();
    Convergence run;
    run.result = inside(*filter->GetOutput(), geometry);
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    run.steps = static_cast<std::int64_t>(filter->GetElapsedIterations());
    run.converged = run.steps < kMostSteps;
    return run;
  } catch (const itk::ExceptionObject& exception) {
    return fail(ErrorKind::internal, "ITK: {}", exception.GetDescription());
  }
}

}  // namespace tidemark::bench
