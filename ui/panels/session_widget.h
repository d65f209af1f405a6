// What all parts of the panels have in common: they show one case, the active one.
#pragma once

#include <QPointer>
#include <QWidget>
#include <utility>

#include "session/case_session.h"

namespace tidemark {

class SessionWidget : public QWidget {
  Q_OBJECT
 public:
  explicit SessionWidget(QWidget* parent = nullptr) : QWidget(parent) {}

  // Null: none is open. A session that dies is forgotten.
  void set_session(CaseSession* session);
  [[nodiscard]] CaseSession* session() const { return session_; }

 protected:
  // Another session, or none any more; refresh() follows.
  virtual void attach() {}
  // Something has changed. Called only with a session, and while nobody looks only when it is shown again.
  virtual void refresh() = 0;
  void showEvent(QShowEvent* event) override;

  // change_display([&](DisplaySettings& settings) { settings.window = window; });
  template <class Change>
  void change_display(Change&& apply) {
    if (session_) session_->display().change(std::forward<Change>(apply));
  }

 private:
  void follow();
  void forget();
  QPointer<CaseSession> session_;
};

}  // namespace tidemark
