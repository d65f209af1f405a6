// The byte of a page's message, bit by bit (paper, figure 8, step C).
#pragma once

#include <QWidget>
#include <optional>

#include "solver/stream/page_message.h"

namespace tidemark::ui {

class MessageBits : public QWidget {
  Q_OBJECT
 public:
  explicit MessageBits(QWidget* parent = nullptr);

  void show_message(std::optional<solver::PageMessage> message);
  [[nodiscard]] std::optional<solver::PageMessage> message() const { return message_; }

  [[nodiscard]] QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::optional<solver::PageMessage> message_;
};

// "+x"
QString face_name(int face);

}  // namespace tidemark::ui
