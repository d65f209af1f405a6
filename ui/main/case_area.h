// The open cases: side by side, or one at a time behind tabs.
#pragma once

#include <QMdiArea>

#include "ui/main/case_window.h"

namespace tidemark::ui {

class CaseArea : public QMdiArea {
  Q_OBJECT
 public:
  explicit CaseArea(QWidget* parent = nullptr);
  ~CaseArea() override;

  // The case is not seen yet: show_child() does that.
  QMdiSubWindow* add(CaseWindow* window);
  // One alone has all the room, more are laid side by side.
  void show_child(QMdiSubWindow& child);
  [[nodiscard]] QList<CaseWindow*> cases() const;
  // In whose window the widget lies, or whose title bar it is. Null: in none.
  [[nodiscard]] CaseWindow* case_of(const QWidget* widget) const;

  void tile();
  void cascade();
  void set_tabs(bool tabs);

 signals:
  void case_closed();

 protected:
  bool viewportEvent(QEvent* event) override;

 private:
  void fill();
  void follow_cover();  // one that is maximised lies over the others

  bool tiled_ = true;  // else as the user has laid them
};

}  // namespace tidemark::ui
