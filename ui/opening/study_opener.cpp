#include "ui/opening/study_opener.h"

#include <QCheckBox>
#include <QFileInfo>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "engine/message_text.h"
#include "engine/phantom_text.h"
#include "ui/widgets/status_progress.h"

namespace tidemark::ui {
namespace {

constexpr int kPreviewPixels = 1024;

QCheckBox* make_tilt_box(const imaging::GridPolicy& policy) {
  auto* box = new QCheckBox(StudyOpener::tr("&Correct the tilt of the gantry"));
  box->setToolTip(
      StudyOpener::tr("Moves the slices back within their planes. Without it distances across slices are\n"
                      "sheared, and results cannot be written as DICOM."));
  box->setChecked(policy.tilt == imaging::GridPolicy::Tilt::correct);
  return box;
}

}  // namespace

StudyOpener::StudyOpener(QWidget* window) : QObject(window), window_(window) {
  connect(&loader_, &engine::StudyLoader::progressed, this, &StudyOpener::progressed);
  connect(&loader_, &engine::StudyLoader::found, this, &StudyOpener::look_at);
  connect(&loader_, &engine::StudyLoader::cancelled, this, &StudyOpener::next);
  connect(&loader_, &engine::StudyLoader::failed, this, [this](const QString& message) {
    problems_ << message;
    next();
  });
  connect(&loader_, &engine::StudyLoader::loaded, this,
          [this](const std::shared_ptr<const engine::LoadedStudy>& study) {
            last_opened_ = study;
            beside_last_opened_ = std::exchange(results_, {});
            emit opened(study);
            next();
          });
  connect(&finder_, &engine::ResultFinder::cancelled, this, &StudyOpener::next);
  const auto load_with = [this](const std::vector<engine::FoundResult>& results) {
    results_ = results;
    loader_.load(to_load_.series, to_load_.remarks);
  };
  connect(&finder_, &engine::ResultFinder::found, this, load_with);
  connect(&finder_, &engine::ResultFinder::failed, this, [load_with] { load_with({}); });
  connect(&previews_, &engine::SeriesPreviews::made, this, [this](int, const QImage& picture) {
    if (!picture.isNull()) emit previewed(picture);
  });
}

void StudyOpener::open(const QString& path, Ask ask) {
  add(QFileInfo(path).fileName(), [this, path, ask] {
    path_ = path;
    uid_.reset();
    ask_ = ask;
    loader_.scan(path.toStdString());
  });
}

void StudyOpener::open_series(const QString& path, const QString& uid, const imaging::GridPolicy& policy) {
  add(QFileInfo(path).fileName(), [this, path, uid, policy] {
    path_ = path;
    uid_ = uid;
    loader_.scan(path.toStdString(), policy);
  });
}

void StudyOpener::open_phantom(const QString& kind) {
  add(engine::phantom_text(kind.toStdString()).title,
      [this, kind] { loader_.make_phantom(kind.toStdString()); });
}

void StudyOpener::cancel() {
  waiting_.clear();
  close_questions();
  finder_.cancel();
  loader_.cancel();
}

void StudyOpener::show_in(StatusProgress& progress) {
  connect(this, &StudyOpener::began, &progress, [&progress](const QString& what) {
    progress.begin(what.isEmpty() ? tr("Opening a study") : tr("Opening %1").arg(what));
  });
  connect(this, &StudyOpener::progressed, &progress, &StatusProgress::set_progress);
  connect(this, &StudyOpener::ended, &progress, &QWidget::hide);
  connect(&progress, &StatusProgress::cancelled, this, &StudyOpener::cancel);
}

std::vector<engine::FoundResult> StudyOpener::results_beside(const engine::LoadedStudy& study) const {
  return last_opened_.lock().get() == &study ? beside_last_opened_ : std::vector<engine::FoundResult>();
}

void StudyOpener::add(const QString& what, std::function<void()> start) {
  close_questions();
  waiting_.push_back({what, std::move(start)});
  ++asked_;
  if (number_ == 0) next();
}

void StudyOpener::next() {
  previews_.forget();
  results_.clear();
  if (!waiting_.empty()) {
    const Request request = std::move(waiting_.front());
    waiting_.pop_front();
    ++number_;
    begin(request.what);
    return request.start();
  }
  number_ = asked_ = 0;
  emit ended();
  if (problems_.isEmpty()) return;
  // After the opened study is shown, so that its own report does not replace the message.
  const auto tell = [this, problems = std::exchange(problems_, {})] {
    emit failed(problems.join(QLatin1Char('\n')));
  };
  QMetaObject::invokeMethod(this, tell, Qt::QueuedConnection);
}

void StudyOpener::begin(const QString& what) {
  emit began(asked_ > 1 ? tr("%1 (%2 of %3)").arg(what, QString::number(number_), QString::number(asked_))
                        : what);
}

void StudyOpener::look_at(const std::shared_ptr<const imaging::Catalogue>& catalogue) {
  catalogue_ = catalogue;
  if (uid_) return load_by_uid(*catalogue);
  auto choice = imaging::meant_series(*catalogue, {});
  std::erase_if(choice, [](const auto* series) { return !series->loadable && !series->fillable(); });
  if (ask_ == Ask::if_several && choice.size() == 1) return load_as_wanted(*choice.front());
  browser_ = new SeriesBrowser(window_);
  browser_->setAttribute(Qt::WA_DeleteOnClose);
  browser_->show_catalogue(catalogue, path_);
  connect(browser_, &SeriesBrowser::chosen, this, &StudyOpener::load_as_wanted);
  connect(browser_, &SeriesBrowser::rejected, this, &StudyOpener::next);
  browser_->show();  // not modal
  emit ended();
}

void StudyOpener::load(const imaging::Series& series, const std::vector<std::string>& remarks) {
  begin(engine::StudyLoader::name_of(series));
  if (previews_wanted_) previews_.request(0, series, kPreviewPixels);
  to_load_ = {series, remarks};
  finder_.look(series, std::exchange(catalogue_, nullptr));
}

void StudyOpener::load_by_uid(const imaging::Catalogue& catalogue) {
  const std::string uid = uid_->toStdString();
  if (const imaging::Series* gappy = imaging::find_fillable(catalogue, uid)) return ask_for_policy(*gappy);
  const auto chosen = imaging::choose_series(catalogue, uid, path_.toStdString());
  if (chosen) return load(chosen->series, chosen->remarks);
  problems_ << engine::message_text(chosen.error());
  next();
}

void StudyOpener::load_as_wanted(const imaging::Series& series) {
  if (series.fillable() || !series.grid.tilt.empty()) return ask_for_policy(series);
  load(series);
}

// Making slices up is not the default; moving them back is.
void StudyOpener::ask_for_policy(const imaging::Series& series) {
  const bool fills = series.fillable();
  question_ = new QMessageBox(QMessageBox::Question, fills ? tr("Irregular slices") : tr("Tilted slices"),
                              engine::message_text(fills ? series.grid.question : series.grid.tilt),
                              QMessageBox::Cancel, window_);
  question_->setAttribute(Qt::WA_DeleteOnClose);
  question_->setTextFormat(Qt::PlainText);
  question_->setInformativeText(
      fills ? tr("Interpolated slices show an average of their neighbours, not what was measured.")
            : tr("Corrected, the slices are moved back within their planes, and lie above each other. "
                 "As they are, distances across them are sheared."));
  if (!series.grid.tilt.empty()) question_->setCheckBox(make_tilt_box(series.policy));
  QPushButton* proceed =
      question_->addButton(fills ? tr("&Interpolate") : tr("&Open"), QMessageBox::AcceptRole);
  if (fills) {
    question_->setDefaultButton(QMessageBox::Cancel);
  } else {
    question_->setDefaultButton(proceed);
  }
  connect(question_, &QMessageBox::finished, this, [this, series, fills, proceed, box = question_.data()] {
    if (box->clickedButton() != proceed) return next();
    imaging::GridPolicy policy = series.policy;
    if (fills) policy.gaps = imaging::GridPolicy::Gaps::fill;
    if (box->checkBox() != nullptr) {
      policy.tilt =
          box->checkBox()->isChecked() ? imaging::GridPolicy::Tilt::correct : imaging::GridPolicy::Tilt::keep;
    }
    load(imaging::by_policy(series, policy));
  });
  question_->open();
  emit ended();
}

void StudyOpener::close_questions() {
  if (browser_) browser_->close();  // which rejects it
  if (question_) question_->close();
}

}  // namespace tidemark::ui
