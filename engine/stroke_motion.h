// The motion of the surface after a stroke of examples: by so many steps, then a pause. A leak is seen while
// it is small, and the next stroke can meet it.
#pragma once

#include <QObject>
#include <cstdint>
#include <memory>
#include <vector>

#include "document/drive.h"

namespace tidemark::engine {

class CaseProxy;

class StrokeMotion : public QObject {
  Q_OBJECT
 public:
  explicit StrokeMotion(CaseProxy& proxy);

  // Takes `drive`, whose strokes have one more over `voxels`, as one entry of the history. What of a stroke
  // inside lies outside of the surface is added to it; without a surface it begins in all strokes inside. It
  // pauses until the speed function has learned from the stroke, and then moves by `steps`, or until it
  // rests.
  void take(const document::Drive& drive, const std::vector<std::int64_t>& voxels, std::int64_t steps);

 private:
  void add_missed(const std::vector<std::int64_t>& voxels, std::uint64_t gesture);
  void follow();

  CaseProxy& proxy_;
  std::int64_t steps_ = 0;                          // that wait for the function; 0: none do
  std::shared_ptr<const solver::Strokes> strokes_;  // that it learns from
};

}  // namespace tidemark::engine
