// The choice of a lesson's study: a phantom with its noise, or what lies beside the lesson's file.
#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QRadioButton>
#include <QToolButton>
#include <QWidget>
#include <filesystem>

#include "document/lesson.h"
#include "ui/widgets/number_box.h"

namespace tidemark::ui {

class StudyChoice : public QWidget {
  Q_OBJECT
 public:
  explicit StudyChoice(QWidget* parent = nullptr);

  // `study` is changed by the user, and must outlive the showing. `folder` is that of the lesson's file;
  // empty: it is in none yet.
  void show_study(document::LessonStudy* study, const std::filesystem::path& folder);

 signals:
  void edited();
  void phantom_chosen();  // another kind, by the user; after edited()

 private:
  QWidget* make_phantom();
  QWidget* make_file();
  void keep();
  void choose(bool folder);
  void enable();

  document::LessonStudy* study_ = nullptr;
  std::filesystem::path folder_;
  QRadioButton* by_phantom_;
  QComboBox* kind_;
  QCheckBox* has_noise_;
  NumberBox* noise_;
  QRadioButton* by_file_;
  QLineEdit* file_;
  QToolButton* choose_file_;
  QToolButton* choose_folder_;
};

}  // namespace tidemark::ui
