// Pictures drawn by the processor, straight from pages in its memory. It needs no OpenGL.
#pragma once

#include "renderer/host/host_scene.h"
#include "renderer/host/last_pictures.h"
#include "renderer/renderer.h"

namespace tidemark::renderer {

// The same views as GlRenderer's, by the same formulas. Mode::slices, which is how a GPU draws a source that
// is too large for it, is drawn by rays, too. Pixels do not depend on the number of threads.
class HostRenderer final : public Renderer {
 public:
  // Pictures of level sets on `source` in pages of this layout, whose sides are powers of two. `threads`: 0
  // for all processors of this process. Fails (ErrorKind::usage) when the layout is not of the source.
  static Result<std::unique_ptr<HostRenderer>> create(std::shared_ptr<const Volume> source,
                                                      const PageLayout& layout, int threads = 0);

  [[nodiscard]] std::string_view name() const override { return "host"; }
  [[nodiscard]] const Volume& source() const override { return scene_.source.volume(); }

  using Renderer::set_phi;
  Status set_phi(std::shared_ptr<const solver::Field> phi, std::span<const std::int64_t> quiet) override;
  Result<bool> look_at(solver::Executor& executor,
                       const std::optional<std::vector<std::int64_t>>& quiet) override;
  void set_parameters(const solver::Parameters& parameters) override;
  void set_speed(std::shared_ptr<const solver::SpeedFunction> speed) override;
  void set_change(std::shared_ptr<const solver::SpeedFunction> change) override;
  Status set_constraints(const solver::Constraints* constraints) override;
  Status set_labels(const PagedBytes& labels) override;
  Status set_label_colours(std::span<const LabelColour> colours) override;

  using Renderer::draw;
  Result<Picture> draw(const VolumeView& view, PictureSize size, const Progress& progress) override;
  Result<Picture> draw(const SliceView& view, PictureSize size, const Progress& progress) override;
  // A lattice of rays (docs/decisions/024-host-renderer.md).
  [[nodiscard]] int still_rounds() const override { return 3; }
  // After the first round only uneven_pixels() of the mean get another ray.
  Status add_round(const VolumeView& view, PictureSize size, PictureMean& mean,
                   const Progress& progress) override;
  Result<std::optional<Hit>> pick(const VolumeView& view, PictureSize size, glm::dvec2 pixel) override;

 private:
  HostRenderer(std::shared_ptr<const Volume> source, const PageLayout& layout, int threads);
  [[nodiscard]] VolumeView resolved(const VolumeView& asked);

  std::shared_ptr<const Volume> volume_;
  HostScene scene_;
  ThreadPool threads_;
  LastPictures last_pictures_;
  std::optional<std::pair<float, float>> common_range_;  // of the source, once it is needed
};

}  // namespace tidemark::renderer
