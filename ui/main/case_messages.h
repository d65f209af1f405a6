// The messages of failures in a case, shown until something has succeeded in it.
#pragma once

#include <QObject>
#include <QString>

namespace tidemark {

class CaseWindow;
class MessageBar;

// Goes with the window.
class CaseMessages : public QObject {
  Q_OBJECT
 public:
  CaseMessages(CaseWindow& window, MessageBar& bar);

 private:
  // The state of the case's history, as text. An open entry shows in the undo text alone.
  [[nodiscard]] QString done() const;
  void tell_failure(const QString& message);
  void follow();

  CaseWindow& window_;
  MessageBar& bar_;
  QString done_at_failure_;
};

}  // namespace tidemark
