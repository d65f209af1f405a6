// The synthetic studies, as a menu.
#pragma once

#include <QMenu>
#include <QString>
#include <string_view>

namespace tidemark {

// How a kind of phantom_kinds() is called and what it shows, in one sentence.
struct PhantomText {
  QString title;
  QString sentence;
};
PhantomText phantom_text(std::string_view kind);

// One action a kind.
class PhantomMenu : public QMenu {
  Q_OBJECT
 public:
  explicit PhantomMenu(QWidget* parent = nullptr);

 signals:
  void chosen(const QString& kind);
};

}  // namespace tidemark
