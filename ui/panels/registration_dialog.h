// The rigid registration of a further image: progress, a picture before and after, and the user's decision.
#pragma once

#include <QDialog>
#include <QPointer>

#include "engine/case_proxy.h"
#include "engine/registration_job.h"

class QLabel;
class QProgressBar;
class QPushButton;

namespace tidemark::ui {

class RegistrationPicture;

// Begins at once. Nothing of the case changes before the user accepts.
class RegistrationDialog : public QDialog {
  Q_OBJECT
 public:
  RegistrationDialog(engine::CaseProxy& proxy, engine::ShownImage image, QWidget* parent);

 private:
  void lay_out();
  void show_found(const imaging::Registration& found);
  void take();

  QPointer<engine::CaseProxy> proxy_;
  engine::ShownImage image_;
  glm::dmat4 found_{1.0};
  engine::RegistrationJob job_;
  RegistrationPicture* before_;
  RegistrationPicture* after_;
  QProgressBar* progress_;
  QLabel* text_;
  QPushButton* accept_;
};

}  // namespace tidemark::ui
