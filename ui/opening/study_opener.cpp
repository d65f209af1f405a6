#include "ui/opening/study_opener.h"

#include <QFileInfo>
#include <algorithm>
#include <utility>

#include "ui/opening/phantom_menu.h"
#include "ui/opening/series_browser.h"

namespace tidemark {

StudyOpener::StudyOpener(QWidget* window) : QObject(window), window_(window) {
  connect(&loader_, &StudyLoader::progressed, this, &StudyOpener::progressed);
  connect(&loader_, &StudyLoader::found, this, &StudyOpener::look_at);
  connect(&loader_, &StudyLoader::cancelled, this, &StudyOpener::next);
  connect(&loader_, &StudyLoader::failed, this, [this](const QString& message) {
    problems_ << message;
    next();
  });
  connect(&loader_, &StudyLoader::loaded, this, [this](const std::shared_ptr<const LoadedStudy>& study) {
    emit opened(study);
    next();
  });
}

void StudyOpener::open(const QString& path, Ask ask) {
  add(QFileInfo(path).fileName(), [this, path, ask] {
    path_ = path;
    ask_ = ask;
    loader_.scan(path.toStdString());
  });
}

void StudyOpener::open_series(const QString& path, const QString& uid) {
  add(QFileInfo(path).fileName(), [this, path, uid] { loader_.load(path.toStdString(), uid.toStdString()); });
}

void StudyOpener::open_phantom(const QString& kind) {
  add(phantom_text(kind.toStdString()).title, [this, kind] { loader_.make_phantom(kind.toStdString()); });
}

void StudyOpener::cancel() {
  waiting_.clear();
  close_browser();
  loader_.cancel();
}

void StudyOpener::add(const QString& what, std::function<void()> start) {
  close_browser();
  waiting_.push_back({what, std::move(start)});
  ++asked_;
  if (number_ == 0) next();
}

void StudyOpener::next() {
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
  // After what was opened is shown, so that what is told of that does not take the message's place.
  const auto tell = [this, problems = std::exchange(problems_, {})] {
    emit failed(problems.join(QLatin1Char('\n')));
  };
  QMetaObject::invokeMethod(this, tell, Qt::QueuedConnection);
}

void StudyOpener::begin(const QString& what) {
  emit began(asked_ > 1 ? tr("%1 (%2 of %3)").arg(what).arg(number_).arg(asked_) : what);
}

void StudyOpener::look_at(const std::shared_ptr<const Catalogue>& catalogue) {
  const auto& all = catalogue->series;
  const auto is_loadable = [](const Series& series) { return series.loadable; };
  if (ask_ == Ask::if_several && std::count_if(all.begin(), all.end(), is_loadable) == 1) {
    return load(*std::find_if(all.begin(), all.end(), is_loadable));
  }
  browser_ = new SeriesBrowser(window_);
  browser_->setAttribute(Qt::WA_DeleteOnClose);
  browser_->show_catalogue(catalogue, path_);
  connect(browser_, &SeriesBrowser::chosen, this, &StudyOpener::load);
  connect(browser_, &SeriesBrowser::rejected, this, &StudyOpener::next);
  browser_->show();  // not modal: series can be dragged from it to a view
  emit ended();
}

void StudyOpener::load(const Series& series) {
  begin(StudyLoader::name_of(series));
  loader_.load(series);
}

void StudyOpener::close_browser() {
  if (browser_) browser_->close();  // which rejects it
}

}  // namespace tidemark
