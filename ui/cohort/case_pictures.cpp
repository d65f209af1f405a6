#include "ui/cohort/case_pictures.h"

#include <QGuiApplication>
#include <QImage>

#include "engine/background_job.h"

namespace tidemark::ui {
namespace {

constexpr int kMostKept = 300;
constexpr int kMostWanted = 100;  // what has been scrolled past is wanted again when it is seen again
const QColor kEmpty(24, 26, 30);

}  // namespace

CasePictures::CasePictures() : none_(QSize(kWidth, kHeight)), pictures_(kMostKept) {
  none_.fill(kEmpty);
}

CasePictures::~CasePictures() {
  if (reading_) reading_->abandon();
}

QPixmap CasePictures::picture(const QString& file) {
  if (const QPixmap* picture = pictures_.object(file)) return *picture;
  wanted_.removeAll(file);
  wanted_ << file;
  if (wanted_.size() > kMostWanted) wanted_.removeFirst();
  if (!reading_) read_next();
  return none_;
}

void CasePictures::forget(const QString& file) {
  pictures_.remove(file);
}

void CasePictures::read_next() {
  reading_.reset();
  if (wanted_.isEmpty()) return;
  const QString file = wanted_.takeLast();
  const double scale = qGuiApp->devicePixelRatio();
  reading_ = engine::BackgroundJob::start(this, [this, file, scale](engine::BackgroundJob& job) {
    QImage image(file);
    if (!image.isNull()) {
      const QSize size = QSizeF(kWidth * scale, kHeight * scale).toSize();
      image = image.scaled(size, Qt::KeepAspectRatio, Qt::SmoothTransformation);
      image.setDevicePixelRatio(scale);
    }
    job.deliver([this, file, image] {
      pictures_.insert(file, new QPixmap(image.isNull() ? none_ : QPixmap::fromImage(image)));
      emit read(file);
      read_next();
    });
  });
}

}  // namespace tidemark::ui
