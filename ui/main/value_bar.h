// What is under the mouse: I, D, kappa, |grad phi|, phi and where that is.
#pragma once

#include <QLabel>
#include <QPointer>

#include "session/case_session.h"

namespace tidemark {

class ValueBar : public QLabel {
  Q_OBJECT
 public:
  explicit ValueBar(QWidget* parent = nullptr);
  void set_session(CaseSession* session);

 private:
  void follow();

  QPointer<CaseSession> session_;
};

}  // namespace tidemark
