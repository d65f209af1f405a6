#include "ui/opening/study_opener.h"

#include <QFileInfo>
#include <algorithm>

#include "ui/opening/phantom_menu.h"
#include "ui/opening/series_browser.h"

namespace tidemark {

StudyOpener::StudyOpener(QWidget* window) : QObject(window), window_(window) {
  connect(&loader_, &StudyLoader::progressed, this, &StudyOpener::progressed);
  connect(&loader_, &StudyLoader::found, this, &StudyOpener::look_at);
  connect(&loader_, &StudyLoader::failed, this, &StudyOpener::failed);
  connect(&loader_, &StudyLoader::cancelled, this, &StudyOpener::ended);
  connect(&loader_, &StudyLoader::loaded, this, [this](const std::shared_ptr<const LoadedStudy>& study) {
    emit ended();
    emit opened(study);
  });
}

void StudyOpener::open(const QString& path, Ask ask) {
  close_browser();
  path_ = path;
  ask_ = ask;
  emit began(QFileInfo(path).fileName());
  loader_.scan(path.toStdString());
}

void StudyOpener::open_series(const QString& path, const QString& uid) {
  close_browser();
  emit began(QFileInfo(path).fileName());
  loader_.load(path.toStdString(), uid.toStdString());
}

void StudyOpener::open_phantom(const QString& kind) {
  close_browser();
  emit began(phantom_text(kind.toStdString()).title);
  loader_.make_phantom(kind.toStdString());
}

void StudyOpener::cancel() {
  close_browser();
  loader_.cancel();
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
  browser_->show();  // not modal: series can be dragged from it to a view
  emit ended();
}

void StudyOpener::load(const Series& series) {
  emit began(StudyLoader::name_of(series));
  loader_.load(series);
}

void StudyOpener::close_browser() {
  if (browser_) browser_->close();
}

}  // namespace tidemark
