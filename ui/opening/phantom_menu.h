// The synthetic studies, as a menu.
#pragma once

#include <QMenu>

#include "engine/phantom_text.h"

namespace tidemark::ui {

// One action a kind.
class PhantomMenu : public QMenu {
  Q_OBJECT
 public:
  explicit PhantomMenu(QWidget* parent = nullptr);

 signals:
  void chosen(const QString& kind);
};

}  // namespace tidemark::ui
