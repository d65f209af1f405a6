// The slim bar over a view: its name, the controls that steer the level set, and the window's buttons.
#pragma once

#include <QLabel>
#include <QToolButton>
#include <QWidget>

#include "engine/case_proxy.h"
#include "ui/widgets/number_box.h"

namespace tidemark::ui {

class ViewBar : public QWidget {
  Q_OBJECT
 public:
  // `tools`: the actions of the menu of tools.
  ViewBar(engine::CaseProxy& proxy, const QString& title, const QList<QAction*>& tools,
          QWidget* parent = nullptr);

  // What the view's picture is to show, behind its name.
  void add_choice(QWidget* choice);

  [[nodiscard]] QSize minimumSizeHint() const override;

 signals:
  void maximise_wanted();
  void float_wanted();
  void close_wanted();

 protected:
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  QToolButton* add_button(const char* picture, const QString& text);
  NumberBox* add_number(double solver::Parameters::*parameter, const QString& label, const QString& name,
                        const QString& tip);
  void follow_state();
  void follow_evolution();
  void show_what_fits();
  [[nodiscard]] QList<QWidget*> lasting() const;
  [[nodiscard]] int room_for(const QList<QWidget*>& parts) const;
  void follow_tool();
  void change(double solver::Parameters::*parameter, double value);

  engine::CaseProxy& proxy_;
  QLabel* title_;
  QToolButton* play_;  // of this case, whichever one is active
  QToolButton* step_;
  QToolButton* tool_;
  QList<QAction*> tools_;
  // What goes first when the bar is narrow, what next, and so on.
  QList<QWidget*> numbers_;
  QList<QWidget*> other_buttons_;  // the last one first
  QList<QWidget*> lasting_;        // never
  NumberBox* target_;
  NumberBox* range_;
};

}  // namespace tidemark::ui
