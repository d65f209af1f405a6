// Sentences above the cases that stay until they are dismissed, or until their subject has succeeded.
#pragma once

#include <QFrame>
#include <QMetaObject>
#include <functional>
#include <vector>

class QHBoxLayout;
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

  // The text is plain, and screen readers say it at once. `about`: the subject that failed, for
  // dismiss_about(); empty: the message stays until it is dismissed.
  void show_text(const QString& text, const QString& about = {});
  // The same with buttons that do something about it; the message goes then.
  struct Offer {
    QString button;
    QString tip;
    std::function<void()> accepted;
  };
  void show_offers(const QString& text, const QString& about, const std::vector<Offer>& offers);
  // The message that is shown is of that case: it bears the case's mark and goes with the case.
  void mark_as_of(CaseWindow& window);
  // The subject has succeeded: removes the message of its failure.
  void dismiss_about(const QString& about);
  // Takes the widget over, until it is dismissed or another message comes.
  void show_widget(QWidget* widget);
  void dismiss();
  [[nodiscard]] QString text() const;

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void forget_case();
  void paint_sign();

  QLabel* mark_;  // of the case that the message is of
  QMetaObject::Connection case_closed_;
  QWidget* line_;
  QLabel* sign_;
  QLabel* text_;
  QPushButton* dismiss_;
  QHBoxLayout* offers_;
  QWidget* shown_ = nullptr;
  QString about_;
};

}  // namespace tidemark::ui
