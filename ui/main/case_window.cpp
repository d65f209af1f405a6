#include "ui/main/case_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDataStream>
#include <QDockWidget>
#include <QJsonDocument>
#include <QJsonObject>
#include <QMenu>
#include <QSet>
#include <algorithm>
#include <glm/common.hpp>

#include "engine/display_json.h"
#include "renderer/camera.h"
#include "ui/main/case_head.h"
#include "ui/main/dock_shares.h"
#include "ui/main/view_menu.h"
#include "ui/settings.h"
#include "ui/views/slice_view.h"
#include "ui/views/speed_map_choice.h"
#include "ui/views/view_bar.h"
#include "ui/views/volume_view.h"

namespace tidemark::ui {
namespace {

constexpr const char* kKind = "view_kind";          // property of a dock
constexpr const char* kViewNumber = "view_number";  // of its name, by which Qt finds it in a saved state
constexpr int kLayoutVersion = 1;

ViewKind kind_of(const QDockWidget* dock) {
  return static_cast<ViewKind>(dock->property(kKind).toInt());
}

PictureView* view_of(const QDockWidget* dock) {
  return qobject_cast<PictureView*>(dock->widget());
}

// The display of a new case.
engine::DisplaySettings first_settings(const engine::CaseProxy& proxy) {
  const Volume& volume = proxy.volume();
  engine::DisplaySettings settings;
  settings.slice_centre_mm = renderer::middle_of(volume.geometry);
  // On slices, not between the middle two.
  settings.cursor_mm = volume.geometry.to_patient(glm::dvec3(volume.geometry.size / Index3(2)));
  if (const auto& start = proxy.study().start; start && start->seed) {
    // The start that suits the phantom.
    const auto& seed = *start->seed;
    settings.cursor_mm = volume.geometry.to_patient({seed[0], seed[1], seed[2]});
  }
  settings.oblique = acquired_plane(volume.geometry);
  settings.window = proxy.summary().window;
  settings.clip.normal = {0.0, -1.0, 0.0};
  settings.clip.offset_mm = -renderer::middle_of(volume.geometry).y;
  settings.camera.azimuth = 30.0;
  settings.camera.elevation = 20.0;
  const glm::dvec3 extent = glm::dvec3(volume.geometry.size) * volume.geometry.spacing_mm;
  settings.brush_mm = 0.03 * std::max({extent.x, extent.y, extent.z});
  return settings;
}

// The slice as it lies: in the other planes a single one is a line.
ViewKind kind_of_slice(const Geometry& geometry) {
  constexpr double kParallel = 1.0 - 1e-6;  // within a twelfth of a degree
  const glm::dvec3 normal = glm::abs(geometry.direction[2]);
  if (normal.z > kParallel) return ViewKind::axial;
  if (normal.y > kParallel) return ViewKind::coronal;
  return normal.x > kParallel ? ViewKind::sagittal : ViewKind::oblique;
}

// "Patient – series", without what is not known or not to be read.
QString title_of(engine::CaseProxy& proxy) {
  const QString patient = QString::fromStdString(proxy.study().patient.name);
  const bool is_phantom = !proxy.origin().phantom.empty();
  if (patient.isEmpty() || is_phantom || !proxy.display().settings().patient_text) return proxy.name();
  return QStringLiteral("%1 \u2013 %2").arg(patient, proxy.name());
}

}  // namespace

QString text_of(ViewKind kind) {
  switch (kind) {
    case ViewKind::axial:
      return CaseWindow::tr("Axial slice");
    case ViewKind::coronal:
      return CaseWindow::tr("Coronal slice");
    case ViewKind::sagittal:
      return CaseWindow::tr("Sagittal slice");
    case ViewKind::oblique:
      return CaseWindow::tr("Oblique slice");
    case ViewKind::speed:
      return CaseWindow::tr("Speed map");
    case ViewKind::pages:
      return CaseWindow::tr("Pages of memory");
    case ViewKind::volume:
      return CaseWindow::tr("3D rendering");
  }
  return {};
}

CaseWindow::CaseWindow(std::unique_ptr<engine::CaseProxy> proxy, Actions& actions, QWidget* parent)
    : QMainWindow(parent), proxy_(std::move(proxy)), actions_(actions) {
  proxy_->display().set(first_settings(*proxy_));
  make_contents();
  arrange(proxy_->volume().geometry.size.z == 1 ? ViewLayout::single : settings::layout().get());
}

CaseWindow::CaseWindow(KeptCase kept, Actions& actions, QWidget* parent)
    : QMainWindow(parent),
      session_file(std::move(kept.session_file)),
      proxy_(std::move(kept.proxy)),
      actions_(actions),
      autosave_(std::move(kept.autosave)),
      number_(kept.number) {
  make_contents();
  proxy_->translate_state();
}

KeptCase CaseWindow::keep() {
  KeptCase kept{nullptr, std::move(autosave_), arrangement(), session_file, number_};
  // Until there is another window it is shown as it was.
  kept.autosave->ask_view_state_of([state = view_state()] { return state; });
  proxy_->disconnect(this);
  proxy_->display().disconnect(this);
  kept.proxy = std::move(proxy_);
  return kept;
}

void CaseWindow::make_contents() {
  setWindowFlags(Qt::Widget);
  setDockNestingEnabled(true);
  setDockOptions(QMainWindow::AnimatedDocks | QMainWindow::AllowNestedDocks | QMainWindow::AllowTabbedDocks);
  setContextMenuPolicy(Qt::NoContextMenu);
  for (const Qt::DockWidgetArea area :
       {Qt::LeftDockWidgetArea, Qt::RightDockWidgetArea, Qt::TopDockWidgetArea}) {
    setTabPosition(area, QTabWidget::North);
  }
  shares_ = new DockShares(*this);
  auto* head = new CaseHead;
  setMenuWidget(head);
  head->set_case(this);
  connect(proxy_.get(), &engine::CaseProxy::state_changed, this, &CaseWindow::follow_state);
  connect(&proxy_->display(), &engine::Display::changed, this, &CaseWindow::follow_state);
  follow_state();
  const auto shown = [this] { return view_state(); };
  if (autosave_) return autosave_->ask_view_state_of(shown);
  autosave_ = std::make_unique<engine::CaseAutosave>(*proxy_, engine::recovery_folder(), shown);
}

CaseWindow::~CaseWindow() {
  autosave_.reset();
  // Views use the proxy until they are destroyed.
  qDeleteAll(docks_);
}

void CaseWindow::set_number(int number) {
  number_ = number;
  emit mark_changed();
}

void CaseWindow::set_linked(bool linked) {
  linked_ = linked;
  emit mark_changed();
}

void CaseWindow::set_difference(const QString& difference) {
  if (difference == difference_) return;
  difference_ = difference;
  emit mark_changed();
}

void CaseWindow::set_covered(bool covered) {
  covered_ = covered;
  follow_cover();
}

void CaseWindow::follow_cover() {
  for (QDockWidget* dock : docks_) view_of(dock)->set_covered(covered_ && !dock->isFloating());
}

void CaseWindow::follow_state() {
  setWindowTitle(title_of(*proxy_) + QStringLiteral("[*]"));
  setWindowModified(proxy_->state().modified);
}

// Views.

PictureView* CaseWindow::make_view(ViewKind kind) {
  switch (kind) {
    case ViewKind::axial:
      return new SliceViewWidget(*proxy_, SlicePlane::axial, renderer::SliceContent::source);
    case ViewKind::coronal:
      return new SliceViewWidget(*proxy_, SlicePlane::coronal, renderer::SliceContent::source);
    case ViewKind::sagittal:
      return new SliceViewWidget(*proxy_, SlicePlane::sagittal, renderer::SliceContent::source);
    case ViewKind::oblique:
      return new SliceViewWidget(*proxy_, SlicePlane::oblique, renderer::SliceContent::source);
    case ViewKind::speed:
      return new SliceViewWidget(*proxy_, SlicePlane::axial, renderer::SliceContent::speed);
    case ViewKind::pages:
      return new SliceViewWidget(*proxy_, SlicePlane::axial, renderer::SliceContent::pages);
    case ViewKind::volume:
      break;
  }
  return new VolumeViewWidget(*proxy_);
}

QDockWidget* CaseWindow::make_dock(ViewKind kind, int number) {
  PictureView* view = make_view(kind);
  auto* dock = new QDockWidget(view->title(), this);
  dock->setObjectName(QStringLiteral("view-%1").arg(number));
  dock->setProperty(kViewNumber, number);
  dock->setProperty(kKind, static_cast<int>(kind));
  dock->setWidget(view);
  auto* bar = new ViewBar(*proxy_, view->title(), actions_.tools->actions());
  if (kind == ViewKind::speed) bar->add_choice(new SpeedMapChoice(*proxy_, bar));
  dock->setTitleBarWidget(bar);
  connect(bar, &ViewBar::close_wanted, dock, &QDockWidget::close);
  connect(bar, &ViewBar::float_wanted, dock, [dock] { dock->setFloating(!dock->isFloating()); });
  connect(bar, &ViewBar::maximise_wanted, this, [this, dock] { toggle_maximised(dock); });
  connect(view, &PictureView::maximise_wanted, this, [this, dock] { toggle_maximised(dock); });
  connect(view, &PictureView::activated, this, [this, view, dock] {
    active_ = view;
    // To the MDI area a window of its own is none of the case's.
    if (dock->isFloating()) emit activation_wanted(*this);
  });
  connect(view, &PictureView::menu_wanted, this, [this, view](QPoint at, std::optional<glm::dvec3> place_mm) {
    make_view_menu(*view, actions_, place_mm)->popup(view->mapToGlobal(at));
  });
  if (auto* volume = qobject_cast<VolumeViewWidget*>(view)) {
    connect(volume, &VolumeViewWidget::place_wanted, this, [this] {
      actions_.tool(engine::Tool::seed)->trigger();
      emit place_panel_wanted();
    });
  }
  connect(dock, &QDockWidget::topLevelChanged, this, &CaseWindow::follow_cover);
  docks_ << dock;
  return dock;
}

QDockWidget* CaseWindow::dock(ViewKind kind) {
  for (QDockWidget* dock : docks_) {
    if (kind_of(dock) == kind) return dock;
  }
  return make_dock(kind);
}

PictureView* CaseWindow::add_view(ViewKind kind) {
  // One that was closed comes back before another is made.
  for (QDockWidget* dock : docks_) {
    if (kind_of(dock) != kind || !dock->isHidden()) continue;
    dock->show();
    dock->raise();
    return view_of(dock);
  }
  QDockWidget* beside = active_ ? dock_of(active_) : docks_.value(0);
  QDockWidget* dock = make_dock(kind);
  addDockWidget(Qt::LeftDockWidgetArea, dock);
  if (beside && !beside->isFloating()) tabifyDockWidget(beside, dock);
  dock->show();
  dock->raise();
  return view_of(dock);
}

PictureView* CaseWindow::show_view(ViewKind kind) {
  for (QDockWidget* dock : docks_) {
    if (kind_of(dock) != kind || dock->isHidden()) continue;
    dock->raise();
    return view_of(dock);
  }
  return add_view(kind);
}

void CaseWindow::set_layout(ViewLayout layout) {
  settings::layout().set(layout);
  arrange(layout);
}

void CaseWindow::arrange(ViewLayout layout) {
  layout_ = layout;
  before_maximised_.clear();
  for (QDockWidget* dock : docks_) {
    dock->setFloating(false);
    removeDockWidget(dock);
  }
  QList<QDockWidget*> shown;
  const auto first = [&](ViewKind kind) {
    shown << dock(kind);
    addDockWidget(Qt::LeftDockWidgetArea, shown.back());
  };
  const auto split = [&](qsizetype from, ViewKind kind, Qt::Orientation orientation) {
    shown << dock(kind);
    splitDockWidget(shown[from], shown.back(), orientation);
  };
  switch (layout) {
    case ViewLayout::single: {
      const Geometry& geometry = proxy_->volume().geometry;
      first(geometry.size.z == 1 ? kind_of_slice(geometry) : ViewKind::axial);
      break;
    }
    case ViewLayout::one_three:
      first(ViewKind::volume);
      split(0, ViewKind::axial, Qt::Horizontal);
      split(1, ViewKind::coronal, Qt::Vertical);
      split(2, ViewKind::sagittal, Qt::Vertical);
      break;
    case ViewLayout::two_two:
      first(ViewKind::axial);
      split(0, ViewKind::sagittal, Qt::Horizontal);
      split(0, ViewKind::coronal, Qt::Vertical);
      split(1, ViewKind::volume, Qt::Vertical);
      break;
    case ViewLayout::paper:
      first(ViewKind::axial);
      split(0, ViewKind::volume, Qt::Horizontal);
      split(0, ViewKind::speed, Qt::Vertical);
      break;
  }
  for (QDockWidget* dock : shown) dock->show();
  // The others are deleted: restoreState() would show them again at their old places.
  const auto unused = std::stable_partition(docks_.begin(), docks_.end(),
                                            [&](QDockWidget* dock) { return shown.contains(dock); });
  qDeleteAll(unused, docks_.end());
  docks_.erase(unused, docks_.end());
  constexpr double kBesideVolume = 0.55;  // from 1300 pixels on, the speed map's bar then shows T and epsilon
  DockShares::Shares shares;
  for (QDockWidget* dock : shown) {
    if (layout == ViewLayout::one_three)
      shares[dock] = dock == shown[0] ? QSizeF(2.0 / 3.0, 1.0) : QSizeF(1.0 / 3.0, 1.0 / 3.0);
    else if (layout == ViewLayout::two_two)
      shares[dock] = {0.5, 0.5};
    else if (layout == ViewLayout::paper)
      shares[dock] = dock == shown[1] ? QSizeF(1.0 - kBesideVolume, 1.0) : QSizeF(kBesideVolume, 0.5);
  }
  shares_->set(shares);
  active_ = view_of(shown.front());
}

void CaseWindow::toggle_maximised(QDockWidget* dock) {
  if (dock->isFloating()) {
    dock->isMaximized() ? dock->showNormal() : dock->showMaximized();
    return;
  }
  if (!before_maximised_.isEmpty()) {
    restoreState(std::exchange(before_maximised_, {}), kLayoutVersion);
    return;
  }
  before_maximised_ = saveState(kLayoutVersion);
  for (QDockWidget* other : docks_) {
    if (other != dock && !other->isFloating()) other->hide();
  }
}

PictureView* CaseWindow::active_view() const {
  if (active_ && active_->isVisible()) return active_;
  for (PictureView* view : views()) {
    if (view->isVisible()) return view;
  }
  return nullptr;
}

QList<PictureView*> CaseWindow::views() const {
  QList<PictureView*> views;
  for (const QDockWidget* dock : docks_) views << view_of(dock);
  return views;
}

QDockWidget* CaseWindow::dock_of(const PictureView* view) const {
  for (QDockWidget* dock : docks_) {
    if (dock->widget() == view) return dock;
  }
  return nullptr;
}

void CaseWindow::reset_views() {
  const engine::DisplaySettings first = first_settings(*proxy_);
  proxy_->display().change([&](engine::DisplaySettings& settings) {
    settings.cursor_mm = first.cursor_mm;
    settings.slice_centre_mm = first.slice_centre_mm;
    settings.slice_zoom = first.slice_zoom;
    settings.window = first.window;
    settings.camera = first.camera;
  });
  for (PictureView* view : views()) {
    auto* volume_view = qobject_cast<VolumeViewWidget*>(view);
    if (volume_view && volume_view->isVisible()) return volume_view->fit_camera();
  }
}

// Session files.

QByteArray CaseWindow::arrangement() const {
  QByteArray bytes;
  QDataStream stream(&bytes, QIODevice::WriteOnly);
  stream.setVersion(QDataStream::Qt_6_4);
  QList<int> kinds;
  QList<int> numbers;
  for (const QDockWidget* dock : docks_) {
    kinds << static_cast<int>(kind_of(dock));
    numbers << dock->property(kViewNumber).toInt();
  }
  // One view that is large for a moment does not make the others go.
  const QByteArray state = before_maximised_.isEmpty() ? saveState(kLayoutVersion) : before_maximised_;
  stream << static_cast<int>(layout_) << kinds << state << numbers;
  return bytes;
}

void CaseWindow::show_views(const QByteArray& arrangement) {
  QDataStream stream(arrangement);
  stream.setVersion(QDataStream::Qt_6_4);
  int layout = -1;
  QList<int> kinds;
  QByteArray state;
  QList<int> numbers;
  stream >> layout >> kinds >> state;
  if (stream.atEnd()) {
    for (int number = 1; number <= kinds.size(); ++number) numbers << number;  // as files had it at first
  } else {
    stream >> numbers;
  }
  constexpr int kMostViews = 64;
  if (stream.status() != QDataStream::Ok || kinds.size() > kMostViews) return;
  if (numbers.size() != kinds.size() || QSet<int>(numbers.begin(), numbers.end()).size() != kinds.size())
    return;
  if (layout < 0 || layout > static_cast<int>(ViewLayout::paper)) return;
  for (const int kind : kinds) {
    if (kind < 0 || kind > static_cast<int>(ViewKind::volume)) return;
  }
  qDeleteAll(std::exchange(docks_, {}));
  before_maximised_.clear();
  layout_ = static_cast<ViewLayout>(layout);
  docks_made_ = 0;
  for (qsizetype i = 0; i < kinds.size(); ++i) {
    docks_made_ = std::max(docks_made_, numbers[i]);
    addDockWidget(Qt::LeftDockWidgetArea, make_dock(static_cast<ViewKind>(kinds[i]), numbers[i]));
  }
  shares_->forget();
  if (!restoreState(state, kLayoutVersion)) arrange(layout_);
}

std::string CaseWindow::view_state() const {
  const QJsonObject state{{"display", QString::fromStdString(engine::to_json(proxy_->display().settings()))},
                          {"views", QString::fromLatin1(arrangement().toBase64())}};
  return QJsonDocument(state).toJson(QJsonDocument::Compact).toStdString();
}

Status CaseWindow::restore_view(const document::SessionContents& contents) {
  const QJsonObject state = QJsonDocument::fromJson(QByteArray::fromStdString(contents.view_state)).object();
  const QByteArray views = QByteArray::fromBase64(state["views"].toString().toLatin1());
  if (!views.isEmpty()) show_views(views);
  // All at once: between two changes the images would not be those that drive the surface.
  engine::DisplaySettings settings = proxy_->display().settings();
  settings.images.clear();
  for (const auto& image : contents.images) settings.images.push_back(engine::shown_image(image));
  // Their looks are saved in that order.
  const std::string display = state["display"].toString("{}").toStdString();
  auto shown = engine::display_settings(display, settings);
  if (shown) {
    settings = *shown;
  } else if (auto measured = engine::display_measurements(display, settings)) {
    settings = std::move(*measured);
  }
  const auto& drive = contents.wanted_drive ? contents.wanted_drive : contents.recipe.final_drive();
  if (drive && document::uses_images(drive->setting)) engine::use_images(settings.images, drive->images);
  proxy_->set_saved(settings);
  proxy_->display().set(settings);
  return shown ? Status() : pass_on(shown);
}

void CaseWindow::close_saved() {
  saved_ = true;
  // The MDI child, and with it this.
  if (parentWidget()) parentWidget()->close();
  saved_ = false;  // it may have stayed: while a question about it is open, nothing closes it
}

void CaseWindow::closeEvent(QCloseEvent* event) {
  if (saved_) return event->accept();
  emit close_wanted(*this, event);
}

void CaseWindow::changeEvent(QEvent* event) {
  QMainWindow::changeEvent(event);
  // Qt hands the title of the inner window to the MDI child.
  if (event->type() == QEvent::ModifiedChange && parentWidget())
    parentWidget()->setWindowModified(isWindowModified());
}

}  // namespace tidemark::ui
