#include "ui/panels/map_choice.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "core/without_exceptions.h"
#include "document/speed_map.h"
#include "engine/message_text.h"
#include "imaging/results/results.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/settings.h"
#include "ui/widgets/file_patterns.h"
#include "ui/widgets/form.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {

MapChoice::MapChoice(QWidget* parent) : CaseWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpace);
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpace);
  button_ = new QPushButton(icon(u"open-file"), tr("Choose a map…"));
  button_->setToolTip(
      tr("A probability from 0 to 1, or a speed from -1 to 1: a file on the grid of the study, or a DICOM "
         "parametric map or segmentation."));
  connect(button_, &QPushButton::clicked, this, &MapChoice::choose);
  name_ = new QLabel;
  name_->setTextFormat(Qt::PlainText);
  name_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  row->addWidget(button_);
  row->addWidget(name_, 1);
  remark_ = make_note({});
  remark_->hide();
  column->addLayout(row);
  column->addWidget(remark_);
}

MapChoice::~MapChoice() {
  give_up();
}

void MapChoice::give_up() {
  if (reading_) reading_->abandon();
  reading_.reset();
}

void MapChoice::attach() {
  give_up();
}

void MapChoice::refresh() {
  const auto& map = proxy()->drive().map;
  const QString name = map ? QString::fromStdString(map->name) : QString();
  name_->setText(reading_ ? tr("Reading the file …") : name);
  name_->setToolTip(name);
  button_->setEnabled(!reading_);
  const auto remark =
      map ? imaging::frame_remark({&map->frame_of_reference_uid, 1}, proxy()->study().frame_of_reference_uid)
          : std::nullopt;
  remark_->setText(remark ? engine::message_text(*remark) : QString());
  remark_->setVisible(remark.has_value());
}

void MapChoice::choose() {
  auto* dialog = new QFileDialog(this, tr("Map that drives the surface"), settings::open_folder().get(),
                                 tr("Maps (*.dcm %1);;All files (*)").arg(QLatin1String(kVolumePatterns)));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this, &MapChoice::read);
  dialog->open();
}

void MapChoice::read(const QString& file) {
  if (!proxy()) return;
  give_up();
  const std::filesystem::path path = path_of(file);
  reading_ = engine::BackgroundJob::start(
      this,
      [this, path, grid = proxy()->volume().geometry](engine::BackgroundJob& job) {
        const auto map =
            std::make_shared<Result<std::shared_ptr<const document::SpeedMap>>>(without_exceptions([&] {
              return document::load_speed_map(path, grid, {nullptr, job.stop()});
            }));
        job.deliver([this, map] { take(*map); });
      },
      [this](const Error& error) { take(tl::unexpected(error)); });
  refresh();
}

void MapChoice::take(const Result<std::shared_ptr<const document::SpeedMap>>& map) {
  reading_.reset();
  if (map) {
    emit chosen(*map);
  } else {
    emit failed(engine::message_text(map.error()));
  }
  if (proxy()) refresh();
}

}  // namespace tidemark::ui
