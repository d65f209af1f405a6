// A case as widgets know it: what it was like after the last job, what it can be told to do, and how it is
// shown.
#pragma once

#include <QObject>
#include <QString>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "session/display.h"
#include "session/engine.h"
#include "session/source_summary.h"
#include "solver/executor.h"
#include "solver/statistics.h"
#include "study/case.h"

namespace tidemark {

class CaseRunner;

// A point of the curves that show how the level set develops.
struct CurvePoint {
  std::int64_t step = 0;
  double volume_ml = 0.0;
  double surface_mm2 = 0.0;
  double surface_speed = 0.0;  // root mean square, smallest spacings per unit of time (kConvergedSpeed)
};

// What a case was like after the engine's last job for it.
struct CaseState {
  Parameters parameters;
  std::int64_t step = 0;  // since the start
  bool begun = false;     // there is a surface
  bool playing = false;
  bool converged = false;
  double time_step = 0.0;
  double band = 2.5;
  double smoothed_mm = 0.0;
  QString executor;               // "host", "compute", "stream"
  double steps_per_second = 0.0;  // while it plays, in the last second: steps by time, pictures included
  double solver_steps_per_second = 0.0;  // in the solver's own time
  MemoryReport memory;
  std::shared_ptr<const Field> phi;  // at most a second old while it plays, else as it is
  std::vector<CurvePoint> curve;     // since the start, thinned
  SurfaceStatistics surface;         // as of the last measurement
  RegionStatistics inside;           // of the volume's values, under the surface; measured when it rests
  std::vector<Label> labels;
  std::vector<RegionStatistics> label_statistics;                 // in the order of `labels`
  std::shared_ptr<const std::vector<std::uint8_t>> label_voxels;  // null while there are none
  QString undo_text;                                              // what undo would take back; empty: nothing
  QString redo_text;
  bool modified = false;  // something would be lost
  QString start_text;     // how it began
};

// Lives on the thread of the user interface. Commands return at once; their outcome comes with
// state_changed(), what went wrong with failed().
class CaseSession : public QObject {
  Q_OBJECT
 public:
  struct Opened {
    std::shared_ptr<const Volume> volume;
    StudyOrigin origin;
    SourceSummary summary;
    QString name;  // for titles; holds no patient's name
    Parameters parameters;
  };
  CaseSession(Engine& engine, Opened opened, ExecutorKind executor);
  ~CaseSession() override;  // cancels what is running

  [[nodiscard]] const CaseState& state() const { return state_; }
  [[nodiscard]] const Volume& volume() const { return *opened_.volume; }
  [[nodiscard]] const SourceSummary& summary() const { return opened_.summary; }
  [[nodiscard]] const StudyOrigin& origin() const { return opened_.origin; }
  [[nodiscard]] const QString& name() const { return opened_.name; }
  [[nodiscard]] Display& display() { return display_; }
  [[nodiscard]] Engine& engine() { return engine_; }
  // The parameters as last set here, before the engine has taken them: what sliders show.
  [[nodiscard]] const Parameters& parameters() const { return wanted_parameters_; }

  // The evolution.
  void play();
  void pause();
  void toggle_play() { state_.playing ? pause() : play(); }
  void step(std::int64_t steps = 1);
  void step_back(std::int64_t steps = 1);
  void restart();
  // Between two pictures while it plays; 0: as many as take about 16 ms.
  void set_steps_per_picture(std::int64_t steps);
  [[nodiscard]] std::int64_t steps_per_picture() const { return steps_per_picture_; }
  void set_pause_at_convergence(bool pause);
  [[nodiscard]] bool pause_at_convergence() const { return pause_at_convergence_; }

  // Edits. One gesture (a drag, a stroke) is one entry of the history; 0: an edit of its own.
  [[nodiscard]] static std::uint64_t new_gesture();
  void set_parameters(const Parameters& parameters, std::uint64_t gesture = 0);
  void begin(const Start& start);
  void paint(const Sphere& sphere, Brush brush, std::uint64_t gesture);
  void smooth_source(double sigma_mm);  // what the level set sees; 0: the volume as it is
  void change_executor(ExecutorKind kind);
  void undo();
  void redo();

  // Labels.
  void add_label(const QString& name);
  void set_label(const Label& label);
  void remove_label(std::uint8_t id);
  void accept_surface(std::uint8_t label);  // the surface's inside becomes the label
  void begin_from_label(std::uint8_t label);

 signals:
  void state_changed();
  void failed(const QString& message);
  // Long work (smoothing, flood fill): fraction in 0..1, 1 when it is over.
  void progressed(double fraction, const QString& what);

 private:
  Engine& engine_;
  Opened opened_;
  Display display_;
  CaseState state_;
  Parameters wanted_parameters_;
};

}  // namespace tidemark
