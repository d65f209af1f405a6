#include "ui/panels/sweep_matrix.h"

#include <QKeyEvent>
#include <QLinearGradient>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>

#include "ui/look/theme.h"
#include "ui/panels/sweep_axis_choice.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr int kCellGap = 2;
constexpr int kLargestSide = 180;
constexpr int kScaleHeight = 8;
constexpr double kBright = 0.45;  // of a colour on which text is black

QColor colour_of(double share) {
  const auto [red, green, blue] = document::heat_colour(share);
  return {red, green, blue};
}

QColor text_on(const QColor& colour) {
  const double light = 0.299 * colour.redF() + 0.587 * colour.greenF() + 0.114 * colour.blueF();
  return light > kBright ? Qt::black : Qt::white;
}

QString value_text(double value) {
  return general_text(value, 3);
}

QString outcome_text(const document::SweepRun& run) {
  if (!run.problem.empty()) return SweepMatrix::tr("it needs more memory than there is for a run");
  switch (run.outcome) {
    case document::Outcome::vanished:
    case document::Outcome::seeded_outside:
      return SweepMatrix::tr("vanished");
    case document::Outcome::filled_volume:
      return SweepMatrix::tr("fills the volume");
    case document::Outcome::converged:
      return SweepMatrix::tr("at rest");
    case document::Outcome::unfinished:
      break;
  }
  return SweepMatrix::tr("still moving");
}

}  // namespace

QString sweep_run_text(const document::Sweep& sweep, QPoint cell) {
  const document::SweepRun& run = sweep.at(cell.x(), cell.y());
  QStringList values;
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    values << QStringLiteral("%1 %2").arg(sweep_parameter_text(sweep.axes[i].parameter),
                                          general_text(sweep.axes[i].value(i == 0 ? cell.x() : cell.y()), 4));
  }
  QStringList figures;
  if (run.problem.empty()) {
    figures << number_text(run.volume_ml, 2, SweepMatrix::tr("ml"));
    if (run.dice) figures << SweepMatrix::tr("Dice %1").arg(number_text(*run.dice, 3));
    figures << SweepMatrix::tr("%n steps", nullptr, static_cast<int>(run.steps));
  }
  figures << outcome_text(run);
  return QStringLiteral("%1: %2").arg(values.join(QStringLiteral(", ")), figures.join(QStringLiteral(", ")));
}

SweepMatrix::SweepMatrix(QWidget* parent) : QWidget(parent) {
  setAccessibleName(tr("Runs of the sweep"));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setCursor(Qt::PointingHandCursor);
  setToolTip(tr("A click, or Enter, takes a run: the case's parameters and surface become that one's."));
}

void SweepMatrix::show_outcome(std::shared_ptr<const engine::SweepOutcome> outcome) {
  if (outcome == outcome_) return;
  outcome_ = std::move(outcome);
  chosen_ = {0, 0};
  hovered_.reset();
  taken_.reset();
  set_colours(colours_);
  lay_out();
}

void SweepMatrix::set_colours(Colours colours) {
  colours_ = colours;
  if (outcome_) {
    scale_ = colours == Colours::volume ? document::volume_scale(outcome_->sweep)
                                        : document::dice_scale(outcome_->sweep);
  }
  update();
}

void SweepMatrix::set_taken(std::optional<QPoint> cell) {
  if (cell == taken_) return;
  taken_ = cell;
  update();
}

void SweepMatrix::lay_out() {
  if (!outcome_) return;
  const document::Sweep& sweep = outcome_->sweep;
  const QFontMetrics metrics = fontMetrics();
  strip_ = metrics.height() + 2;
  left_ = 0;
  if (sweep.axes.size() > 1) {
    const document::SweepAxis& down = sweep.axes.back();
    left_ = metrics.horizontalAdvance(sweep_parameter_text(down.parameter).left(8));
    for (int row = 0; row < sweep.rows(); ++row)
      left_ = std::max(left_, metrics.horizontalAdvance(value_text(down.value(row))));
    left_ += kSpaceTight;
  }
  top_ = 2 * metrics.height() + kSpaceTight;
  side_ = std::clamp((width() - left_) / sweep.columns() - kCellGap, 8, kLargestSide);
  setFixedHeight(top_ + sweep.rows() * (side_ + strip_ + kCellGap) + kSpace + kScaleHeight + 2 * strip_);
  update();
}

