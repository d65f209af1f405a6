#include "ui/opening/start_page.h"

#include <QBoxLayout>
#include <QDragEnterEvent>
#include <QGridLayout>
#include <QLabel>
#include <QMimeData>
#include <QPainter>
#include <QScrollArea>
#include <QStyle>
#include <QToolButton>
#include <algorithm>

#include "engine/phantom_text.h"
#include "imaging/phantom/phantom.h"
#include "ui/opening/card_button.h"
#include "ui/opening/dropped_paths.h"
#include "ui/widgets/relative_font.h"

namespace tidemark::ui {
namespace {

constexpr int kContentWidth = 980;  // wider windows get margins
constexpr int kTwoColumns = 720;    // from this width on
constexpr int kFrame = 3;
constexpr int kMostRecent = 5;  // more are in the menu
constexpr std::string_view kFirstToTry = "tumour";

QLabel* label(const QString& text, double size, bool bold, QWidget* parent) {
  auto* made = new QLabel(text, parent);
  set_relative_font(*made, size, bold ? QFont::DemiBold : QFont::Normal);
  made->setWordWrap(true);
  return made;
}

void clear(QLayout& layout) {
  while (QLayoutItem* item = layout.takeAt(0)) {
    if (QWidget* widget = item->widget()) {
      widget->hide();
      widget->deleteLater();
    }
    delete item;
  }
}

}  // namespace

StartPage::StartPage(RecentStudies& recent, QWidget* parent) : QWidget(parent), recent_(recent) {
  setAcceptDrops(true);
  setAccessibleName(tr("Start page"));
  build();
  fill_recent();
  connect(&recent_, &RecentStudies::changed, this, &StartPage::fill_recent);
}

void StartPage::build() {
  auto* scroll = new QScrollArea(this);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->viewport()->setAutoFillBackground(false);
  content_ = new QWidget;
  content_->setAutoFillBackground(false);
  content_->setMaximumWidth(kContentWidth);
  auto* column = new QVBoxLayout(content_);
  column->setContentsMargins(32, 28, 32, 20);
  column->setSpacing(6);
  column->addWidget(label(tr("Tidemark"), 2.4, true, content_));
  column->addWidget(
      label(tr("Segment a volume by steering a surface while it evolves."), 1.15, false, content_));
  column->addSpacing(18);
  columns_ = new QBoxLayout(QBoxLayout::LeftToRight);
  columns_->setSpacing(36);
  opening_ = build_opening();
  columns_->addWidget(opening_, 5);
  columns_->addWidget(build_phantoms(), 6);
  column->addLayout(columns_);
  column->addStretch(1);
  column->addSpacing(16);
  column->addWidget(label(tr("Research use only. Not for diagnostic use."), 1.0, false, content_));

  auto* centred = new QWidget;
  auto* row = new QHBoxLayout(centred);
  row->setContentsMargins(0, 0, 0, 0);
  row->addStretch(1);
  row->addWidget(content_, 1000);
  row->addStretch(1);
  scroll->setWidget(centred);
  centred->setAutoFillBackground(false);
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(kFrame, kFrame, kFrame, kFrame);  // for the frame while something is dragged over
  whole->addWidget(scroll);
}

QWidget* StartPage::build_opening() {
  auto* part = new QWidget(content_);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  column->addWidget(label(tr("Open a study"), 1.3, true, part));
  auto* folder = new CardButton(tr("Open folder…"), tr("DICOM images, in subfolders, too."), part);
  auto* file = new CardButton(tr("Open file…"),
                              tr("NIfTI, NRRD, MetaImage, GIPL, PNG, JPEG, TIFF, a DICOM image, a DICOMDIR, "
                                 "or a zip archive of these."),
                              part);
  folder->setObjectName("open_folder");
  file->setObjectName("open_file");
  connect(folder, &CardButton::clicked, this, &StartPage::open_folder);
  connect(file, &CardButton::clicked, this, &StartPage::open_file);
  column->addWidget(folder);
  column->addWidget(file);
  column->addWidget(label(tr("Or drop a folder or a file anywhere on this page."), 1.0, false, part));
  column->addSpacing(14);
  column->addWidget(build_lessons());
  column->addSpacing(14);

  auto* heading = new QHBoxLayout;
  heading->addWidget(label(tr("Recent studies"), 1.3, true, part), 1);
  auto* clear_all = new QToolButton(part);
  clear_all->setObjectName("clear_recent");
  clear_all->setText(tr("Clear"));
  clear_all->setAccessibleName(tr("Clear the list of recent studies"));
  clear_all->setAutoRaise(true);
  clear_all->setFocusPolicy(Qt::StrongFocus);
  connect(clear_all, &QToolButton::clicked, &recent_, &RecentStudies::clear);
  connect(&recent_, &RecentStudies::changed, clear_all,
          [this, clear_all] { clear_all->setVisible(!recent_.list().isEmpty()); });
  clear_all->setVisible(!recent_.list().isEmpty());
  heading->addWidget(clear_all);
  column->addLayout(heading);
  recent_list_ = new QVBoxLayout;
  recent_list_->setSpacing(8);
  column->addLayout(recent_list_);
  column->addStretch(1);
  return part;
}

QWidget* StartPage::build_lessons() {
  auto* part = new QWidget(content_);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  column->addWidget(label(tr("Learn how it works"), 1.3, true, part));
  auto* card = new CardButton(tr("Do a lesson…"), tr("Predict, try, measure, and read why."), part);
  card->setObjectName("lessons");
  connect(card, &CardButton::clicked, this,
          [this, card] { emit lessons_wanted(card->mapToGlobal(card->rect().bottomLeft())); });
  column->addWidget(card);
  return part;
}

QWidget* StartPage::build_phantoms() {
  auto* part = new QWidget(content_);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  column->addWidget(label(tr("Try a phantom"), 1.3, true, part));
  column->addWidget(label(tr("Made here in a moment, with a known answer."), 1.0, false, part));
  phantom_grid_ = new QGridLayout;
  phantom_grid_->setSpacing(8);
  for (const std::string_view kind : imaging::phantom_kinds()) {
    const engine::PhantomText text = engine::phantom_text(kind);
    auto* card = new CardButton(text.title, text.sentence, part);
    const QString name = QString::fromUtf8(kind.data(), static_cast<qsizetype>(kind.size()));
    card->setObjectName(QStringLiteral("phantom_") + name);
    card->set_picture(QImage(QStringLiteral(":/tidemark/phantoms/%1.png").arg(name)));
    connect(card, &CardButton::clicked, this, [this, name] { emit phantom_chosen(name); });
    card->set_emphasised(kind == kFirstToTry);
    kind == kFirstToTry ? phantoms_.prepend(card) : phantoms_.append(card);
  }
  place_phantoms(true);
  column->addLayout(phantom_grid_);
  column->addStretch(1);
  return part;
}

void StartPage::fill_recent() {
  clear(*recent_list_);
  if (recent_.list().isEmpty()) {
    recent_list_->addWidget(
        label(tr("The studies that you open will be listed here."), 1.0, false, content_));
  }
  for (const RecentStudy& study : recent_.list().mid(0, kMostRecent)) {
    const QString name = study.missing ? tr("%1 (not found)").arg(study.name) : study.name;
    auto* card = new CardButton(name, study.path, content_);
    card->set_one_line(true);
    card->set_picture(RecentStudies::picture_of(study));
    card->setEnabled(!study.missing);
    connect(card, &CardButton::clicked, this, [this, study] { emit recent_chosen(study); });
    recent_list_->addWidget(card);
  }
}

void StartPage::showEvent(QShowEvent* event) {
  recent_.check();
  QWidget::showEvent(event);
}

// The first has a row of its own, and so has a last one without a neighbour.
void StartPage::place_phantoms(bool in_pairs) {
  const auto count = static_cast<int>(phantoms_.size());
  for (int i = 0; i < count; ++i) {
    const int place = i == 0 ? 0 : i + 1;
    const bool is_alone = !in_pairs || i == 0 || (i == count - 1 && place % 2 == 0);
    phantom_grid_->removeWidget(phantoms_[i]);
    phantom_grid_->addWidget(phantoms_[i], in_pairs ? place / 2 : i, is_alone ? 0 : place % 2, 1,
                             is_alone ? 2 : 1);
  }
}

void StartPage::arrange() {
  const QMargins margins = content_->layout()->contentsMargins();
  const int room =
      std::min(width() - style()->pixelMetric(QStyle::PM_ScrollBarExtent) - 2 * kFrame, kContentWidth) -
      margins.left() - margins.right();
  int card = 0;
  for (const CardButton* phantom : phantoms_) card = std::max(card, phantom->minimumSizeHint().width());
  const int pair = 2 * card + phantom_grid_->spacing();
  const int beside = opening_->minimumSizeHint().width() + columns_->spacing() + pair;
  const bool side_by_side = width() >= kTwoColumns && room >= beside;
  columns_->setDirection(side_by_side ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
  place_phantoms(room >= pair);
}

void StartPage::resizeEvent(QResizeEvent* event) {
  arrange();
  QWidget::resizeEvent(event);
}

// Queued, because the cards get a new font after it. Under a style sheet no other event says so.
void StartPage::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::StyleChange)
    QMetaObject::invokeMethod(this, &StartPage::arrange, Qt::QueuedConnection);
}

void StartPage::dragEnterEvent(QDragEnterEvent* event) {
  if (dropped_paths(*event->mimeData()).isEmpty()) return;
  event->acceptProposedAction();
  is_dragged_over_ = true;
  update();
}

void StartPage::dragLeaveEvent(QDragLeaveEvent* event) {
  is_dragged_over_ = false;
  update();
  QWidget::dragLeaveEvent(event);
}

void StartPage::dropEvent(QDropEvent* event) {
  is_dragged_over_ = false;
  update();
  event->acceptProposedAction();
  emit dropped(dropped_paths(*event->mimeData()));
}

void StartPage::paintEvent(QPaintEvent* event) {
  QWidget::paintEvent(event);
  if (!is_dragged_over_) return;
  QPainter painter(this);
  painter.setPen(QPen(palette().color(QPalette::Highlight), 3.0, Qt::DashLine));
  painter.drawRect(QRectF(rect()).adjusted(1.5, 1.5, -1.5, -1.5));
}

}  // namespace tidemark::ui
