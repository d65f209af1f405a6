// The panel Cohort: the cases of a cohort, and what a person says of them.
#pragma once

#include <QWidget>
#include <string>

#include "document/cohort/decisions.h"

class QAction;
class QLabel;
class QLineEdit;
class QListView;
class QPushButton;

namespace tidemark::ui {

class CohortModel;
class WorkLine;

class CohortPanel : public QWidget {
  Q_OBJECT
 public:
  // The actions that its buttons carry out. The model must outlive it.
  struct Actions {
    QAction* previous;
    QAction* next;
    QAction* accept;
    QAction* reject;
  };
  CohortPanel(CohortModel& model, const Actions& actions, QWidget* parent = nullptr);
  ~CohortPanel() override;

  [[nodiscard]] int row() const;  // the chosen one; -1: none
  void choose(int row);
  // As it is typed now.
  [[nodiscard]] QString comment() const;
  void keep_comment();  // with commented(), where it is a new one
  [[nodiscard]] WorkLine& work() { return *work_; }
  // Of the open case: it was changed, and is a correction when it is accepted.
  void set_correction(bool correction);

 signals:
  void chosen(int row);
  void open_wanted(int row);
  void commented(int row, const QString& comment);
  void close_wanted();

 private:
  QPushButton* make_button(QAction* action);
  void show_row();

  CohortModel& model_;
  QLabel* summary_;
  QListView* list_;
  QLabel* details_;
  QLineEdit* comment_;
  QAction* accept_action_;
  QPushButton* accept_ = nullptr;
  WorkLine* work_;
  int shown_ = -1;  // the row whose comment is shown
};

}  // namespace tidemark::ui
