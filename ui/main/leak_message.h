// The message of a leak: where it is, and what can be done about it.
#pragma once

#include <QObject>
#include <memory>

namespace tidemark::engine {
struct LeakAlarm;
}

namespace tidemark::ui {

class CaseWindow;
class MessageBar;

// Goes with the window.
class LeakMessage : public QObject {
  Q_OBJECT
 public:
  LeakMessage(CaseWindow& window, MessageBar& bar);

 private:
  void follow();
  void show();
  [[nodiscard]] QString about() const;
  // Each goes back to before the leak first; the last two then play on.
  void go_back();
  void wall_off();
  void lower_alpha(double alpha);

  CaseWindow& window_;
  MessageBar& bar_;
  std::shared_ptr<const engine::LeakAlarm> told_;
};

}  // namespace tidemark::ui
