// The controls of further images of a case: which are seen, in what colours, how opaque and in which window.
#pragma once

#include "ui/panels/case_widget.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QListWidget;
class QToolButton;

namespace tidemark::ui {

class Form;
class SliderNumber;

// Hidden while there are none.
class ImageControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit ImageControls(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void add_list(Form& form);
  void add_numbers(Form& form);
  void show_chosen();
  void fill_list();
  // Changes the image that is chosen in the list.
  template <class Change>
  void change_chosen(Change&& apply);
  [[nodiscard]] const engine::ShownImage* chosen() const;

  QWidget* content_;
  QListWidget* list_;
  QLabel* place_;
  QCheckBox* used_;
  QCheckBox* swipe_;
  QComboBox* colours_;
  SliderNumber* opacity_;
  SliderNumber* width_;
  SliderNumber* level_;
  QToolButton* register_;
  QToolButton* remove_;
  std::shared_ptr<const document::CaseImage> ranged_;  // the image that the sliders' ranges suit
};

}  // namespace tidemark::ui
