// The choice of what a speed map shows: the speed, or how sure the speed function is of it.
#pragma once

#include <QWidget>

#include "engine/case_proxy.h"

class QToolButton;

namespace tidemark::ui {

// Hidden where there is no choice: only a speed function that learns from examples has a doubt.
class SpeedMapChoice : public QWidget {
  Q_OBJECT
 public:
  SpeedMapChoice(engine::CaseProxy& proxy, QWidget* parent);

 private:
  QToolButton* add(const QString& text);
  void choose(renderer::SpeedTerm term);
  void follow();

  engine::CaseProxy& proxy_;
  QToolButton* speed_;
  QToolButton* doubt_;
};

}  // namespace tidemark::ui
