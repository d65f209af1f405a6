// Small pictures of the cases of a cohort, read when they are wanted.
#pragma once

#include <QCache>
#include <QObject>
#include <QPixmap>
#include <QString>
#include <QStringList>
#include <memory>

namespace tidemark::engine {
class BackgroundJob;
}

namespace tidemark::ui {

// Files are read beside the user interface, one after the other, what was last wanted first. Those that were
// shown last are kept.
class CasePictures : public QObject {
  Q_OBJECT
 public:
  static constexpr int kWidth = 160;  // logical pixels, as case_picture() makes them
  static constexpr int kHeight = 40;

  CasePictures();
  ~CasePictures() override;

  // An empty one until read() tells that it is there, and where there is no such file.
  [[nodiscard]] QPixmap picture(const QString& file);
  void forget(const QString& file);

 signals:
  void read(const QString& file);

 private:
  void read_next();

  QPixmap none_;
  QCache<QString, QPixmap> pictures_;
  QStringList wanted_;  // the last is read next
  std::shared_ptr<engine::BackgroundJob> reading_;
};

}  // namespace tidemark::ui
