// Drags that set parameters from the values they go over (paper section 6.2).
#pragma once

#include "engine/value_probe.h"
#include "ui/views/drag.h"

namespace tidemark::ui {

class ProbeDrag : public Drag {
 public:
  // Of `volume` on the grid of the case.
  ProbeDrag(DragView view, const Pointer& pressed, std::shared_ptr<const Volume> volume);
  void move(const Pointer& pointer) override;
  void paint(QPainter& painter) const override;

 protected:
  // Enough for a mean and a spread: before, nothing is set.
  static constexpr std::int64_t kEnough = 6;
  [[nodiscard]] const engine::ValueProbe& probe() const { return probe_; }
  virtual void set() = 0;

 private:
  engine::ValueProbe probe_;
  glm::dvec3 last_mm_;
  std::vector<glm::dvec3> way_mm_;
};

// T = mean, epsilon = standard deviation of what D sees, at least least_probed_range().
class SpeedProbeDrag : public ProbeDrag {
 public:
  SpeedProbeDrag(DragView view, const Pointer& pressed);
  [[nodiscard]] QString text() const override;

 private:
  void set() override;
  std::uint64_t gesture_ = engine::CaseProxy::new_gesture();
};

// The same from the voxels around a place.
void probe_speed_at(engine::CaseProxy& proxy, glm::dvec3 place_mm);

// Centre and width, in value and gradient of the study, of the chosen primitive of the transfer function.
class TransferProbeDrag : public ProbeDrag {
 public:
  TransferProbeDrag(DragView view, const Pointer& pressed);
  [[nodiscard]] QString text() const override;

 private:
  void set() override;
};

}  // namespace tidemark::ui
