// The shape of a panel: headings, and rows with a label on the left.
#pragma once

#include <QFormLayout>
#include <QString>

class QCheckBox;
class QComboBox;
class QLabel;
class QToolButton;

namespace tidemark::ui {

class SliderNumber;

// Builds the rows of one part of a panel.
class Form {
 public:
  explicit Form(QWidget* on);

  QLabel* heading(const QString& text);
  // The label's text is the widget's accessible name.
  void row(const QString& label, QWidget* widget, const QString& tip);
  void wide(QWidget* widget);
  void wide(QLayout* layout);
  // Words of explanation across the panel.
  QLabel* note(const QString& text);
  // A number to be read, at the right.
  QLabel* figure(const QString& label, const QString& tip);
  SliderNumber* slider(const QString& label, const QString& tip);
  // Words below the ends of the slider that was added last.
  void ends_of(const SliderNumber& slider, const QString& low, const QString& high);
  QCheckBox* check(const QString& text, const QString& tip);
  QComboBox* choice(const QString& label, const QString& tip);

  [[nodiscard]] QFormLayout* layout() const { return layout_; }

 private:
  QFormLayout* layout_;
};

// Shows or hides the row of a widget that was added to the form.
void show_row(QFormLayout& rows, QWidget* widget, bool shown);

// A label that wraps and whose text can be copied.
QLabel* make_note(const QString& text);

}  // namespace tidemark::ui
