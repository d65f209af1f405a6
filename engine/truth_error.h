// The distances of voxels from a known answer, as a map for the views of a case.
#pragma once

#include <QObject>
#include <functional>
#include <memory>

#include "core/volume.h"
#include "solver/speed/speed_function.h"

namespace tidemark::engine {

class BackgroundJob;
class Display;

// From which distance on colours do not change any more, mm: three of the largest spacing, in whole mm.
[[nodiscard]] double truth_error_range_mm(const Geometry& geometry);

// Follows DisplaySettings::truth_error. Distances are computed once, when they are first wanted, on a thread
// of their own. Lives on the thread of the user interface.
class TruthError : public QObject {
  Q_OBJECT
 public:
  using Map = std::shared_ptr<const solver::SpeedFunction>;
  // Null: nothing is shown any more.
  using Show = std::function<void(const Map&)>;

  // Without a truth nothing is ever shown.
  TruthError(Display& display, std::shared_ptr<const Mask> truth, Show show);
  ~TruthError() override;

  void set_truth(std::shared_ptr<const Mask> truth);

 private:
  void follow();
  void make_map();

  Display& display_;
  std::shared_ptr<const Mask> truth_;
  Show show_;
  bool shown_ = false;
  Map map_;                             // once it was made
  std::shared_ptr<BackgroundJob> job_;  // while it is made
};

}  // namespace tidemark::engine
