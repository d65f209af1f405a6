#include "ui/pacs/servers_dialog.h"

#include <QBoxLayout>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QToolButton>
#include <cmath>
#include <set>

#include "engine/message_text.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/path_line.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {
namespace {

NumberBox* whole_number(int low, int high) {
  auto* box = new NumberBox;
  box->setDecimals(0);
  box->setRange(low, high);
  return box;
}

int entered(const NumberBox& box) {
  return static_cast<int>(std::lround(box.value()));
}

std::string entered(const QLineEdit& line) {
  return line.text().trimmed().toStdString();
}

QLineEdit* add_line(Form& form, const QString& label, const QString& tip) {
  auto* line = new QLineEdit;
  form.row(label, line, tip);
  return line;
}

NumberBox* add_count(Form& form, const QString& label, int low, int high, const QString& tip) {
  auto* count = whole_number(low, high);
  form.row(label, count, tip);
  return count;
}

}  // namespace

ServersDialog::ServersDialog(std::filesystem::path file, QWidget* parent)
    : QDialog(parent), file_(std::move(file)), list_(new QListWidget(this)), said_(new QLabel(this)) {
  setWindowTitle(tr("Servers"));
  auto* columns = new QHBoxLayout;
  columns->addWidget(make_list());
  columns->addWidget(make_entry(), 1);
  said_->setWordWrap(true);
  said_->setTextFormat(Qt::PlainText);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel, this);
  test_ = buttons->addButton(tr("&Test"), QDialogButtonBox::ActionRole);
  test_->setToolTip(tr("Asks the server whether it answers"));
  test_->setAutoDefault(false);
  connect(test_, &QPushButton::clicked, this, &ServersDialog::test);
  connect(buttons, &QDialogButtonBox::accepted, this, &ServersDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* whole = new QVBoxLayout(this);
  whole->addLayout(columns, 1);
  whole->addWidget(said_);
  whole->addWidget(buttons);

  connect(&client_, &engine::PacsClient::answered, this, [this](double seconds) {
    say(tr("The server answers in %1 ms.").arg(number_text(seconds * 1000.0, 1)));
  });
  connect(&client_, &engine::PacsClient::failed, this, &ServersDialog::say);
  // What is saved is the user's own.
  const auto first_file = imaging::pacs_configuration_to_read(file_);
  auto read = imaging::read_pacs_configuration(first_file);
  std::error_code error;
  if (read) {
    configuration_ = std::move(*read);
  } else if (std::filesystem::exists(first_file, error)) {
    say(engine::message_text(read.error()));
    // The user's own would be lost.
    const bool is_own = first_file == file_;
    QPushButton* save = buttons->button(QDialogButtonBox::Save);
    save->setEnabled(!is_own);
    if (is_own) save->setToolTip(tr("The file of servers cannot be read: repair it, or move it away"));
  }
  for (const imaging::PacsServer& server : configuration_.servers)
    list_->addItem(QString::fromStdString(server.name));
  connect(list_, &QListWidget::currentRowChanged, this, &ServersDialog::show_entry);
  connect(name_, &QLineEdit::textChanged, this, [this](const QString& text) {
    if (list_->currentItem() != nullptr) list_->currentItem()->setText(text);
  });
  list_->setCurrentRow(list_->count() > 0 ? 0 : -1);
  if (configuration_.locked) {
    lock(*buttons->button(QDialogButtonBox::Save));
  } else if (list_->count() == 0) {
    add();
  }
  resize(680, 520);
}

QWidget* ServersDialog::make_list() {
  auto* left = new QWidget(this);
  auto* column = new QVBoxLayout(left);
  column->setContentsMargins(0, 0, 0, 0);
  list_->setAccessibleName(tr("Servers"));
  list_->setToolTip(tr("The servers there are: the chosen one is shown beside"));
  list_->setFixedWidth(170);
  auto* buttons = new QHBoxLayout;
  const auto button = [&](const char* name, const char* picture, const QString& text, auto method) {
    auto* one = new QToolButton(left);
    one->setObjectName(QString::fromLatin1(name));
    one->setIcon(icon(QString::fromLatin1(picture)));
    one->setToolTip(text);
    one->setAccessibleName(text);
    connect(one, &QToolButton::clicked, this, method);
    buttons->addWidget(one);
  };
  button("add-server", "add", tr("Add a server"), &ServersDialog::add);
  button("remove-server", "remove", tr("Remove the server"), &ServersDialog::remove);
  buttons->addStretch(1);
  column->addWidget(list_, 1);
  column->addLayout(buttons);
  return left;
}

