// A panel: the content of a dock.
#pragma once

#include <initializer_list>
#include <vector>

#include "ui/panels/case_widget.h"

class QLabel;
class QVBoxLayout;

namespace tidemark::ui {

// Parts below each other. Without a case they are grey, and a sentence says that a study is missing.
class Panel : public CaseWidget {
  Q_OBJECT
 public:
  // `hint`: "Open a study to ..."
  explicit Panel(const QString& hint, QWidget* parent = nullptr);

 protected:
  void add(QWidget* part);
  void add(CaseWidget* part);  // which gets the case, too
  void fill_height();          // the parts take all of it, and the first one what is over
  void attach() override;
  void refresh() override {}

 private:
  QLabel* hint_;
  QWidget* content_;
  QVBoxLayout* parts_;
  std::vector<CaseWidget*> proxy_parts_;
};

}  // namespace tidemark::ui
