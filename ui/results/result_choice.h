// The choice of segments that go into a result.
#pragma once

#include <QGroupBox>
#include <QRadioButton>

#include "document/result_files.h"
#include "engine/case_state.h"

namespace tidemark::ui {

class ResultChoice : public QGroupBox {
  Q_OBJECT
 public:
  explicit ResultChoice(QWidget* parent = nullptr);

  // Sets the choices; the chosen one stays if it is among them.
  void show_state(const engine::CaseState& state);
  [[nodiscard]] bool has_choice() const;
  [[nodiscard]] document::ResultContent content() const;

 private:
  QRadioButton* add(const QString& tip);
  // Whether there is such a choice, also while the widget is disabled.
  [[nodiscard]] bool is_there(const QRadioButton* button) const { return button->isEnabledTo(this); }

  QRadioButton* all_;
  QRadioButton* visible_;
  QRadioButton* surface_;
};

}  // namespace tidemark::ui
