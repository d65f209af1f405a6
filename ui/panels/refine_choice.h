// The choice to refine a mask: whether the surface that begins from it stays near, and how near.
#pragma once

#include <QWidget>
#include <optional>

class QCheckBox;

namespace tidemark::ui {

class Form;
class SliderNumber;

// Of a surface that begins from a mask.
class RefineChoice : public QWidget {
  Q_OBJECT
 public:
  explicit RefineChoice(QWidget* parent = nullptr);

  // Nothing: it may move anywhere.
  [[nodiscard]] std::optional<double> within_mm() const;

  // The number alone, wherever such a limit is asked for.
  static SliderNumber* add_number(Form& form);

 signals:
  void changed();

 private:
  QCheckBox* refine_;
  SliderNumber* within_;
};

}  // namespace tidemark::ui
