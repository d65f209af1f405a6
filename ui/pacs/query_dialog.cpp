#include "ui/pacs/query_dialog.h"

#include <QBoxLayout>
#include <QDateTime>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QSettings>
#include <QStandardPaths>
#include <cmath>
#include <utility>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/pacs/query_form.h"
#include "ui/pacs/servers_dialog.h"
#include "ui/pacs/study_tree.h"

namespace tidemark {
namespace {

constexpr int kSteps = 1000;  // of the bar

QString usual_folder() {
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  return QSettings().value("pacs/folder", documents + "/Tidemark").toString();
}

}  // namespace

QueryDialog::QueryDialog(std::filesystem::path servers, QWidget* parent)
    : QDialog(parent),
      file_(std::move(servers)),
      server_(new QComboBox(this)),
      form_(new QueryForm(this)),
      search_(new QPushButton(tr("&Search"), this)),
      tree_(new StudyTree(this)),
      said_(new QLabel(this)),
      bar_(new QProgressBar(this)),
      cancel_(new QPushButton(tr("Cancel"), this)),
      folder_(new QLineEdit(this)),
      open_(new QPushButton(tr("&Open"), this)) {
  setWindowTitle(tr("Query a server"));
  auto* column = new QVBoxLayout(this);
  column->addWidget(make_top());
  column->addWidget(form_);
  column->addWidget(tree_, 1);
  column->addWidget(make_bottom());
  connect(search_, &QPushButton::clicked, this, &QueryDialog::search);
  connect(form_, &QueryForm::submitted, this, &QueryDialog::search);
  connect(open_, &QPushButton::clicked, this, &QueryDialog::open);
  connect(tree_, &StudyTree::opened, this, &QueryDialog::open);
  connect(tree_, &StudyTree::choice_changed, this, &QueryDialog::follow);
  connect(tree_, &StudyTree::series_wanted, this, [this](const QString& study_uid) {
    // Unfolding must not end a retrieval.
    if (client_.busy() && asked_study_.isEmpty()) return tree_->forget_question(study_uid);
    if (server() == nullptr) return;
    if (!asked_study_.isEmpty()) tree_->forget_question(asked_study_);
    asked_study_ = study_uid;
    work(tr("Asking for the series"));
    client_.find_series(*server(), {study_uid.toStdString(), {}, {}}, configuration_.limits);
  });
  connect_client();
  read_servers();
  rest({});
  resize(980, 620);
}

void QueryDialog::connect_client() {
  connect(cancel_, &QPushButton::clicked, &client_, &PacsClient::cancel);
  connect(&client_, &PacsClient::progressed, this, [this](double fraction, const QString& step) {
    said_->setText(step);
    bar_->setRange(0, fraction < 0.0 ? 0 : kSteps);
    bar_->setValue(static_cast<int>(std::lround(fraction * kSteps)));
  });
  connect(&client_, &PacsClient::failed, this, &QueryDialog::rest);
  connect(&client_, &PacsClient::cancelled, this, [this] { rest(tr("Cancelled.")); });
  connect(&client_, &PacsClient::studies_found, this, [this](const auto& found) {
    tree_->show_studies(*found);
    const auto count = found->entries.size();
    rest(found->more  ? tr("The server has more than these %1 studies: ask for less.").arg(count)
         : count == 1 ? tr("1 study.")
                      : tr("%1 studies.").arg(count));
  });
  connect(&client_, &PacsClient::series_found, this, [this](const QString& study_uid, const auto& found) {
    asked_study_.clear();
    tree_->show_series(study_uid, *found);
    const auto count = found->entries.size();
    rest(count == 1 ? tr("1 series.") : tr("%1 series.").arg(count));
  });
  connect(&client_, &PacsClient::retrieved, this, [this](const QString& folder, const auto& what) {
    rest(tr("%1 objects came.").arg(what->files.size()));
    const auto lost = what->missing + static_cast<std::int64_t>(what->refused.size());
    if (lost > 0)
      emit told(tr("The series is not complete: %1 objects did not come or were not usable.").arg(lost));
    emit retrieved(folder);
  });
}

QWidget* QueryDialog::make_top() {
  auto* top = new QWidget(this);
  auto* row = new QHBoxLayout(top);
  row->setContentsMargins(0, 0, 0, 0);
  auto* label = new QLabel(tr("Ser&ver"), top);
  label->setBuddy(server_);
  server_->setAccessibleName(tr("Server"));
  server_->setToolTip(tr("The server that is asked"));
  server_->setMinimumContentsLength(20);
  auto* edit = new QPushButton(icon(u"settings"), tr("Se&rvers…"), top);
  edit->setToolTip(tr("Add, change and remove servers"));
  connect(edit, &QPushButton::clicked, this, &QueryDialog::edit_servers);
  row->addWidget(label);
  row->addWidget(server_);
  row->addWidget(edit);
  row->addStretch(1);
  search_->setDefault(true);
  search_->setToolTip(tr("Asks the server for studies that fit all that is entered"));
  row->addWidget(search_);
  return top;
}

QWidget* QueryDialog::make_bottom() {
  auto* bottom = new QWidget(this);
  auto* column = new QVBoxLayout(bottom);
  column->setContentsMargins(0, 0, 0, 0);
  auto* state = new QHBoxLayout;
  said_->setTextFormat(Qt::PlainText);
  said_->setWordWrap(true);
  said_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  bar_->setTextVisible(false);
  bar_->setAccessibleName(tr("Progress"));
  bar_->setFixedWidth(160);
  cancel_->setAutoDefault(false);
  cancel_->setToolTip(tr("Gives it up"));
  state->addWidget(said_, 1);
  state->addWidget(bar_);
  state->addWidget(cancel_);
  auto* where = new QHBoxLayout;
  auto* label = new QLabel(tr("&Keep in"), bottom);
  label->setBuddy(folder_);
  folder_->setAccessibleName(tr("Folder for what comes"));
  folder_->setToolTip(tr("Each series that is opened gets a folder of its own in this one"));
  folder_->setText(usual_folder());
  auto* choose = new QPushButton(icon(u"open-folder"), tr("&Choose…"), bottom);
  choose->setAutoDefault(false);
  choose->setToolTip(tr("Choose the folder"));
  connect(choose, &QPushButton::clicked, this, &QueryDialog::choose_folder);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, bottom);
  buttons->addButton(open_, QDialogButtonBox::ActionRole);
  open_->setAutoDefault(false);
  open_->setToolTip(tr("Brings the chosen series, or all series of the chosen study, and opens it"));
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  where->addWidget(label);
  where->addWidget(folder_, 1);
  where->addWidget(choose);
  where->addSpacing(2 * kSpace);
  where->addWidget(buttons);
  column->addLayout(state);
  column->addLayout(where);
  return bottom;
}