void SweepMatrix::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  lay_out();
}

QRect SweepMatrix::picture_at(QPoint cell) const {
  return {left_ + cell.x() * (side_ + kCellGap), top_ + cell.y() * (side_ + strip_ + kCellGap), side_, side_};
}

std::optional<QPoint> SweepMatrix::cell_at(QPoint place) const {
  if (!outcome_) return std::nullopt;
  const QPoint cell((place.x() - left_) / (side_ + kCellGap),
                    (place.y() - top_) / (side_ + strip_ + kCellGap));
  const bool inside = place.x() >= left_ && place.y() >= top_ && cell.x() < outcome_->sweep.columns() &&
                      cell.y() < outcome_->sweep.rows();
  return inside ? std::optional(cell) : std::nullopt;
}

const document::SweepRun& SweepMatrix::run_at(QPoint cell) const {
  return outcome_->sweep.at(cell.x(), cell.y());
}

void SweepMatrix::paintEvent(QPaintEvent* /*event*/) {
  if (!outcome_) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  paint_axes(painter);
  for (int row = 0; row < outcome_->sweep.rows(); ++row) {
    for (int column = 0; column < outcome_->sweep.columns(); ++column) paint_run(painter, {column, row});
  }
  paint_scale(painter);
}

void SweepMatrix::paint_axes(QPainter& painter) const {
  const document::Sweep& sweep = outcome_->sweep;
  const int line = fontMetrics().height();
  painter.setPen(palette().color(QPalette::WindowText));
  const QString across = sweep_parameter_text(sweep.axes.front().parameter);
  painter.drawText(QRect(left_, 0, sweep.columns() * (side_ + kCellGap), line), Qt::AlignCenter, across);
  for (int column = 0; column < sweep.columns(); ++column) {
    const QRect below = picture_at({column, 0});
    painter.drawText(QRect(below.x() - kCellGap, line, side_ + 2 * kCellGap, line), Qt::AlignCenter,
                     value_text(sweep.axes.front().value(column)));
  }
  if (sweep.axes.size() < 2) return;
  painter.drawText(QRect(0, line, left_, line), Qt::AlignLeft | Qt::AlignVCenter,
                   sweep_parameter_text(sweep.axes.back().parameter).left(8));
  for (int row = 0; row < sweep.rows(); ++row) {
    const QRect beside = picture_at({0, row});
    painter.drawText(QRect(0, beside.y(), left_ - kSpaceTight, side_), Qt::AlignRight | Qt::AlignVCenter,
                     value_text(sweep.axes.back().value(row)));
  }
}

