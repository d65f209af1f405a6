// The common base of the executors on OpenGL: how phi, and what drives and holds the surface, are replaced.
// They differ in the programs that are compiled for it, and in how pages are woken.
#pragma once

#include <functional>
#include <memory>

#include "gpu/device.h"
#include "solver/executor_base.h"
#include "solver/gl/drive_textures.h"
#include "solver/gl/packed_layout.h"

namespace tidemark::solver {

class GlExecutor : public ExecutorBase {
 public:
  Status restore(const Field& phi) final;
  Status set_constraints(std::shared_ptr<const Constraints> constraints) final;

 protected:
  GlExecutor(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source,
             const Parameters& parameters, const ExecutorOptions& options, Index3 page_shape);
  // The textures of the tent; before the first compile_for_drive().
  Status make_textures();

  // The programs that the model and drive_textures_ ask for, if they are others.
  virtual Status compile_for_drive() = 0;
  // phi, which fits and keeps to walls and anchors, takes the place of the present one.
  virtual Status replace(const Field& phi) = 0;
  // After the parameters or the speed function changed.
  virtual Status wake_all_pages() = 0;
  [[nodiscard]] virtual Status make_current() const { return device_->make_current(); }

  // State of so many bytes and the textures that drive the surface.
  [[nodiscard]] std::int64_t with_textures(std::int64_t state_bytes) const {
    return state_bytes + drive_textures_.bytes();
  }
  // For how many physical pages there is to be room where `needed` are: a fifth more, so that a growing
  // surface seldom waits for room and little lies idle, or `needed` alone where no more fits. `state_bytes`
  // says what so many pages take, with `copied` the former state included. Fails (ErrorKind::capability) when
  // `needed` take more than the memory budget allows beside the textures.
  [[nodiscard]] Result<std::int64_t> capacity_for(
      std::int64_t needed, bool copied, const std::function<std::int64_t(std::int64_t)>& state_bytes) const;

  // Of pages beside those that an edit has changed or a run has moved into. A run fails where one finds no
  // room; an edit is done without them, and the next run asks for them again.
  enum class NoRoom { fails, waits };

  // Fills what drives the surface around resident pages, and as far as it comes in so many steps. Fails
  // (ErrorKind::capability) when that takes more than the memory budget allows.
  Status fill_drive(std::span<const std::int64_t> pages, std::int64_t steps);

  // How many pages away along each axis the surface can be whose distance a page's voxels hold; no further
  // than the volume goes, however far the band does.
  [[nodiscard]] Index3 band_reach() const;

  std::shared_ptr<gpu::Device> device_;  // first: it outlives everything below
  ExecutorOptions options_;
  PackedLayout layout_;
  DriveTextures drive_textures_;
  mutable Field known_;  // the last copy, or what was restored: the next copy shares what is as it was
  std::int64_t peak_resident_ = 0;
  std::int64_t peak_bytes_ = 0;

 private:
  Status drive(const Parameters& parameters, std::shared_ptr<const SpeedFunction> given) final;
  Status use_constraints(std::shared_ptr<const Constraints> constraints, const Field& phi);
  // `textures`: what drives the surface would take so many bytes.
  [[nodiscard]] Status check_budget(std::int64_t textures) const;
  [[nodiscard]] Status check_drive(const SpeedFunction& speed, const Constraints* constraints) const;
};

}  // namespace tidemark::solver
