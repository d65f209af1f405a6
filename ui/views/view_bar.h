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
  // `evolution` and `tools`: the actions whose buttons stand here.
  ViewBar(engine::CaseProxy& proxy, const QString& title, const QList<QAction*>& evolution,
          const QList<QAction*>& tools, QWidget* parent = nullptr);

  [[nodiscard]] QSize minimumSizeHint() const override { return {60, sizeHint().height()}; }

 signals:
  void maximise_wanted();
  void float_wanted();
  void close_wanted();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QToolButton* add_button(const char* picture, const QString& text);
  NumberBox* add_number(double solver::Parameters::*parameter, const QString& label, const QString& name,
                        const QString& tip);
  void follow_state();
  void show_what_fits();
  void follow_tool();
  void change(double solver::Parameters::*parameter, double value);

  engine::CaseProxy& proxy_;
  QToolButton* tool_;
  QList<QAction*> tools_;
  QList<QWidget*> numbers_;    // hidden first when the bar is narrow
  QList<QWidget*> evolution_;  // and these next
  NumberBox* target_;
  NumberBox* range_;
};

}  // namespace tidemark::ui
