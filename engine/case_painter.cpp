#include "engine/case_painter.h"

#include <QPointer>
#include <chrono>
#include <type_traits>

#include "renderer/gl/gl_renderer.h"
#include "solver/speed/motion_limit.h"

namespace tidemark::engine {
namespace {

constexpr QImage::Format kImageFormat = QImage::Format_RGB32;  // what Qt paints without a conversion

QImage to_image(const renderer::Picture& picture) {
  const QImage view(picture.pixels.data(), static_cast<int>(picture.width), static_cast<int>(picture.height),
                    static_cast<qsizetype>(picture.width) * 4, QImage::Format_RGBX8888);
  return view.convertToFormat(kImageFormat);
}

bool shows_pages(const AnyView& view) {
  if (const auto* slice = std::get_if<renderer::SliceView>(&view))
    return slice->content == renderer::SliceContent::pages;
  return std::get<renderer::VolumeView>(view).colouring == renderer::SurfaceColouring::pages;
}

// Whether the view shows the level set's source, not the volume as loaded.
bool shows_speed(const AnyView& view) {
  if (const auto* slice = std::get_if<renderer::SliceView>(&view))
    return slice->content == renderer::SliceContent::speed;
  const renderer::SurfaceColouring colouring = std::get<renderer::VolumeView>(view).colouring;
  return colouring != renderer::SurfaceColouring::plain && colouring != renderer::SurfaceColouring::pages;
}

}  // namespace

void CasePainter::add(const std::shared_ptr<ViewSlot>& slot) {
  const std::lock_guard lock(views_mutex_);
  views_.push_back(slot);
}

std::vector<std::shared_ptr<ViewSlot>> CasePainter::views() {
  const std::lock_guard lock(views_mutex_);
  std::erase_if(views_, [](const auto& view) { return view.expired(); });
  std::vector<std::shared_ptr<ViewSlot>> views;
  for (const auto& view : views_) {
    if (auto slot = view.lock()) views.push_back(std::move(slot));
  }
  return views;
}

void CasePainter::forget() {
  shown_ = {};
  solved_ = {};
  const bool lost = device_ && device_->lost();
  for (const auto& slot : views()) {
    slot->textures.reset();
    if (lost) withdraw(*slot);
  }
}

// A texture of a lost context shows nothing that anybody should see.
void CasePainter::withdraw(ViewSlot& slot) {
  {
    const std::lock_guard lock(slot.mutex);
    if (!slot.finished.texture) return;
    slot.finished.texture.reset();
  }
  announce(slot);
}

Result<std::shared_ptr<const solver::Field>> CasePainter::phi(document::Case& document) {
  if (!phi_) {
    auto phi = document.level_set().checkpoint();
    if (!phi) return phi;
    phi_ = std::move(*phi);
    // A state that another executor made keeps its pages until the next step; the renderer's are this one's.
    const Index3 shape = document.level_set().executor().memory().page_shape;
    if (phi_->layout.page_shape() != shape) {
      phi_ = std::make_shared<const solver::Field>(phi_->repaged(phi_->band, shape));
    }
  }
  return phi_;
}

bool CasePainter::out_of_date(ViewSlot& slot) const {
  const std::lock_guard lock(slot.mutex);
  return slot.seen && slot.wish &&
         (slot.wish_is_new || slot.drawn_phi != phi_revision_ || slot.drawn_look != look_revision_);
}

// From the executor's memory where the renderer can read it, else from a copy.
Status CasePainter::show_phi(Canvas& canvas, document::Case& document, bool with_pages) {
  solver::Executor& executor = document.level_set().executor();
  std::optional<std::vector<std::int64_t>> quiet;
  if (with_pages) {
    auto pages = executor.quiet_pages();
    if (!pages) return pass_on(pages);
    quiet = std::move(*pages);
  }
  auto seen = canvas.renderer->look_at(executor, quiet);
  if (!seen) return pass_on(seen);
  canvas.sees_executor = *seen;
  if (*seen) return {};
  const auto field = phi(document);
  if (!field) return pass_on(field);
  ++phi_copies_;
  TIDEMARK_TRY(canvas.renderer->set_phi(*field, quiet.value_or(std::vector<std::int64_t>())));
  if (canvas.gl != nullptr) pages_uploaded_ += canvas.gl->pages_uploaded();
  return {};
}

Status CasePainter::show_labels(Canvas& canvas, const document::Labels& labels) {
  TIDEMARK_TRY(canvas.renderer->set_labels(labels.voxels()));
  if (canvas.label_list == labels.list()) return {};
  std::vector<renderer::LabelColour> colours(renderer::kLabels);
  for (const document::Label& label : labels.list()) {
    const std::uint8_t opacity = label.visible ? 255 : 0;
    colours[label.id] = {label.colour[0], label.colour[1], label.colour[2], opacity};
  }
  TIDEMARK_TRY(canvas.renderer->set_label_colours(colours));
  canvas.label_list = labels.list();
  return {};
}

Status CasePainter::prepare(Canvas& canvas, const std::shared_ptr<const Volume>& source,
                            document::Case& document, bool with_pages) {
  document::LevelSet& level_set = document.level_set();
  if (canvas.renderer && canvas.source != source) canvas = {};
  if (!canvas.renderer) {
    const PageLayout layout(source->geometry.size, level_set.executor().memory().page_shape);
    const auto kind = device_ != nullptr ? engine_.renderer() : renderer::RendererKind::host;
    auto renderer = renderer::make_renderer(kind, device_, source, layout);
    if (!renderer) return pass_on(renderer);
    canvas.renderer = std::move(*renderer);
    canvas.gl = dynamic_cast<renderer::GlRenderer*>(canvas.renderer.get());
    canvas.source = source;
  }
  if (canvas.parameters != level_set.parameters()) {
    canvas.renderer->set_parameters(level_set.parameters());
    canvas.parameters = level_set.parameters();
  }
  if (canvas.speed != speed_) {
    canvas.speed = speed_;
    canvas.renderer->set_speed(canvas.speed);
  }
  if (const auto change = shown_change(level_set); canvas.change != change) {
    canvas.change = change;
    canvas.renderer->set_change(change);
  }
  const bool phi_is_old = canvas.phi != phi_revision_ || (with_pages && canvas.pages != phi_revision_);
  if (phi_is_old || (canvas.sees_executor && canvas.executor_uses != executor_uses_)) {
    TIDEMARK_TRY(show_phi(canvas, document, with_pages));
    canvas.phi = phi_revision_;
    canvas.executor_uses = executor_uses_;
    if (with_pages) canvas.pages = phi_revision_;
  }
  return {};
}

std::shared_ptr<const solver::SpeedFunction> CasePainter::shown_change(
    const document::LevelSet& level_set) const {
  if (distances_) return distances_;
  const auto limit = level_set.recipe().start.limit();
  return limit == nullptr ? nullptr : limit->change();
}

Result<CasePainter::Canvas*> CasePainter::canvas_for(const AnyView& view, document::Case& document,
                                                     const document::Labels* labels) {
  const auto& solved = document.level_set().source();
  const bool another = solved != document.volume() && shows_speed(view);
  Canvas& canvas = another ? solved_ : shown_;
  TIDEMARK_TRY(prepare(canvas, another ? solved : document.volume(), document, shows_pages(view)));
  TIDEMARK_TRY(show_labels(canvas, labels != nullptr ? *labels : document.labels()));
  return &canvas;
}

Result<bool> CasePainter::draw(ViewSlot& slot, document::Case& document, bool plays, std::stop_token stop) {
  std::optional<ViewSlot::Wish> wish;
  bool is_new = false;
  {
    const std::lock_guard lock(slot.mutex);
    if (!slot.seen) return false;
    wish = slot.wish;
    is_new = std::exchange(slot.wish_is_new, false);
  }
  if (!wish || wish->size.width <= 0 || wish->size.height <= 0) return false;
  const auto canvas = canvas_for(wish->view, document, wish->labels.get());
  if (!canvas) return pass_on(canvas);
  if (is_new || slot.drawn_phi != phi_revision_ || slot.drawn_look != look_revision_) {
    slot.quality.moved();
    slot.mean.clear();
    if (slot.textures) slot.textures->clear_mean();
  }
  slot.drawn_phi = phi_revision_;
  slot.drawn_look = look_revision_;
  // Pictures by the processor take their time from the solver. A user who turns the camera waits for one all
  // the same.
  const bool in_passing = plays && !is_new && (*canvas)->gl == nullptr;
  const double seconds =
      in_passing ? renderer::QualityControl::kPlaying : renderer::QualityControl::kInteractive;
  const std::int64_t step = document.level_set().step();
  const Progress progress{nullptr, std::move(stop)};
  if (std::holds_alternative<renderer::VolumeView>(wish->view))
    return draw_volume(slot, *wish, **canvas, seconds, step, progress);
  auto shown = paint(slot, std::get<renderer::SliceView>(wish->view), wish->size, false, **canvas, progress);
  if (!shown) return pass_on(shown);
  deliver(slot, *wish, std::move(*shown), step, true);
  return false;
}

Result<bool> CasePainter::draw_volume(ViewSlot& slot, const ViewSlot::Wish& wish, Canvas& canvas,
                                      double seconds, std::int64_t step, const Progress& progress) {
  const int rounds = canvas.renderer->still_rounds();
  const auto pass = slot.quality.next(wish.size, rounds, seconds);
  if (!pass) return false;
  renderer::VolumeView view = std::get<renderer::VolumeView>(wish.view);
  view.quality = pass->quality;
  const auto begin = std::chrono::steady_clock::now();
  auto shown = paint(slot, view, pass->size, !pass->moving, canvas, progress);
  if (!shown) return pass_on(shown);
  const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  slot.quality.drawn(*pass, passed, shown->painted);
  const bool more = slot.quality.next(wish.size, rounds).has_value();
  deliver(slot, wish, std::move(*shown), step, !more);
  return more;
}

template <class View>
Result<ShownPicture> CasePainter::paint(ViewSlot& slot, const View& view, renderer::PictureSize size,
                                        bool into_mean, Canvas& canvas, const Progress& progress) {
  ShownPicture shown;
  if (canvas.gl != nullptr && engine_.pictures() == Engine::Pictures::textures) {
    if (!slot.textures) {
      auto made = ViewTextures::create(engine_, device_);
      if (!made) return pass_on(made);
      slot.textures = std::move(*made);
    }
    auto texture = slot.textures->draw(*canvas.gl, view, size, into_mean, progress);
    if (!texture) return pass_on(texture);
    shown.texture = std::move(*texture);
    return shown;
  }
  const auto draw = [&]() -> Result<renderer::Picture> {
    if constexpr (std::is_same_v<View, renderer::VolumeView>) {
      if (into_mean) {
        TIDEMARK_TRY(canvas.renderer->add_round(view, size, slot.mean, progress));
        return slot.mean.mean();
      }
    }
    return canvas.renderer->draw(view, size, progress);
  };
  const auto picture = draw();
  if (!picture) return pass_on(picture);
  if (canvas.gl != nullptr) ++pictures_read_back_;
  shown.image = to_image(*picture);
  shown.painted = picture->painted;
  return shown;
}

void CasePainter::deliver(ViewSlot& slot, const ViewSlot::Wish& wish, ShownPicture shown, std::int64_t step,
                          bool finished) {
  shown.view = wish.view;
  shown.size = wish.size;
  shown.step = step;
  shown.finished = finished;
  shown.number = ++slot.pictures;
  {
    const std::lock_guard lock(slot.mutex);
    slot.finished = std::move(shown);
  }
  announce(slot);
}

void CasePainter::announce(ViewSlot& slot) {
  if (!slot.announced.exchange(true)) slot.weak_receiver->send(slot.take);
}

Result<std::optional<renderer::Hit>> CasePainter::pick(const renderer::VolumeView& view,
                                                       renderer::PictureSize size,
                                                       const document::Labels* labels, glm::dvec2 pixel,
                                                       document::Case& document) {
  const auto canvas = canvas_for(view, document, labels);
  if (!canvas) return pass_on(canvas);
  return (*canvas)->renderer->pick(view, size, pixel);
}

}  // namespace tidemark::engine
