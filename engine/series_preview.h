// Small pictures of series, to choose by.
#pragma once

#include <QImage>
#include <QObject>
#include <memory>

#include "core/progress.h"
#include "imaging/series.h"

namespace tidemark::engine {

class BackgroundJob;

// The middle slice of a loadable series, at most `pixels` wide and high, in the file's own window or the
// range of common values. Axial, coronal and sagittal slices lie as radiologists look at them; pixels are
// square in mm. Null when the slice cannot be read, or the volume file is so large that reading it takes
// long.
QImage middle_slice_picture(const imaging::Series& series, int pixels, const Progress& progress = {});

// Makes such pictures one after the other in the background, in the order in which they were asked for.
class SeriesPreviews : public QObject {
  Q_OBJECT
 public:
  explicit SeriesPreviews(QObject* parent = nullptr);
  ~SeriesPreviews() override;  // gives up what runs, and waits for nothing

  // Ends with made(key, ...).
  void request(int key, const imaging::Series& series, int pixels);
  void forget();  // all that are not made yet

 signals:
  void made(int key, const QImage& picture);

 private:
  struct Waiting;
  void start();
  void go_on();

  std::shared_ptr<Waiting> waiting_;
  std::shared_ptr<BackgroundJob> job_;
};

}  // namespace tidemark::engine
