#include "ui/views/next_step.h"

#include <QEvent>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/views/play.h"

namespace tidemark::ui {
namespace {

constexpr int kPlaySide = 88;  // logical pixels
constexpr int kHintWidth = 250;
constexpr double kHintRadius = 8.0;

// Views are dark in every theme.
const QColor kBacking(0, 0, 0, 150);
const QColor kOnDark(240, 240, 240);
}  // namespace

PlayButton::PlayButton(QWidget* parent) : QAbstractButton(parent) {
  setText(tr("Play"));
  setAccessibleName(tr("Play"));
  setToolTip(tr("Lets the surface move: it grows where the speed map is orange."));
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
}

QSize PlayButton::sizeHint() const {
  return {kPlaySide, kPlaySide};
}

void PlayButton::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QPointF middle = QRectF(rect()).center();
  const double radius = kPlaySide / 2.0 - 4.0;
  const bool hot = underMouse() || hasFocus();
  painter.setPen(QPen(kOnDark, hot ? 4.0 : 2.0));
  QColor fill = palette().color(QPalette::Highlight);
  fill.setAlphaF(isDown() ? 1.0F : 0.85F);
  painter.setBrush(fill);
  painter.drawEllipse(middle, radius, radius);
  painter.setPen(Qt::NoPen);
  painter.setBrush(palette().color(QPalette::HighlightedText));
  // A triangle about its centre of gravity.
  const double side = 0.5 * radius;
  painter.drawPolygon(QPolygonF({middle + QPointF(-0.7 * side, -side), middle + QPointF(-0.7 * side, side),
                                 middle + QPointF(1.1 * side, 0.0)}));
}

void PlayButton::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return click();
  QAbstractButton::keyPressEvent(event);
}

bool PlayButton::event(QEvent* event) {
  if (event->type() == QEvent::Enter || event->type() == QEvent::Leave) update();
  return QAbstractButton::event(event);
}

NextStep::NextStep(engine::CaseProxy& proxy, QWidget& view)
    : QWidget(&view),
      proxy_(proxy),
      view_(view),
      hint_(new QWidget),
      how_(new QLabel),
      play_(new PlayButton) {
  auto* column = new QVBoxLayout(hint_);
  column->setContentsMargins(kSpaceGroups, kSpaceGroups, kSpaceGroups, kSpaceGroups);
  column->setSpacing(kSpace);
  how_->setWordWrap(true);
  how_->setAlignment(Qt::AlignCenter);
  QPalette colours = how_->palette();
  colours.setColor(QPalette::WindowText, kOnDark);
  how_->setPalette(colours);
  auto* place = new QPushButton(icon(u"tool-seed"), tr("Sphere tool"));
  place->setToolTip(tr("Takes the tool that places spheres, and shows the panel with other ways to begin."));
  connect(place, &QPushButton::clicked, this, &NextStep::place_wanted);
  column->addWidget(how_);
  column->addWidget(place, 0, Qt::AlignHCenter);
  connect(play_, &PlayButton::clicked, this, [this] {
    view_.setFocus();  // the button goes
    // A drag turns the 3D view from now on, and no click adds a sphere by accident.
    if (proxy_.display().settings().tool == engine::Tool::seed)
      proxy_.display().choose_tool(engine::Tool::window);
    toggle_play(proxy_);
  });
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(hint_);
  all->addWidget(play_);
  view_.installEventFilter(this);
  connect(&proxy_, &engine::CaseProxy::state_changed, this, &NextStep::follow);
  connect(&proxy_.display(), &engine::Display::changed, this, &NextStep::follow);
  follow();
}

void NextStep::follow() {
  const engine::CaseState& state = proxy_.state();
  const engine::DisplaySettings& settings = proxy_.display().settings();
  const bool begins_in_strokes = !state.begun && can_play(proxy_);
  const bool to_place = !state.begun && !begins_in_strokes && !settings.show_source;
  const bool to_play = begins_in_strokes || (state.begun && !state.playing && state.step == 0);
  const bool wanted = !settings.clip_on && (to_place || to_play);
  how_->setText(
      settings.tool == engine::Tool::seed
          ? tr("Place a surface: click in the tissue, in a slice. Or drag from its middle.")
          : tr("Place a surface: take the sphere tool. Then click in the tissue, in a slice, or drag "
               "from its middle."));
  hint_->setVisible(to_place);
  play_->setVisible(to_play);
  if (wanted) move_into_view();
  setVisible(wanted);
}

void NextStep::move_into_view() {
  hint_->setFixedWidth(std::min(kHintWidth, view_.width()));
  adjustSize();
  // A surface or labels are seen in the middle.
  const double height = play_->isHidden() && !proxy_.state().label_voxels ? 0.5 : 0.75;
  QRect place(QPoint(), size());
  place.moveCenter({view_.rect().center().x(), static_cast<int>(height * view_.height())});
  setGeometry(place);
}

bool NextStep::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) move_into_view();
  return QWidget::eventFilter(watched, event);
}

void NextStep::paintEvent(QPaintEvent* /*event*/) {
  if (hint_->isHidden()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(kBacking);
  painter.drawRoundedRect(rect(), kHintRadius, kHintRadius);
}

}  // namespace tidemark::ui
