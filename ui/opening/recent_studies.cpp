#include "ui/opening/recent_studies.h"

#include <QFileInfo>
#include <QSettings>
#include <algorithm>

#include "engine/background_job.h"
#include "engine/study_picture.h"
#include "ui/opening/recent_pictures.h"
#include "ui/widgets/menu_text.h"

namespace tidemark::ui {
namespace {

const QString kGroup = QStringLiteral("recent_studies");

constexpr int kPicturePixels = 128;

// As recipes call them.
const QString kKeep = QStringLiteral("keep");
const QString kFill = QStringLiteral("fill");

RecentStudy read_study(const QSettings& settings) {
  RecentStudy study{settings.value("path").toString(),
                    settings.value("uid").toString(),
                    settings.value("name").toString(),
                    {}};
  if (settings.value("tilt").toString() == kKeep) study.policy.tilt = imaging::GridPolicy::Tilt::keep;
  if (settings.value("gaps").toString() == kFill) study.policy.gaps = imaging::GridPolicy::Gaps::fill;
  return study;
}

void write_study(const RecentStudy& study, QSettings& settings) {
  settings.setValue("path", study.path);
  settings.setValue("uid", study.uid);
  settings.setValue("name", study.name);
  if (study.policy.tilt == imaging::GridPolicy::Tilt::keep) settings.setValue("tilt", kKeep);
  if (study.policy.gaps == imaging::GridPolicy::Gaps::fill) settings.setValue("gaps", kFill);
}

}  // namespace

RecentStudies::RecentStudies(QObject* parent) : QObject(parent) {
  QSettings settings;
  const int count = qMin(settings.beginReadArray(kGroup), kMost);
  for (int index = 0; index < count; ++index) {
    settings.setArrayIndex(index);
    const RecentStudy study = read_study(settings);
    if (!study.path.isEmpty()) list_.push_back(study);
  }
}

RecentStudies::~RecentStudies() {
  if (job_) job_->abandon();
  for (const auto& job : picture_jobs_) job->abandon();
}

void RecentStudies::add(const RecentStudy& study) {
  list_.removeIf(
      [&](const RecentStudy& other) { return other.path == study.path && other.uid == study.uid; });
  list_.push_front(study);
  if (list_.size() > kMost) list_.resize(kMost);
  save();
  emit changed();
}

void RecentStudies::clear() {
  list_.clear();
  save();
  emit changed();
}

void RecentStudies::save() const {
  QSettings settings;
  settings.remove(kGroup);
  settings.beginWriteArray(kGroup, static_cast<int>(list_.size()));
  for (int index = 0; index < list_.size(); ++index) {
    settings.setArrayIndex(index);
    write_study(list_[index], settings);
  }
  QStringList pictures;
  for (const RecentStudy& study : list_) pictures << recent_picture_name(study.path, study.uid);
  keep_recent_pictures(pictures);
}

void RecentStudies::add_picture(const RecentStudy& study, std::shared_ptr<const Volume> volume,
                                const WindowLevel& window, std::int64_t k) {
  const QString name = recent_picture_name(study.path, study.uid);
  picture_jobs_.push_back(engine::BackgroundJob::start(
      this, [this, name, volume = std::move(volume), window, k](engine::BackgroundJob& job) {
        const QImage picture = engine::picture_of_volume(*volume, window, k, kPicturePixels);
        job.deliver([this, name, picture] {
          const auto has_name = [&](const RecentStudy& one) {
            return recent_picture_name(one.path, one.uid) == name;
          };
          // It may have left the list by now.
          if (std::none_of(list_.begin(), list_.end(), has_name)) return;
          if (write_recent_picture(name, picture)) emit changed();
        });
      }));
}

QImage RecentStudies::picture_of(const RecentStudy& study) {
  return read_recent_picture(recent_picture_name(study.path, study.uid));
}

void RecentStudies::check() {
  if (job_) job_->abandon();
  QStringList paths;
  for (const RecentStudy& study : list_) paths.push_back(study.path);
  job_ = engine::BackgroundJob::start(
      this,
      [this, paths](engine::BackgroundJob& job) {
        QStringList missing;
        for (const QString& path : paths) {
          if (job.stop().stop_requested()) return;
          if (!QFileInfo::exists(path)) missing.push_back(path);
        }
        job.deliver([this, missing] {
          job_.reset();
          bool different = false;
          for (RecentStudy& study : list_) {
            const bool is_missing = missing.contains(study.path);
            different = different || study.missing != is_missing;
            study.missing = is_missing;
          }
          if (different) emit changed();
        });
      },
      [this](const Error&) { job_.reset(); });  // they are looked for again with the next menu
}

QMenu* RecentStudies::make_menu(QWidget* parent) {
  auto* menu = new QMenu(tr("Open rece&nt"), parent);
  menu->setToolTipsVisible(true);
  connect(this, &RecentStudies::changed, menu, [this, menu] { fill(*menu); });
  connect(menu, &QMenu::aboutToShow, this, &RecentStudies::check);
  fill(*menu);
  return menu;
}

void RecentStudies::fill(QMenu& menu) {
  menu.clear();
  int number = 1;
  for (const RecentStudy& study : list_) {
    const QString place = QFileInfo(study.path).fileName();
    QString text = study.missing ? tr("%1 (%2, not found)") : tr("%1 (%2)");
    text = menu_text(text.arg(study.name, place));
    // Keys 1 to 9, and 0 for the tenth.
    QAction* action = menu.addAction(QStringLiteral("&%1  %2").arg(QString::number(number++ % 10), text));
    action->setToolTip(study.path);
    action->setEnabled(!study.missing);
    connect(action, &QAction::triggered, this, [this, study] { emit chosen(study); });
  }
  if (list_.isEmpty()) menu.addAction(tr("No studies yet"))->setEnabled(false);
  menu.addSeparator();
  QAction* clear_all = menu.addAction(tr("&Clear List"));
  clear_all->setEnabled(!list_.isEmpty());
  connect(clear_all, &QAction::triggered, this, &RecentStudies::clear);
}

}  // namespace tidemark::ui
