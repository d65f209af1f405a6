#include "ui/passes/message_bits.h"

#include <QPainter>
#include <QStringList>

#include "solver/paging/page_neighbours.h"
#include "ui/look/pass_colours.h"
#include "ui/look/theme.h"

namespace tidemark::ui {
namespace {

constexpr int kBits = 8;

}  // namespace

QString face_name(int face) {
  static const char* const kNames[solver::kFaces] = {"−x", "+x", "−y", "+y", "−z", "+z"};
  return QString::fromUtf8(kNames[face]);
}

MessageBits::MessageBits(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(tr("Message"));
  setToolTip(
      tr("The first six bits: some voxel on that face differs from its neighbour across it. Mixed: not all "
         "voxels are the same one of W and −W. The last bit says of a mixed page that it moved since the "
         "window of steps began, and of another one that it is inside."));
}

void MessageBits::show_message(std::optional<solver::PageMessage> message) {
  message_ = message;
  setAccessibleDescription(message ? QString::number(message->code) : QString());
  update();
}

QSize MessageBits::sizeHint() const {
  return {260, 2 * fontMetrics().height() + 3 * kSpaceTight};
}

void MessageBits::paintEvent(QPaintEvent* /*event*/) {
  if (!message_) return;
  QPainter painter(this);
  QStringList names;
  for (int face = 0; face < solver::kFaces; ++face) names << face_name(face);
  names << tr("mixed") << (message_->is_mixed() ? tr("moved") : tr("inside"));
  const int line = fontMetrics().height();
  const QColor text = palette().color(QPalette::WindowText);
  for (int bit = 0; bit < kBits; ++bit) {
    // The words need more room than the faces.
    const double unit = width() / 10.0;
    const double left = bit < 6 ? unit * bit : unit * (6 + 2 * (bit - 6));
    const QRectF column(left, 0.0, bit < 6 ? unit : 2.0 * unit, height());
    const bool set = (message_->code >> bit & 1) != 0;
    const QRectF box(column.x() + 1.5, 0.5, column.width() - 3.0, line + kSpaceTight);
    painter.setPen(palette().color(QPalette::Mid));
    painter.setBrush(set ? QBrush(kPositiveColour) : palette().brush(QPalette::Base));
    painter.drawRect(box);
    painter.setPen(set ? QColor(Qt::black) : text);
    painter.drawText(box, Qt::AlignCenter, set ? QStringLiteral("1") : QStringLiteral("0"));
    painter.setPen(text);
    painter.drawText(column.adjusted(0.0, box.height() + kSpaceTight, 0.0, 0.0),
                     Qt::AlignHCenter | Qt::AlignTop, names[bit]);
  }
}

}  // namespace tidemark::ui
