// The dialog that asks a PACS for studies and brings a series from it.
#pragma once

#include <QDialog>
#include <QLineEdit>
#include <QPushButton>
#include <filesystem>

#include "engine/pacs_client.h"

namespace tidemark::ui {

class QueryForm;
class ServerChoice;
class StudyTree;
class WorkLine;

// Not modal: the series that it brought can be looked at beside it.
class QueryDialog : public QDialog {
  Q_OBJECT
 public:
  // `servers` is the file of servers.
  explicit QueryDialog(std::filesystem::path servers, QWidget* parent = nullptr);

  // The folder for what is retrieved; each retrieval makes a new folder in it. Where the site has locked it,
  // the site's counts.
  void set_folder(const QString& folder);
  // Asks that server, or the chosen one where the name is empty, as if the user had entered the query.
  // Nothing is brought before the user wants it. Fails (ErrorKind::usage) where there is no such server, or
  // while one is being asked.
  Status ask(const QString& server, const imaging::StudyQuery& query);

 signals:
  void retrieved(const QString& folder);
  void told(const QString& message);  // about objects that did not arrive

 protected:
  void reject() override;  // gives up what runs

 private:
  void connect_client();
  QWidget* make_top();
  QWidget* make_bottom();
  void search(const imaging::StudyQuery& query);
  void retrieve();
  void choose_folder();
  void begin(const QString& what);  // until rest()
  void rest(const QString& said);
  void follow();

  engine::PacsClient client_;
  QString asked_study_;  // whose series are awaited
  ServerChoice* servers_;
  QueryForm* form_;
  QPushButton* search_;
  StudyTree* tree_;
  WorkLine* work_;
  QLineEdit* folder_;
  QPushButton* open_;
};

}  // namespace tidemark::ui
