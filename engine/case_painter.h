// Pictures of a case, drawn on the engine's thread.
#pragma once

#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "document/case.h"
#include "engine/engine.h"
#include "engine/surface_maps.h"
#include "engine/view_slot.h"
#include "renderer/renderer.h"

namespace tidemark::renderer {
class GlRenderer;
}

namespace tidemark::engine {

class CasePainter {
 public:
  explicit CasePainter(Engine& engine) : engine_(engine) {}

  // Any thread.
  void add(const std::shared_ptr<ViewSlot>& slot);
  // Of the views that still exist.
  [[nodiscard]] std::vector<std::shared_ptr<ViewSlot>> views();

  // The engine's thread. Without a device the processor draws.
  void use(std::shared_ptr<gpu::Device> device) { device_ = std::move(device); }
  // Drops the renderers: the context was lost, or another executor has other pages.
  void forget();

  // phi, or something else that is seen, has changed: every view is out of date.
  void phi_changed() {
    phi_.reset();
    ++phi_revision_;
  }
  void look_changed() { ++look_revision_; }
  // Something was asked of the executor: its memory must be looked at anew, even if phi is as it was.
  void executor_used() { ++executor_uses_; }
  // What speed maps show; null: the tent.
  void set_speed(std::shared_ptr<const solver::SpeedFunction> speed) { speed_ = std::move(speed); }

  // Shown in place of how far the surface has moved; null, of none: that is not wanted.
  void set_surface_map(SurfaceMap which, std::shared_ptr<const solver::SpeedFunction> distances) {
    surface_map_ = which;
    distances_ = std::move(distances);
    look_changed();
  }
  [[nodiscard]] SurfaceMap surface_map() const { return surface_map_; }

  [[nodiscard]] bool out_of_date(ViewSlot& slot) const;
  // Draws the next picture of a view and announces it. Returns whether a better one can follow. Fails
  // (ErrorKind::cancelled) when stopped, (ErrorKind::capability) when the context was lost. While the surface
  // plays, a picture is drawn that leaves the solver its time.
  Result<bool> draw(ViewSlot& slot, document::Case& document, bool plays, std::stop_token stop);
  // `labels`: those that the view shows; null: the document's.
  Result<std::optional<renderer::Hit>> pick(const renderer::VolumeView& view, renderer::PictureSize size,
                                            const document::Labels* labels, glm::dvec2 pixel,
                                            document::Case& document);

  // The current phi, read from the executor at most once until it changes.
  Result<std::shared_ptr<const solver::Field>> phi(document::Case& document);

  // Copies of phi for pictures since the start, and pages of them sent to a GPU. Both are none where renderer
  // and executor work in the same memory.
  [[nodiscard]] std::int64_t phi_copies() const { return phi_copies_; }
  [[nodiscard]] std::int64_t pages_uploaded() const { return pages_uploaded_; }
  // Read-backs of pictures since the start: pictures as textures need none, nor do the processor's.
  [[nodiscard]] std::int64_t pictures_read_back() const { return pictures_read_back_; }

 private:
  // The renderer of one source, with the revisions of the case that it has.
  struct Canvas {
    std::unique_ptr<renderer::Renderer> renderer;
    renderer::GlRenderer* gl = nullptr;  // the same; null where the processor draws
    std::shared_ptr<const Volume> source;
    std::int64_t phi = -1;
    std::int64_t pages = -1;     // revision of phi with which the pages' state was shown
    bool sees_executor = false;  // and no copy of phi
    std::uint64_t executor_uses = 0;
    std::vector<document::Label> label_list;
    std::optional<solver::Parameters> parameters;
    std::shared_ptr<const solver::SpeedFunction> speed;
    std::shared_ptr<const solver::SpeedFunction> change;
  };

  // `labels` are shown in place of the case's; null: those.
  Result<Canvas*> canvas_for(const AnyView& view, document::Case& document, const document::Labels* labels);
  Status prepare(Canvas& canvas, const std::shared_ptr<const Volume>& source, document::Case& document,
                 bool with_pages);
  [[nodiscard]] std::shared_ptr<const solver::SpeedFunction> shown_change(
      const document::LevelSet& level_set) const;
  static Status show_labels(Canvas& canvas, const document::Labels& labels);
  Status show_phi(Canvas& canvas, document::Case& document, bool with_pages);
  Result<bool> draw_volume(ViewSlot& slot, const ViewSlot::Wish& wish, Canvas& canvas, double seconds,
                           std::int64_t step, const Progress& progress);
  // Draws a picture in the form that the views want; its description is not filled in.
  template <class View>
  Result<ShownPicture> paint(ViewSlot& slot, const View& view, renderer::PictureSize size, bool into_mean,
                             Canvas& canvas, const Progress& progress);
  static void withdraw(ViewSlot& slot);
  void deliver(ViewSlot& slot, const ViewSlot::Wish& wish, ShownPicture shown, std::int64_t step,
               bool finished);
  static void announce(ViewSlot& slot);

  Engine& engine_;
  std::shared_ptr<gpu::Device> device_;
  Canvas shown_;   // the volume as it was loaded
  Canvas solved_;  // the level set's source, where that is another one
  std::shared_ptr<const solver::SpeedFunction> speed_;
  SurfaceMap surface_map_ = SurfaceMap::none;
  std::shared_ptr<const solver::SpeedFunction> distances_;  // the map
  std::shared_ptr<const solver::Field> phi_;
  std::int64_t phi_revision_ = 0;
  std::uint64_t look_revision_ = 1;
  std::uint64_t executor_uses_ = 1;
  std::int64_t pages_uploaded_ = 0;
  std::int64_t phi_copies_ = 0;
  std::int64_t pictures_read_back_ = 0;

  std::mutex views_mutex_;
  std::vector<std::weak_ptr<ViewSlot>> views_;
};

}  // namespace tidemark::engine
