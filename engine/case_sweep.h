// The sweep of a case: computed beside the user interface, and kept to be looked at and taken from.
#pragma once

#include <QImage>
#include <memory>
#include <vector>

#include "document/sweep.h"
#include "engine/job_runner.h"
#include "engine/shown_image.h"

namespace tidemark::engine {

class CaseProxy;

// A sweep with its pictures.
struct SweepOutcome {
  document::SweepStart start;
  document::Sweep sweep;
  std::vector<QImage> pictures;  // of the runs, in their order
  ShownImage agreement;          // the share of runs that have a voxel inside, over slices
};

class CaseSweep : public JobRunner {
  Q_OBJECT
 public:
  // Belongs to the proxy, and does not outlive it.
  explicit CaseSweep(CaseProxy& proxy);

  // Runs from the case's start to rest, with the present parameters but for those of the axes. The former
  // outcome stays until the new one is there; ends with changed(), failed() or cancelled().
  void start(const std::vector<document::SweepAxis>& axes);
  void cancel();
  [[nodiscard]] bool running() const { return waiting_ || busy(); }
  [[nodiscard]] const std::shared_ptr<const SweepOutcome>& outcome() const { return outcome_; }  // or null

  // Of the outcome's runs; null: there is none, or all their surfaces have vanished.
  [[nodiscard]] std::shared_ptr<const document::Agreement> agreement() const;

  // The case becomes that run. An entry of its history.
  void take(int column, int row);

 signals:
  void changed();  // running(), or outcome()

 private:
  void compute(const document::SweepStart& start, const document::SweepOptions& options);

  CaseProxy& proxy_;
  bool waiting_ = false;     // for the start, from the engine's thread
  std::uint64_t asked_ = 0;  // how often a start was asked for: answers to earlier questions are dropped
  std::shared_ptr<const SweepOutcome> outcome_;
};

}  // namespace tidemark::engine
