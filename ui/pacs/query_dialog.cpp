#include "ui/pacs/query_dialog.h"

#include <QBoxLayout>
#include <QDateTime>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QLabel>
#include <QStandardPaths>
#include <utility>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/pacs/query_form.h"
#include "ui/pacs/server_choice.h"
#include "ui/pacs/study_tree.h"
#include "ui/settings.h"
#include "ui/widgets/work_line.h"

namespace tidemark::ui {

QueryDialog::QueryDialog(std::filesystem::path servers, QWidget* parent)
    : QDialog(parent),
      servers_(new ServerChoice(std::move(servers), tr("The server that is asked"), this)),
      form_(new QueryForm(this)),
      search_(new QPushButton(tr("&Search"), this)),
      tree_(new StudyTree(this)),
      work_(new WorkLine(this)),
      folder_(new QLineEdit(this)),
      open_(new QPushButton(tr("&Open"), this)) {
  setWindowTitle(tr("Query a server"));
  auto* column = new QVBoxLayout(this);
  column->addWidget(make_top());
  column->addWidget(form_);
  column->addWidget(tree_, 1);
  column->addWidget(make_bottom());
  const auto search_for_entered = [this] { search(form_->query()); };
  connect(search_, &QPushButton::clicked, this, search_for_entered);
  connect(form_, &QueryForm::submitted, this, search_for_entered);
  connect(open_, &QPushButton::clicked, this, &QueryDialog::retrieve);
  connect(tree_, &StudyTree::opened, this, &QueryDialog::retrieve);
  connect(tree_, &StudyTree::choice_changed, this, &QueryDialog::follow);
  connect(tree_, &StudyTree::series_wanted, this, [this](const QString& study_uid) {
    // Unfolding must not end a retrieval.
    if (client_.busy() && asked_study_.isEmpty()) return tree_->forget_question(study_uid);
    if (servers_->server() == nullptr) return;
    if (!asked_study_.isEmpty()) tree_->forget_question(asked_study_);
    asked_study_ = study_uid;
    begin(tr("Asking for the series"));
    client_.find_series(*servers_->server(), {study_uid.toStdString(), {}, {}}, servers_->limits());
  });
  connect_client();
  rest(servers_->problem());
  resize(980, 620);
}

void QueryDialog::connect_client() {
  connect(work_, &WorkLine::cancelled, &client_, &engine::PacsClient::cancel);
  connect(&client_, &engine::PacsClient::progressed, work_, &WorkLine::set_progress);
  connect(&client_, &engine::PacsClient::failed, this, &QueryDialog::rest);
  connect(&client_, &engine::PacsClient::cancelled, this, [this] { rest(tr("Cancelled.")); });
  connect(&client_, &engine::PacsClient::studies_found, this, [this](const auto& found) {
    tree_->show_studies(*found);
    const int count = static_cast<int>(found->entries.size());
    rest(found->more ? tr("The server has more than these %n studies: ask for less.", nullptr, count)
                     : tr("%n studies.", nullptr, count));
  });
  connect(&client_, &engine::PacsClient::series_found, this,
          [this](const QString& study_uid, const auto& found) {
            asked_study_.clear();
            tree_->show_series(study_uid, *found);
            rest(tr("%n series.", nullptr, static_cast<int>(found->entries.size())));
          });
  connect(&client_, &engine::PacsClient::retrieved, this, [this](const QString& folder, const auto& what) {
    rest(tr("%n objects came.", nullptr, static_cast<int>(what->files.size())));
    const auto lost = what->missing + static_cast<std::int64_t>(what->refused.size());
    if (lost > 0) {
      emit told(tr("The series is not complete: %n objects did not come, or are not usable.", nullptr,
                   static_cast<int>(lost)));
    }
    emit retrieved(folder);
  });
}

QWidget* QueryDialog::make_top() {
  auto* top = new QWidget(this);
  auto* row = new QHBoxLayout(top);
  row->setContentsMargins(0, 0, 0, 0);
  auto* label = new QLabel(tr("Ser&ver"), top);
  label->setBuddy(servers_);
  connect(servers_, &ServerChoice::chosen, this, [this] {
    tree_->clear();  // another server knows nothing of them
    follow();
  });
  connect(servers_, &ServerChoice::edited, this, [this] { rest(servers_->problem()); });
  row->addWidget(label);
  row->addWidget(servers_);
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
  auto* where = new QHBoxLayout;
  auto* label = new QLabel(tr("&Keep in"), bottom);
  label->setBuddy(folder_);
  folder_->setAccessibleName(tr("Folder for what comes"));
  folder_->setToolTip(tr("Each series that is opened gets a folder of its own in this one"));
  folder_->setText(settings::retrieval_folder().get());
  auto* choose = new QPushButton(icon(u"open-folder"), tr("&Choose…"), bottom);
  choose->setAutoDefault(false);
  choose->setToolTip(tr("Choose the folder"));
  connect(choose, &QPushButton::clicked, this, &QueryDialog::choose_folder);
  if (is_locked(settings::retrieval_folder().name())) {
    for (QWidget* part : {static_cast<QWidget*>(folder_), static_cast<QWidget*>(choose)}) {
      part->setEnabled(false);
      part->setToolTip(tr("The site has chosen this folder"));
    }
  }
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
  column->addWidget(work_);
  column->addLayout(where);
  return bottom;
}

void QueryDialog::set_folder(const QString& folder) {
  folder_->setText(folder);
}

Status QueryDialog::ask(const QString& server, const imaging::StudyQuery& query) {
  if (client_.busy())
    return fail(ErrorKind::usage, "a server is being asked: open the link again when it has answered");
  if (!server.isEmpty()) TIDEMARK_TRY(servers_->choose(server));
  form_->show_query(query);
  search(query);
  return {};
}

void QueryDialog::search(const imaging::StudyQuery& query) {
  if (servers_->server() == nullptr || client_.busy()) return;
  servers_->remember();
  tree_->clear();
  begin(tr("Asking the server"));
  client_.find_studies(*servers_->server(), query, servers_->limits());
}

void QueryDialog::retrieve() {
  const auto chosen = tree_->chosen();
  if (!chosen || servers_->server() == nullptr || client_.busy()) return;
  settings::retrieval_folder().set(folder_->text());
  const QDir folder(settings::retrieval_folder().get());  // the site's where it is locked
  // Named by the time, not by anything that says whose it is.
  const QString name = QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd hh-mm-ss-zzz"));
  const imaging::RetrieveRequest request{chosen->study_uid.toStdString(), chosen->series_uid.toStdString(),
                                         folder.filePath(name).toStdString()};
  begin(tr("Calling the server"));
  client_.retrieve(*servers_->server(), request, servers_->limits());
}

void QueryDialog::choose_folder() {
  const QString folder =
      QFileDialog::getExistingDirectory(this, tr("A folder for what comes"), folder_->text());
  if (!folder.isEmpty()) folder_->setText(folder);
}

void QueryDialog::begin(const QString& what) {
  work_->begin(what);
  servers_->setEnabled(false);
  search_->setEnabled(false);
  open_->setEnabled(false);
}

void QueryDialog::rest(const QString& said) {
  if (!asked_study_.isEmpty()) tree_->forget_question(std::exchange(asked_study_, {}));
  work_->end(said);
  follow();
}

void QueryDialog::follow() {
  const bool can_ask = servers_->server() != nullptr && !client_.busy();
  servers_->setEnabled(!client_.busy());
  search_->setEnabled(can_ask);
  open_->setEnabled(can_ask && tree_->chosen().has_value());
}

void QueryDialog::reject() {
  client_.cancel();
  QDialog::reject();
}

}  // namespace tidemark::ui
