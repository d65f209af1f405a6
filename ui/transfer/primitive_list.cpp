#include "ui/transfer/primitive_list.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QPainter>
#include <QSignalBlocker>
#include <QVBoxLayout>

namespace tidemark::ui {
namespace {

constexpr int kSwatch = 16;

QPushButton* button(const QString& text, const QString& tip, const char* name, QVBoxLayout* column) {
  auto* made = new QPushButton(text);
  made->setToolTip(tip);
  made->setObjectName(QString::fromLatin1(name));
  column->addWidget(made);
  return made;
}

}  // namespace

PrimitiveList::PrimitiveList(const QString& when_empty, QWidget* parent)
    : QWidget(parent), list_(new QListWidget(this)), when_empty_(when_empty) {
  list_->setAccessibleName(tr("Primitives"));
  list_->setIconSize({kSwatch, kSwatch});
  list_->setTextElideMode(Qt::ElideRight);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->installEventFilter(this);
  list_->viewport()->installEventFilter(this);
  auto* column = new QVBoxLayout;
  column->setSpacing(4);
  add_gaussian_ =
      button(tr("Add Gaussian"), tr("Adds a primitive for values around a centre"), "add_gaussian", column);
  add_ramp_ = button(tr("Add ramp"), tr("Adds a primitive for values from a start on"), "add_ramp", column);
  duplicate_ = button(tr("Duplicate"), tr("Adds a copy of the chosen primitive"), "duplicate", column);
  remove_ = button(tr("Delete"), tr("Removes the chosen primitive (Delete)"), "delete", column);
  column->addStretch();
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(list_, 1);
  row->addLayout(column);
  // As high as the buttons beside it; longer lists scroll.
  list_->setFixedHeight(column->sizeHint().height());
  connect(list_, &QListWidget::currentRowChanged, this, [this](int index) {
    if (index >= 0) emit chosen(index);
  });
  connect(add_gaussian_, &QPushButton::clicked, this,
          [this] { emit add_asked(renderer::TransferFactor::Kind::gaussian); });
  connect(add_ramp_, &QPushButton::clicked, this,
          [this] { emit add_asked(renderer::TransferFactor::Kind::ramp); });
  connect(duplicate_, &QPushButton::clicked, this, &PrimitiveList::duplicate_asked);
  connect(remove_, &QPushButton::clicked, this, &PrimitiveList::delete_asked);
}

void PrimitiveList::set_primitives(const std::vector<AxisPrimitive>& primitives,
                                   const std::vector<PrimitiveAxis>& axes, int chosen) {
  const QSignalBlocker quiet(list_);
  const int count = static_cast<int>(primitives.size());
  while (list_->count() > count) delete list_->takeItem(list_->count() - 1);
  while (list_->count() < count) list_->addItem(new QListWidgetItem);
  for (int i = 0; i < count; ++i) {
    const AxisPrimitive& primitive = primitives[static_cast<std::size_t>(i)];
    const QString text = describe(primitive, axes);
    QListWidgetItem& item = *list_->item(i);
    item.setText(QStringLiteral("%1  %2").arg(i + 1).arg(text));
    item.setToolTip(text);
    item.setIcon(colour_swatch(to_qcolor(primitive.colour), *this));
  }
  list_->setCurrentRow(chosen);
  const bool room = primitives.size() < renderer::TransferFunction::kMostPrimitives;
  for (QPushButton* adds : {add_gaussian_, add_ramp_}) adds->setEnabled(room);
  duplicate_->setEnabled(room && count > 0);
  remove_->setEnabled(count > 0);
  list_->viewport()->update();
}

bool PrimitiveList::eventFilter(QObject* watched, QEvent* event) {
  if (watched == list_ && event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if ((key == Qt::Key_Delete || key == Qt::Key_Backspace) && list_->count() > 0) {
      emit delete_asked();
      return true;
    }
  }
  if (watched == list_->viewport() && event->type() == QEvent::Paint && list_->count() == 0 && isEnabled()) {
    QPainter painter(list_->viewport());
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(list_->viewport()->rect().adjusted(8, 4, -8, -4), Qt::AlignCenter | Qt::TextWordWrap,
                     when_empty_);
    return true;
  }
  return QWidget::eventFilter(watched, event);
}

QIcon colour_swatch(const QColor& colour, const QWidget& on) {
  const double ratio = on.devicePixelRatioF();
  QPixmap picture(QSize(kSwatch, kSwatch) * ratio);
  picture.setDevicePixelRatio(ratio);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(on.palette().color(QPalette::Text), 1.0));
  painter.setBrush(colour);
  painter.drawRoundedRect(QRectF(1.5, 1.5, kSwatch - 3.0, kSwatch - 3.0), 2.0, 2.0);
  QIcon icon(picture);
  icon.addPixmap(picture, QIcon::Selected);  // else the style would tint it
  return icon;
}

}  // namespace tidemark::ui
