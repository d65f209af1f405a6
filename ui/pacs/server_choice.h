// The choice of a server, with a way to name others.
#pragma once

#include <QComboBox>
#include <QWidget>
#include <filesystem>

#include "imaging/pacs/configuration.h"

namespace tidemark::ui {

class ServerChoice : public QWidget {
  Q_OBJECT
 public:
  // `file` is that of the servers; `tip` is on the purpose of the chosen one.
  ServerChoice(std::filesystem::path file, const QString& tip, QWidget* parent = nullptr);

  [[nodiscard]] const imaging::PacsServer* server() const;  // null: there is none
  [[nodiscard]] const imaging::PacsLimits& limits() const { return configuration_.limits; }
  [[nodiscard]] const QString& problem() const { return problem_; }  // why there is none
  // Fails (ErrorKind::usage) where none has that name.
  Status choose(const QString& name);
  // The next dialog offers the same server.
  void remember() const;

 signals:
  void chosen();  // another server
  void edited();  // the file of servers was read again

 private:
  void read();
  void edit();
  void read_again();

  std::filesystem::path file_;
  imaging::PacsConfiguration configuration_;
  QString problem_;
  QComboBox* server_;
};

}  // namespace tidemark::ui
