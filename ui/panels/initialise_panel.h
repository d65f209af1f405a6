// How the level set begins.
#pragma once

#include <vector>

#include "ui/panels/panel.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace tidemark {

class StartPage;

class InitialisePanel : public Panel {
  Q_OBJECT
 public:
  explicit InitialisePanel(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void add_pages();
  void add_start();
  void show_page(int index);
  void show_sentence();

  std::vector<StartPage*> pages_;
  int page_ = 0;
  QComboBox* from_;
  QLabel* sentence_;
  QLabel* replaces_;
  QLabel* problem_;
  QPushButton* start_;
};

}  // namespace tidemark
