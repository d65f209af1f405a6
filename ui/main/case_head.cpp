#include "ui/main/case_head.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/main/case_window.h"
#include "ui/widgets/elided_label.h"

namespace tidemark::ui {
namespace {

constexpr int kStripe = 2;  // pixels below the line, in the case's colour

QPixmap drawn_mark(int number, int side) {
  QPixmap pixmap(side, side);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor colour = case_colour(number);
  painter.setPen(Qt::NoPen);
  painter.setBrush(colour);
  painter.drawRoundedRect(pixmap.rect(), side / 5.0, side / 5.0);
  QFont font = painter.font();
  font.setBold(true);
  font.setPixelSize(number < 10 ? 3 * side / 4 : side / 2);
  painter.setFont(font);
  painter.setPen(qGray(colour.rgb()) > 140 ? Qt::black : Qt::white);
  painter.drawText(pixmap.rect(), Qt::AlignCenter, QString::number(number));
  return pixmap;
}

// "Name · ID · series", without unknown and hidden parts.
QString head_text(engine::CaseProxy& proxy) {
  QStringList parts;
  if (proxy.display().settings().patient_text) {
    const imaging::Patient& patient = proxy.study().patient;
    for (const std::string& part : {patient.name, patient.id}) {
      if (!part.empty()) parts << QString::fromStdString(part);
    }
  }
  parts << proxy.name();
  return parts.join(QStringLiteral(" \u00b7 "));
}

}  // namespace

QIcon case_mark(int number) {
  QIcon icon;
  for (const int side : {16, 20, 32, 48}) icon.addPixmap(drawn_mark(number, side));
  return icon;
}

CaseHead::CaseHead(QWidget* parent)
    : QWidget(parent),
      mark_(new QLabel),
      text_(new ElidedLabel({})),
      difference_(new QLabel),
      chain_(new QLabel) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(kSpace, kSpaceTight, kSpace, kSpaceTight + kStripe);
  row->setSpacing(kSpace);
  row->addWidget(mark_);
  row->addWidget(text_, 1);
  row->addWidget(difference_);
  row->addWidget(chain_);
  QFont bold = difference_->font();
  bold.setBold(true);
  difference_->setFont(bold);
  difference_->setToolTip(tr("The parameters in which the linked cases differ"));
  difference_->setAccessibleName(tr("Difference"));
  chain_->setToolTip(tr("Linked with other cases: crosshair, slices and camera move together"));
  chain_->setAccessibleName(tr("Linked"));
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  refresh();
}

void CaseHead::set_case(CaseWindow* window) {
  if (window_) {
    window_->disconnect(this);
    window_->proxy().display().disconnect(this);
  }
  window_ = window;
  if (window_) {
    connect(window_, &CaseWindow::mark_changed, this, &CaseHead::refresh);
    connect(window_, &QWidget::windowTitleChanged, this, &CaseHead::refresh_text);
    connect(&window_->proxy().display(), &engine::Display::changed, this, &CaseHead::refresh_text);
  }
  refresh();
}

QString CaseHead::text() const {
  return text_->text();
}

void CaseHead::refresh() {
  setVisible(!window_.isNull());
  if (!window_) return;
  mark_->setPixmap(case_mark(window_->number()).pixmap(QSize(kIconSmall, kIconSmall), devicePixelRatioF()));
  mark_->setAccessibleName(tr("Case %1").arg(window_->number()));
  refresh_text();
  chain_->setPixmap(icon(u"link").pixmap(QSize(kIconSmall, kIconSmall), devicePixelRatioF()));
  chain_->setVisible(window_->linked());
  difference_->setText(window_->difference());
  difference_->setVisible(!window_->difference().isEmpty());
  update();
}

// With each move of the mouse: it is cheap where nothing has changed.
void CaseHead::refresh_text() {
  const QString text = head_text(window_->proxy());
  if (text != text_->text()) text_->setText(text);
}

void CaseHead::paintEvent(QPaintEvent* /*event*/) {
  if (!window_) return;
  QPainter painter(this);
  painter.fillRect(QRect(0, height() - kStripe, width(), kStripe), case_colour(window_->number()));
}

}  // namespace tidemark::ui