QWidget* ServersDialog::make_entry() {
  entry_ = new QWidget(this);
  Form form(entry_);
  rows_ = form.layout();
  name_ = add_line(form, tr("Name"), tr("By which you choose it"));
  protocol_ = form.choice(tr("Protocol"), tr("What the server speaks"));
  protocol_->addItem(tr("DICOM"));
  protocol_->addItem(tr("DICOMweb"));
  add_web_rows(form);
  add_dicom_rows(form);
  timeout_ = add_count(form, tr("Patience"), 1, 3600, tr("Seconds that it may take to answer"));
  timeout_->setSuffix(tr(" s"));
  form.wide(make_tls());
  connect(protocol_, &QComboBox::currentIndexChanged, this, &ServersDialog::show_protocol);
  show_protocol();
  return entry_;
}

void ServersDialog::add_web_rows(Form& form) {
  url_ = add_line(form, tr("Address"), tr("Of the service: https://pacs.example/dicom-web"));
  user_ = add_line(form, tr("User"), tr("Whose password the secret is; empty: it is a token"));
  secret_ =
      file_line(tr("Secret"), tr("A file with the password or the token in its only line; may be empty"),
                tr("All files (*)"), form);
}

void ServersDialog::add_dicom_rows(Form& form) {
  host_ = add_line(form, tr("Host"), tr("Its name in the network, or its IPv4 address"));
  port_ = add_count(form, tr("Port"), 1, 65535, tr("104 and 11112 are usual, 2762 with TLS"));
  ae_title_ = add_line(form, tr("AE title"), tr("The server's title, at most 16 characters"));
  own_ae_title_ = add_line(form, tr("Our AE title"), tr("Under which the server knows this workstation"));
  for (QLineEdit* title : {ae_title_, own_ae_title_}) title->setMaxLength(16);
  retrieve_ = form.choice(tr("Series come"), tr("How the server sends the series"));
  retrieve_->addItem(tr("on our connection (C-GET)"));
  retrieve_->addItem(tr("by calls from the server (C-MOVE)"));
  move_port_ =
      add_count(form, tr("Port for calls"), 1, 65535,
                tr("Where the server calls this machine; it must know our AE title, host and this port"));
  connect(retrieve_, &QComboBox::currentIndexChanged, move_port_,
          [this](int way) { move_port_->setEnabled(way == 1); });
}

void ServersDialog::show_protocol() {
  const bool is_web = protocol_->currentIndex() == 1;
  // Lines of files stand in a row with their button.
  for (QWidget* widget : std::initializer_list<QWidget*>{url_, user_, secret_->parentWidget()}) {
    show_row(*rows_, widget, is_web);
  }
  for (QWidget* widget :
       std::initializer_list<QWidget*>{host_, port_, ae_title_, own_ae_title_, retrieve_, move_port_}) {
    show_row(*rows_, widget, !is_web);
  }
  tls_->setTitle(is_web ? tr("Certificates other than the system's") : tr("Encrypted (TLS)"));
}

QWidget* ServersDialog::make_tls() {
  tls_ = new QGroupBox;
  tls_->setCheckable(true);
  Form form(tls_);
  form.layout()->setContentsMargins(kSpace, kSpace, kSpace, kSpace);
  const QString pem = tr("PEM (*.pem *.crt *.cer *.key);;All files (*)");
  ca_ = file_line(
      tr("Authority"),
      tr("PEM file of the authority behind the server's certificate; empty: the system's authorities"), pem,
      form);
  certificate_ = file_line(tr("Certificate"), tr("Ours, for servers that want one; may be empty"), pem, form);
  key_ = file_line(tr("Private key"), tr("Of our certificate"), pem, form);
  verify_ = form.check(tr("Verify the server's certificate"),
                       tr("Without it the connection is encrypted, but the server may be anyone"));
  return tls_;
}

QLineEdit* ServersDialog::file_line(const QString& label, const QString& tip, const QString& kinds,
                                    Form& form) {
  auto* choose = new QToolButton;
  choose->setIcon(icon(u"open-file"));
  choose->setToolTip(tr("Choose a file"));
  choose->setAccessibleName(tr("Choose a file: %1").arg(label));
  QLineEdit* line = add_path_line(form, label, tip, choose);
  connect(choose, &QToolButton::clicked, this, [this, line, kinds] {
    auto* dialog = new QFileDialog(this, tr("Choose a file"), line->text(), kinds);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, line, &QLineEdit::setText);
    dialog->open();
  });
  return line;
}

