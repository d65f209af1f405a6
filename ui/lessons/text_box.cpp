#include "ui/lessons/text_box.h"

#include <QSignalBlocker>
#include <QVBoxLayout>
#include <cmath>

#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {
namespace {

constexpr int kMostDecimals = 9;

// The digits behind the point that a value has, as far as they are shown.
int decimals_of(double value, int least) {
  for (int decimals = least; decimals < kMostDecimals; ++decimals) {
    if (std::abs(rounded(value, decimals) - value) <= 1e-12 * std::abs(value)) return decimals;
  }
  return kMostDecimals;
}

}  // namespace

QPlainTextEdit* make_text_box(int lines) {
  auto* box = new QPlainTextEdit;
  box->setTabChangesFocus(true);
  const double frame = 2.0 * (box->document()->documentMargin() + box->frameWidth());
  box->setFixedHeight(lines * box->fontMetrics().lineSpacing() + static_cast<int>(std::ceil(frame)));
  return box;
}

void show_text(QPlainTextEdit& box, const std::string& text) {
  const QString shown = QString::fromStdString(text);
  if (box.toPlainText() == shown) return;
  const QSignalBlocker quiet(&box);
  box.setPlainText(shown);
}

void show_text(QLineEdit& line, const std::string& text) {
  const QString shown = QString::fromStdString(text);
  if (line.text() == shown) return;
  const QSignalBlocker quiet(&line);
  line.setText(shown);
}

QWidget* make_content(QGroupBox& group) {
  group.setCheckable(true);
  auto* column = new QVBoxLayout(&group);
  column->setContentsMargins(0, kSpace, 0, 0);
  auto* content = new QWidget;
  column->addWidget(content);
  QObject::connect(&group, &QGroupBox::toggled, content, &QWidget::setVisible);
  return content;
}

NumberBox* make_number_box(double low, double high, int decimals) {
  auto* box = new NumberBox;
  box->setDecimals(decimals);
  box->setRange(low, high);
  box->setAlignment(Qt::AlignRight);
  guard_wheel(box);
  return box;
}

void show_number(NumberBox& box, double value, int decimals) {
  const QSignalBlocker quiet(&box);
  box.setDecimals(decimals_of(value, decimals));
  box.show_value(value);
}

}  // namespace tidemark::ui