void SweepMatrix::paint_run(QPainter& painter, QPoint cell) const {
  const document::SweepRun& run = run_at(cell);
  const QRect where = picture_at(cell);
  painter.drawImage(
      where, outcome_->pictures[static_cast<std::size_t>(cell.y() * outcome_->sweep.columns() + cell.x())]);
  const bool there = run.volume_ml > 0.0;
  const double value = colours_ == Colours::dice ? run.dice.value_or(0.0) : run.volume_ml;
  const QColor colour = there ? colour_of(scale_.share(value)) : palette().color(QPalette::Mid);
  const QRect strip(where.x(), where.bottom() + 1, side_, strip_);
  painter.fillRect(strip, colour);
  const QString number = colours_ == Colours::dice ? number_text(value, 2) : short_text(value);
  const QString text = there ? number : run.problem.empty() ? QStringLiteral("–") : QStringLiteral("!");
  painter.setPen(there ? text_on(colour) : palette().color(QPalette::WindowText));
  if (fontMetrics().horizontalAdvance(text) <= side_) painter.drawText(strip, Qt::AlignCenter, text);
  const QRect frame = where.adjusted(0, 0, -1, strip_ - 1);
  painter.setBrush(Qt::NoBrush);
  if (taken_ == cell) {
    painter.setPen(QPen(palette().color(QPalette::Highlight), 3.0));
    painter.drawRect(frame.adjusted(1, 1, -1, -1));
  }
  if (hovered_ == cell || (hasFocus() && chosen_ == cell)) {
    painter.setPen(QPen(palette().color(QPalette::WindowText), 1.0, Qt::DashLine));
    painter.drawRect(frame);
  }
}

void SweepMatrix::paint_scale(QPainter& painter) const {
  const document::Sweep& sweep = outcome_->sweep;
  const int bottom = picture_at({0, sweep.rows() - 1}).bottom() + strip_ + kSpace;
  const QRect bar(left_, bottom, std::min(width() - left_, sweep.columns() * (side_ + kCellGap)) - kCellGap,
                  kScaleHeight);
  QLinearGradient gradient(bar.topLeft(), bar.topRight());
  constexpr int kStops = 8;
  for (int i = 0; i <= kStops; ++i) {
    const double share = static_cast<double>(i) / kStops;
    gradient.setColorAt(share, colour_of(share));
  }
  painter.fillRect(bar, gradient);
  const bool dice = colours_ == Colours::dice;
  const QRect words(bar.x(), bar.bottom() + 1, bar.width(), strip_);
  painter.setPen(palette().color(QPalette::WindowText));
  const auto ending = [&](double value) {
    return dice ? tr("Dice %1").arg(number_text(value, 3)) : tr("%1 ml").arg(short_text(value));
  };
  painter.drawText(words, Qt::AlignLeft | Qt::AlignVCenter, ending(scale_.low));
  painter.drawText(words, Qt::AlignRight | Qt::AlignVCenter, ending(scale_.high));
}

void SweepMatrix::mouseMoveEvent(QMouseEvent* event) {
  const auto cell = cell_at(event->position().toPoint());
  if (cell == hovered_) return;
  hovered_ = cell;
  update();
  emit looked_at(current());
}

void SweepMatrix::leaveEvent(QEvent* event) {
  QWidget::leaveEvent(event);
  hovered_.reset();
  update();
  if (outcome_) emit looked_at(current());
}

void SweepMatrix::mousePressEvent(QMouseEvent* event) {
  const auto cell = cell_at(event->position().toPoint());
  if (event->button() != Qt::LeftButton || !cell) return QWidget::mousePressEvent(event);
  chosen_ = *cell;
  update();
  emit looked_at(*cell);
  emit wanted(*cell);
}

void SweepMatrix::keyPressEvent(QKeyEvent* event) {
  if (!outcome_) return QWidget::keyPressEvent(event);
  QPoint way;
  switch (event->key()) {
    case Qt::Key_Left:
      way = {-1, 0};
      break;
    case Qt::Key_Right:
      way = {1, 0};
      break;
    case Qt::Key_Up:
      way = {0, -1};
      break;
    case Qt::Key_Down:
      way = {0, 1};
      break;
    case Qt::Key_Return:
    case Qt::Key_Enter:
      emit wanted(chosen_);
      return;
    default:
      return QWidget::keyPressEvent(event);
  }
  hovered_.reset();
  chosen_.setX(std::clamp(chosen_.x() + way.x(), 0, outcome_->sweep.columns() - 1));
  chosen_.setY(std::clamp(chosen_.y() + way.y(), 0, outcome_->sweep.rows() - 1));
  update();
  emit looked_at(chosen_);
}

}  // namespace tidemark::ui