void ServersDialog::show_entry(int row) {
  keep_entry();
  shown_ = row;
  entry_->setEnabled(row >= 0 && !configuration_.locked);
  test_->setEnabled(row >= 0);
  if (row < 0) return;
  const imaging::PacsServer& server = configuration_.servers[static_cast<std::size_t>(row)];
  const auto text = [](const auto& value) { return QString::fromStdString(std::string(value)); };
  name_->setText(text(server.name));
  protocol_->setCurrentIndex(server.web ? 1 : 0);
  const imaging::WebAccess web = server.web.value_or(imaging::WebAccess{});
  url_->setText(text(web.url));
  user_->setText(text(web.user));
  secret_->setText(text_of(web.secret));
  host_->setText(text(server.host));
  port_->show_value(server.port);
  ae_title_->setText(text(server.ae_title));
  own_ae_title_->setText(text(server.own_ae_title));
  const bool by_move = server.retrieve == imaging::PacsServer::Retrieve::move;
  retrieve_->setCurrentIndex(by_move ? 1 : 0);
  move_port_->show_value(server.move_port);
  move_port_->setEnabled(by_move);
  timeout_->show_value(server.timeout_seconds);
  const imaging::TlsFiles tls = server.tls.value_or(imaging::TlsFiles{});
  tls_->setChecked(server.tls.has_value());
  ca_->setText(text(tls.ca.string()));
  certificate_->setText(text(tls.certificate.string()));
  key_->setText(text(tls.key.string()));
  verify_->setChecked(tls.verify);
}

void ServersDialog::keep_entry() {
  if (shown_ < 0 || shown_ >= static_cast<int>(configuration_.servers.size())) return;
  imaging::PacsServer& server = configuration_.servers[static_cast<std::size_t>(shown_)];
  server.name = entered(*name_);
  server.web.reset();
  if (protocol_->currentIndex() == 1) {
    server.web = imaging::WebAccess{entered(*url_), entered(*user_), path_of(secret_->text().trimmed())};
  }
  server.host = entered(*host_);
  server.port = entered(*port_);
  server.ae_title = entered(*ae_title_);
  server.own_ae_title = entered(*own_ae_title_);
  server.retrieve = retrieve_->currentIndex() == 1 ? imaging::PacsServer::Retrieve::move
                                                   : imaging::PacsServer::Retrieve::get;
  server.move_port = entered(*move_port_);
  server.timeout_seconds = entered(*timeout_);
  server.tls.reset();
  if (tls_->isChecked()) {
    server.tls =
        imaging::TlsFiles{entered(*ca_), entered(*certificate_), entered(*key_), verify_->isChecked()};
  }
}

void ServersDialog::add() {
  keep_entry();
  imaging::PacsServer server;
  server.name = tr("New server").toStdString();
  configuration_.servers.push_back(server);
  list_->addItem(QString::fromStdString(server.name));
  list_->setCurrentRow(list_->count() - 1);
  name_->setFocus();
  name_->selectAll();
}

void ServersDialog::remove() {
  const int row = list_->currentRow();
  if (row < 0) return;
  shown_ = -1;  // the entered text goes with it
  configuration_.servers.erase(configuration_.servers.begin() + row);
  {
    // On its way the list names rows that are no longer what they were.
    const QSignalBlocker quiet(list_);
    delete list_->takeItem(row);
  }
  show_entry(list_->currentRow());
}

// They can be looked at and tested.
void ServersDialog::lock(QPushButton& save) {
  const QString why = tr("The administrator of this machine has fixed the servers.");
  save.setEnabled(false);
  save.setToolTip(why);
  for (const char* name : {"add-server", "remove-server"}) findChild<QToolButton*>(name)->setEnabled(false);
  say(why);
}

void ServersDialog::test() {
  keep_entry();
  if (shown_ < 0) return;
  say(tr("Calling the server"));
  client_.echo(configuration_.servers[static_cast<std::size_t>(shown_)]);
}

void ServersDialog::say(const QString& message) {
  said_->setText(message);
}

void ServersDialog::accept() {
  for (const NumberBox* box : {port_, move_port_, timeout_}) {
    if (!box->problem().isEmpty()) return say(box->problem());
  }
  keep_entry();
  std::set<std::string> names;
  for (std::size_t row = 0; row < configuration_.servers.size(); ++row) {
    const imaging::PacsServer& server = configuration_.servers[row];
    const Status good = imaging::check_pacs_server(server);
    if (good && names.insert(server.name).second) continue;
    list_->setCurrentRow(static_cast<int>(row));
    return say(good ? tr("Two servers are called %1.").arg(QString::fromStdString(server.name))
                    : engine::message_text(good.error()));
  }
  if (const Status written = imaging::write_pacs_configuration(configuration_, file_); !written) {
    return say(engine::message_text(written.error()));
  }
  QDialog::accept();
}

}  // namespace tidemark::ui
