// What is under the mouse: I, what D sees of it, D, kappa, |grad phi|, phi and where that is.
#pragma once

#include <QLabel>
#include <QPointer>

#include "engine/case_proxy.h"

namespace tidemark {

class ValueBar : public QLabel {
  Q_OBJECT
 public:
  explicit ValueBar(QWidget* parent = nullptr);
  void set_proxy(CaseProxy* proxy);

 private:
  void follow();

  QPointer<CaseProxy> proxy_;
};

}  // namespace tidemark
