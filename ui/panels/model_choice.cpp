#include "ui/panels/model_choice.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <system_error>

#include "engine/message_text.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {

ModelChoice::ModelChoice(QWidget* parent) : QWidget(parent) {
  Form form(this);
  server_ = form.choice(tr("Server"), tr("A server of this site, from the file ai.json."));
  where_ = form.note({});
  list_ = new QPushButton(tr("List models"));
  list_->setToolTip(tr("Asks the server which models it has. Nothing of the study is sent."));
  form.wide(list_);
  model_ =
      form.choice(tr("Model"), tr("What it finds is the server's matter; the tip of an entry says more."));
  label_ = form.choice(tr("Label"), tr("Which of the model's labels is meant; clicks inside belong to it."));
  connect(server_, &QComboBox::currentIndexChanged, this, &ModelChoice::show_server);
  connect(list_, &QPushButton::clicked, this, &ModelChoice::list_wanted);
  connect(model_, &QComboBox::currentIndexChanged, this, &ModelChoice::show_model);
  connect(label_, &QComboBox::currentIndexChanged, this, &ModelChoice::changed);
  show_server();
}

bool ModelChoice::read() {
  const auto file = imaging::ai_configuration_file();
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return false;
  auto found = imaging::read_ai_configuration(file);
  problem_ = found ? QString() : engine::message_text(found.error());
  auto servers = found ? std::move(found->servers) : std::vector<imaging::AiServer>();
  if (servers == servers_) return true;
  servers_ = std::move(servers);
  {
    const QSignalBlocker quiet(server_);
    server_->clear();
    for (const imaging::AiServer& one : servers_) server_->addItem(QString::fromStdString(one.name));
  }
  show_server();
  return true;
}

const imaging::AiServer* ModelChoice::server() const {
  const int index = server_->currentIndex();
  return index < 0 ? nullptr : &servers_[static_cast<std::size_t>(index)];
}

QString ModelChoice::where() const {
  const imaging::AiServer* one = server();
  if (!one) return {};
  const QString url = QString::fromStdString(one->access.url);
  if (one->is_on_this_machine()) return tr("%1, on this machine").arg(url);
  if (!one->is_encrypted()) return tr("%1, not encrypted: others on the network can read along").arg(url);
  if (one->tls && !one->tls->verify) return tr("%1, encrypted, but its certificate is not checked").arg(url);
  return tr("%1, encrypted by TLS").arg(url);
}

void ModelChoice::show_server() {
  where_->setText(where());
  where_->setVisible(server() != nullptr);
  list_->setEnabled(server() != nullptr);
  set_models(nullptr);  // another server has others
}

void ModelChoice::set_models(std::shared_ptr<const std::vector<imaging::AiModel>> models) {
  {
    const QSignalBlocker quiet(model_);
    const QString before = model_->currentText();
    models_ = std::move(models);
    model_->clear();
    for (const imaging::AiModel& one : models_ ? *models_ : std::vector<imaging::AiModel>()) {
      model_->addItem(QString::fromStdString(one.name));
      model_->setItemData(model_->count() - 1, QString::fromStdString(one.description), Qt::ToolTipRole);
    }
    model_->setCurrentIndex(std::max(model_->findText(before), model_->count() > 0 ? 0 : -1));
    model_->setEnabled(model_->count() > 0);
  }
  show_model();
}

void ModelChoice::show_model() {
  {
    const QSignalBlocker quiet(label_);
    label_->clear();
    label_->addItem(tr("All"), 0);
    if (const imaging::AiModel* one = model()) {
      for (const imaging::AiLabel& label : one->labels)
        label_->addItem(QString::fromStdString(label.name), label.number);
    }
    label_->setEnabled(label_->count() > 2);  // one alone is all
  }
  emit changed();
}

const imaging::AiModel* ModelChoice::model() const {
  const int index = model_->currentIndex();
  return !models_ || index < 0 ? nullptr : &(*models_)[static_cast<std::size_t>(index)];
}

std::string ModelChoice::label() const {
  return number() == 0 ? std::string() : label_->currentText().toStdString();
}

int ModelChoice::number() const {
  return label_->currentData().toInt();
}

}  // namespace tidemark::ui
