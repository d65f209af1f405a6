#include "ui/pacs/server_choice.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QSignalBlocker>
#include <algorithm>
#include <optional>

#include "engine/message_text.h"
#include "ui/look/icons.h"
#include "ui/pacs/servers_dialog.h"
#include "ui/settings.h"

namespace tidemark::ui {
namespace {

constexpr int kLeastLetters = 20;

}  // namespace

ServerChoice::ServerChoice(std::filesystem::path file, const QString& tip, QWidget* parent)
    : QWidget(parent), file_(std::move(file)), server_(new QComboBox(this)) {
  server_->setAccessibleName(tr("Server"));
  server_->setToolTip(tip);
  server_->setMinimumContentsLength(kLeastLetters);
  auto* edit = new QPushButton(icon(u"settings"), tr("S&ervers…"), this);
  edit->setAutoDefault(false);
  edit->setToolTip(tr("Add, change and remove servers"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(server_, 1);
  row->addWidget(edit);
  setFocusProxy(server_);
  connect(edit, &QPushButton::clicked, this, &ServerChoice::edit);
  connect(server_, &QComboBox::currentIndexChanged, this, &ServerChoice::chosen);
  read();
}

void ServerChoice::read() {
  const QString before = server_->currentText();
  const auto file = imaging::pacs_configuration_to_read(file_);
  auto found = imaging::read_pacs_configuration(file);
  std::error_code error;
  // A user who has named no server yet has made no mistake.
  const bool is_wrong = !found && std::filesystem::exists(file, error);
  problem_ = is_wrong ? engine::message_text(found.error()) : QString();
  configuration_ = found ? std::move(*found) : imaging::PacsConfiguration();
  if (!is_wrong && configuration_.servers.empty())
    problem_ = tr("There is no server yet: name one with “Servers…”.");
  server_->clear();
  for (const imaging::PacsServer& one : configuration_.servers)
    server_->addItem(QString::fromStdString(one.name));
  const QString wanted = before.isEmpty() ? settings::server().get() : before;
  server_->setCurrentIndex(std::max(server_->findText(wanted), server_->count() > 0 ? 0 : -1));
}

void ServerChoice::edit() {
  auto* dialog = new ServersDialog(file_, this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this, &ServerChoice::read_again);
  dialog->open();
}

void ServerChoice::read_again() {
  const auto before = server() ? std::optional(*server()) : std::nullopt;
  {
    const QSignalBlocker quiet(server_);  // the list is made anew, and not chosen from
    read();
  }
  const auto now = server() ? std::optional(*server()) : std::nullopt;
  if (now != before) emit chosen();
  emit edited();
}

const imaging::PacsServer* ServerChoice::server() const {
  const int index = server_->currentIndex();
  return index < 0 ? nullptr : &configuration_.servers[static_cast<std::size_t>(index)];
}

Status ServerChoice::choose(const QString& name) {
  const int index = server_->findText(name);
  if (index < 0) return fail(ErrorKind::usage, "there is no server {}", name.toStdString());
  server_->setCurrentIndex(index);
  return {};
}

void ServerChoice::remember() const {
  settings::server().set(server_->currentText());
}

}  // namespace tidemark::ui
