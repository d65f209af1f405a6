// The messages of a case: failures, until something has succeeded in it, and a surface that ended badly.
#pragma once

#include <QObject>
#include <QString>
#include <optional>

#include "document/outcome.h"

namespace tidemark::ui {

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
  void tell_outcome();
  void widen(double range);

  CaseWindow& window_;
  MessageBar& bar_;
  QString done_at_failure_;
  document::Outcome told_ = document::Outcome::unfinished;
  std::optional<double> offered_;
};

}  // namespace tidemark::ui
