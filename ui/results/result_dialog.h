// The common base of the dialogs that make results for other systems.
#pragma once

#include <QDialog>
#include <QPushButton>
#include <functional>
#include <memory>

#include "ui/main/case_window.h"
#include "ui/results/result_choice.h"
#include "ui/widgets/work_line.h"

namespace tidemark::ui {

// Not modal: the user can go on with the case while its result is made, which shows the case at the click. It
// closes with the case.
class ResultDialog : public QDialog {
  Q_OBJECT
 public:
  ResultDialog(CaseWindow& window, const QString& title);

 protected:
  using Snapshot = std::shared_ptr<const engine::CaseProxy::Snapshot>;

  // From the constructor: whether there is something to choose, where it goes, what that means, the button.
  void build(bool with_choice, QWidget* target, const QString& note, const QString& verb, const QString& tip);
  // Whether all that is needed is filled in.
  [[nodiscard]] virtual bool ready() const { return true; }
  // Asked at the click: calls `go_on` where it may go on, perhaps later.
  virtual void confirm(std::function<void()> go_on) { go_on(); }
  virtual void begin(const Snapshot& snapshot) = 0;
  virtual void give_up() = 0;

  void follow();
  void rest(const QString& said);
  void reject() override;
  [[nodiscard]] engine::CaseProxy& proxy() const { return window_.proxy(); }
  [[nodiscard]] document::ResultContent content() const { return choice_->content(); }
  [[nodiscard]] WorkLine& work() const { return *work_; }

 private:
  void start();
  void take_case();

  CaseWindow& window_;
  ResultChoice* choice_;
  QWidget* target_ = nullptr;
  WorkLine* work_;
  QPushButton* go_;
  bool with_choice_ = true;
  bool busy_ = false;
  bool waiting_ = false;  // for the snapshot
};

// The patient and study to which a DICOM result will belong, in words.
[[nodiscard]] QString source_note(const engine::LoadedStudy& study);

}  // namespace tidemark::ui
