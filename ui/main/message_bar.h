// Sentences above the cases that stay until they are dismissed, or until their subject has succeeded.
#pragma once

#include <QFrame>
#include <QMetaObject>
#include <functional>

class QLabel;
class QPushButton;
class QStackedLayout;

namespace tidemark::ui {

class CaseWindow;

inline constexpr const char* kAboutOpening = "opening";  // of studies and sessions

class MessageBar : public QFrame {
  Q_OBJECT
 public:
  explicit MessageBar(QWidget* parent = nullptr);

  // `about`: the subject that failed, for settle(); empty: the message stays until it is dismissed.
  void show_text(const QString& text, const QString& about = {});
  // The same with a button that does something about it; the message goes then.
  void show_offer(const QString& text, const QString& about, const QString& button,
                  std::function<void()> accepted);
  // The message that is shown is of that case: it bears the case's mark and goes with the case.
  void mark_as_of(CaseWindow& window);
  // The subject has succeeded: removes the message of its failure.
  void settle(const QString& about);
  // Takes the widget over, until it is dismissed or another message comes.
  void show_widget(QWidget* widget);
  void dismiss();
  [[nodiscard]] QString text() const;

 private:
  void forget_case();

  QLabel* mark_;  // of the case that the message is of
  QMetaObject::Connection case_closed_;
  QWidget* line_;
  QLabel* text_;
  QPushButton* offer_;
  std::function<void()> accepted_;
  QWidget* shown_ = nullptr;
  QString about_;
};

}  // namespace tidemark::ui
