#include "ui/opening/preview_page.h"

#include <QPainter>

#include "ui/opening/study_opener.h"

namespace tidemark::ui {

PreviewPage::PreviewPage(QStackedWidget& pages, const StudyOpener& opener) : pages_(pages) {
  setAccessibleName(tr("Middle slice of the study that is being opened"));
  pages_.addWidget(this);
  connect(&opener, &StudyOpener::previewed, this, &PreviewPage::show_picture);
  connect(&opener, &StudyOpener::began, this, &PreviewPage::forget);  // that was another study's
  connect(&opener, &StudyOpener::ended, this, &PreviewPage::forget);
}

void PreviewPage::forget() {
  if (pages_.currentWidget() == this) pages_.setCurrentIndex(0);
  picture_ = {};
}

void PreviewPage::show_picture(const QImage& middle_slice) {
  if (pages_.currentIndex() == 0) pages_.setCurrentWidget(this);
  picture_ = middle_slice;
  update();
}

void PreviewPage::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Qt::black);
  if (picture_.isNull()) return;
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  QRect place(QPoint(), picture_.size().scaled(size(), Qt::KeepAspectRatio));
  place.moveCenter(rect().center());
  painter.drawImage(place, picture_);
  painter.setPen(Qt::lightGray);
  painter.drawText(rect().adjusted(12, 12, -12, -12), Qt::AlignBottom | Qt::AlignHCenter,
                   tr("Middle slice. The study is being loaded."));
  emit painted();
}

}  // namespace tidemark::ui
