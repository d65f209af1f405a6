// What a case has to say above all: what has failed, until something else has succeeded in it, and how the
// surface has ended where that is not as it should be.
#pragma once

#include <QObject>
#include <QString>
#include <optional>

#include "document/outcome.h"

namespace tidemark {

class CaseWindow;
class MessageBar;

// Goes with the window.
class CaseMessages : public QObject {
  Q_OBJECT
 public:
  CaseMessages(CaseWindow& window, MessageBar& bar);

 private:
  // What the case has done, as text: an entry of the history that is still open counts only by its own.
  [[nodiscard]] QString done() const;
  void tell_failure(const QString& message);
  void follow();
  void tell_outcome();
  void widen(double range);

  CaseWindow& window_;
  MessageBar& bar_;
  QString done_at_failure_;
  Outcome told_ = Outcome::unfinished;
  std::optional<double> offered_;
};

}  // namespace tidemark
