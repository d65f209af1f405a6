// The choice of a server of the site, of one of its models, and of one of the model's labels.
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "imaging/ai/ai_services.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace tidemark::ui {

class ModelChoice : public QWidget {
  Q_OBJECT
 public:
  explicit ModelChoice(QWidget* parent = nullptr);

  // Reads ai.json again where there is one; false: there is none, and nothing to choose from.
  bool read();
  [[nodiscard]] const QString& problem() const { return problem_; }  // why there is no server

  [[nodiscard]] const imaging::AiServer* server() const;  // null: there is none
  // "https://ai.example:8000, encrypted by TLS"
  [[nodiscard]] QString where() const;
  void set_models(std::shared_ptr<const std::vector<imaging::AiModel>> models);
  [[nodiscard]] const imaging::AiModel* model() const;  // null: none is listed
  [[nodiscard]] std::string label() const;              // empty: all of them
  [[nodiscard]] int number() const;                     // of that label; 0: all

 signals:
  void list_wanted();
  void changed();

 private:
  void show_server();
  void show_model();

  std::vector<imaging::AiServer> servers_;
  std::shared_ptr<const std::vector<imaging::AiModel>> models_;
  QString problem_;
  QComboBox* server_;
  QLabel* where_;
  QComboBox* model_;
  QPushButton* list_;
  QComboBox* label_;
};

}  // namespace tidemark::ui
