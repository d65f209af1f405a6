// The dialog of all servers, for looking at and changing them.
#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QFormLayout>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <filesystem>

#include "engine/pacs_client.h"
#include "imaging/pacs/configuration.h"
#include "ui/widgets/number_box.h"

namespace tidemark::ui {

class Form;

class ServersDialog : public QDialog {
  Q_OBJECT
 public:
  // Reads the file of servers, and writes it when it is accepted.
  explicit ServersDialog(std::filesystem::path file, QWidget* parent = nullptr);

  void accept() override;  // only when every server makes sense, and the file can be written

 private:
  QWidget* make_list();
  QWidget* make_entry();
  void add_dicom_rows(Form& form);
  void add_web_rows(Form& form);
  void show_protocol();
  QWidget* make_tls();
  QLineEdit* file_line(const QString& label, const QString& tip, const QString& kinds, Form& form);
  void show_entry(int row);
  void keep_entry();  // the entered text becomes the shown server
  void add();
  void remove();
  void lock(QPushButton& save);
  void test();
  void say(const QString& message);

  std::filesystem::path file_;
  imaging::PacsConfiguration configuration_;
  engine::PacsClient client_;
  int shown_ = -1;
  QListWidget* list_;
  QWidget* entry_ = nullptr;
  QFormLayout* rows_ = nullptr;  // of the entry
  QLineEdit* name_;
  QComboBox* protocol_;
  QLineEdit* url_;
  QLineEdit* user_;
  QLineEdit* secret_;
  QLineEdit* host_;
  NumberBox* port_;
  QLineEdit* ae_title_;
  QLineEdit* own_ae_title_;
  QComboBox* retrieve_;
  NumberBox* move_port_;
  NumberBox* timeout_;
  QGroupBox* tls_;
  QLineEdit* ca_;
  QLineEdit* certificate_;
  QLineEdit* key_;
  QCheckBox* verify_;
  QPushButton* test_;
  QLabel* said_;
};

}  // namespace tidemark::ui