void QueryDialog::set_folder(const QString& folder) {
  folder_->setText(folder);
}

void QueryDialog::read_servers() {
  const QString before = server_->currentText();
  auto read = read_pacs_configuration(file_);
  std::error_code error;
  if (read) {
    configuration_ = std::move(*read);
  } else {
    configuration_ = {};
    // Whoever has named no server yet has done nothing wrong.
    const bool exists = std::filesystem::exists(file_, error);
    said_->setText(exists ? QString::fromStdString(read.error().message)
                          : tr("There is no server yet: name one with “Servers…”."));
  }
  server_->clear();
  for (const PacsServer& one : configuration_.servers) server_->addItem(QString::fromStdString(one.name));
  const QString wanted = before.isEmpty() ? QSettings().value("pacs/server").toString() : before;
  server_->setCurrentIndex(std::max(server_->findText(wanted), server_->count() > 0 ? 0 : -1));
  follow();
}

void QueryDialog::edit_servers() {
  ServersDialog dialog(file_, this);
  if (dialog.exec() == QDialog::Accepted) read_servers();
}

const PacsServer* QueryDialog::server() const {
  const int index = server_->currentIndex();
  return index < 0 ? nullptr : &configuration_.servers[static_cast<std::size_t>(index)];
}

void QueryDialog::search() {
  if (server() == nullptr) return;
  QSettings().setValue("pacs/server", server_->currentText());
  tree_->clear();
  work(tr("Asking the server"));
  client_.find_studies(*server(), form_->query(), configuration_.limits);
}

void QueryDialog::open() {
  const auto chosen = tree_->chosen();
  if (!chosen || server() == nullptr || client_.busy()) return;
  QSettings().setValue("pacs/folder", folder_->text());
  // Named by the time, not by anything that says whose it is.
  const QString name = QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd hh-mm-ss-zzz"));
  const RetrieveRequest request{chosen->study_uid.toStdString(), chosen->series_uid.toStdString(),
                                QDir(folder_->text()).filePath(name).toStdString()};
  work(tr("Calling the server"));
  client_.retrieve(*server(), request, configuration_.limits);
}

void QueryDialog::choose_folder() {
  const QString folder =
      QFileDialog::getExistingDirectory(this, tr("A folder for what comes"), folder_->text());
  if (!folder.isEmpty()) folder_->setText(folder);
}

void QueryDialog::work(const QString& what) {
  said_->setText(what);
  bar_->setRange(0, 0);
  bar_->show();
  cancel_->show();
  search_->setEnabled(false);
  open_->setEnabled(false);
}

void QueryDialog::rest(const QString& said) {
  if (!asked_study_.isEmpty()) tree_->forget_question(std::exchange(asked_study_, {}));
  if (!said.isEmpty()) said_->setText(said);
  bar_->hide();
  cancel_->hide();
  follow();
}

void QueryDialog::follow() {
  search_->setEnabled(server() != nullptr && !client_.busy());
  open_->setEnabled(server() != nullptr && !client_.busy() && tree_->chosen().has_value());
}

void QueryDialog::reject() {
  client_.cancel();
  QDialog::reject();
}

}  // namespace tidemark
