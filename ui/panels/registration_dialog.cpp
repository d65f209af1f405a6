#include "ui/panels/registration_dialog.h"

#include <QBoxLayout>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <algorithm>
#include <array>
#include <functional>
#include <glm/geometric.hpp>

#include "ui/look/theme.h"
#include "ui/views/image_overlay.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr int kPreview = 200;  // logical pixels, wide and high
constexpr int kProgressSteps = 1000;

// The image where a transform puts it.
engine::ShownImage moved(engine::ShownImage shown, const glm::dmat4& to_case) {
  auto image = std::make_shared<document::CaseImage>(*shown.image);
  image->to_case = to_case;
  shown.image = std::move(image);
  return shown;
}

}  // namespace

// Axial, coronal and sagittal slices through the crosshair: the study in grey, the image over it.
class RegistrationPicture : public QWidget {
 public:
  RegistrationPicture(engine::CaseProxy& proxy, QWidget* parent)
      : QWidget(parent), cursor_mm_(proxy.display().settings().cursor_mm) {
    auto study = std::make_shared<document::CaseImage>();
    study->volume = proxy.study().volume;
    study_ = {study, true, engine::ImageColours::grey, 1.0, proxy.display().settings().window, false};
    setFixedSize(3 * kPreview + 2 * kSpaceTight, kPreview);
  }
  // Calls `when_seen` once all three slices can be seen with the image.
  void set_image(engine::ShownImage image, const std::function<void()>& when_seen = {}) {
    image.visible = true;
    for (std::size_t plane = 0; plane < kPlanes.size(); ++plane) {
      connect(&overlays_[plane], &ImageOverlay::arrived, this, [this, when_seen] {
        update();
        if (when_seen &&
            std::ranges::all_of(overlays_, [](const auto& one) { return one.newest().has_value(); }))
          when_seen();
      });
      renderer::SliceView view;
      view.orientation = kPlanes[plane];
      view.position_mm = cursor_mm_;
      constexpr QSize kSize(kPreview, kPreview);
      const SliceScreen screen(view, QSizeF(kSize), study_.image->volume->geometry);
      overlays_[plane].ask({study_, image}, view, screen, kSize);
    }
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    int left = 0;
    for (const ImageOverlay& overlay : overlays_) {
      const QRect where(left, 0, kPreview, kPreview);
      left += kPreview + kSpaceTight;
      painter.fillRect(where, Qt::black);
      if (const auto& drawn = overlay.newest()) painter.drawImage(where, drawn->picture);
    }
  }

 private:
  static constexpr std::array kPlanes{renderer::kAxial, renderer::kCoronal, renderer::kSagittal};

  glm::dvec3 cursor_mm_;
  engine::ShownImage study_;
  std::array<ImageOverlay, 3> overlays_;
};

RegistrationDialog::RegistrationDialog(engine::CaseProxy& proxy, engine::ShownImage image, QWidget* parent)
    : QDialog(parent),
      proxy_(&proxy),
      image_(std::move(image)),
      before_(new RegistrationPicture(proxy, this)),
      after_(new RegistrationPicture(proxy, this)),
      progress_(new QProgressBar(this)),
      text_(make_note({})),
      accept_(new QPushButton(tr("&Accept"), this)) {
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("Register %1").arg(QString::fromStdString(image_.image->name)));
  lay_out();
  before_->set_image(image_);
  after_->hide();
  accept_->setEnabled(false);
  progress_->setRange(0, kProgressSteps);
  progress_->setAccessibleName(tr("Progress of the registration"));
  text_->setMinimumHeight(2 * fontMetrics().lineSpacing());
  text_->setText(tr("Looking for the turn and shift at which the images tell most of each other."));
  connect(accept_, &QPushButton::clicked, this, &RegistrationDialog::take);
  connect(&job_, &engine::RegistrationJob::progressed, this, [this](double fraction, const QString&) {
    progress_->setValue(static_cast<int>(std::max(fraction, 0.0) * kProgressSteps));
  });
  connect(&job_, &engine::RegistrationJob::registered, this, &RegistrationDialog::show_found);
  connect(&job_, &engine::RegistrationJob::failed, this, [this](const QString& message) {
    progress_->hide();
    text_->setText(message);
  });
  connect(&proxy, &QObject::destroyed, this, &QDialog::reject);
  job_.start(image_.image, proxy.study().volume);
}

void RegistrationDialog::lay_out() {
  auto* pictures = new QGridLayout;
  pictures->addWidget(new QLabel(tr("Now")), 0, 0);
  pictures->addWidget(before_, 0, 1);
  pictures->addWidget(new QLabel(tr("Registered")), 1, 0);
  auto* place = new QWidget;  // keeps its room while there is no picture
  place->setFixedSize(before_->size());
  after_->setParent(place);
  pictures->addWidget(place, 1, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  buttons->addButton(accept_, QDialogButtonBox::AcceptRole);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addLayout(pictures);
  column->addWidget(progress_);
  column->addWidget(text_);
  column->addWidget(buttons);
}

void RegistrationDialog::show_found(const imaging::Registration& found) {
  found_ = found.to_fixed;
  progress_->hide();
  after_->set_image(moved(image_, found_), [this] {
    accept_->setEnabled(true);
    accept_->setFocus();
  });
  after_->show();
  const QString turn = number_text(found.rotation_degrees, 1);
  const QString shift = number_text(glm::length(found.translation_mm), 1);
  const QString after = number_text(found.information_after, 3);
  text_->setText(
      found.information_before
          ? tr("Turned by %1°, its middle shifted by %2 mm; mutual information %3, before %4. Compare the "
               "pictures before you accept.")
                .arg(turn, shift, after, number_text(*found.information_before, 3))
          : tr("Turned by %1°, its middle shifted by %2 mm; mutual information %3. The images lay apart: the "
               "search began with their middles on one another. Compare the pictures before you accept.")
                .arg(turn, shift, after));
}

// The image may have been taken out of the case meanwhile.
void RegistrationDialog::take() {
  if (proxy_) {
    proxy_->display().change([&](engine::DisplaySettings& settings) {
      for (engine::ShownImage& shown : settings.images) {
        if (shown.image == image_.image) shown = moved(shown, found_);
      }
    });
  }
  QDialog::accept();
}

}  // namespace tidemark::ui
