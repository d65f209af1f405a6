// The joint histogram of two images of a case, with the values at its strokes.
#pragma once

#include <QObject>
#include <QString>
#include <array>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <vector>

#include "core/volume.h"
#include "document/case_image.h"
#include "engine/background_job.h"
#include "solver/speed/strokes.h"

namespace tidemark::engine {

struct JointHistogram {
  static constexpr int kBins = 80;
  // A value of either image: 0 and 1 are the ends of its common values, beyond which all is in the last bin.
  using Place = std::array<float, 2>;

  std::array<std::pair<float, float>, 2> ranges;  // common values
  std::vector<std::int64_t> counts;               // kBins * kBins, the first image fastest
  std::vector<Place> inside;                      // at most kMostPoints of the strokes of either kind
  std::vector<Place> outside;
  static constexpr std::size_t kMostPoints = 2000;
};

// From a regular sample of at most about a million voxels. `first` and `second` are on one grid; without
// strokes (null) there are no points. Empty when stopped.
JointHistogram joint_histogram(const Volume& first, const Volume& second, const solver::Strokes* strokes,
                               const std::stop_token& stop = {});

// Counts away from the thread of the user interface. The newest question wins.
class JointCounter : public QObject {
  Q_OBJECT
 public:
  struct Question {
    std::shared_ptr<const Volume> first;
    std::shared_ptr<const document::CaseImage> second;  // on any grid
    std::shared_ptr<const solver::Strokes> strokes;

    bool operator==(const Question&) const = default;
  };

  explicit JointCounter(QObject* parent = nullptr) : QObject(parent) {}
  ~JointCounter() override;

  void ask(const Question& question);
  // The newest of those two images; null: none yet, or problem() says why.
  [[nodiscard]] const std::shared_ptr<const JointHistogram>& answer() const { return answer_; }
  // Why there is no answer; empty: it is there, or on its way. Where it may go better another time, the same
  // question can be asked again.
  [[nodiscard]] const QString& problem() const { return problem_; }
  void forget();

 signals:
  void answered();  // or there is a problem

 private:
  void give_up(const Error& error);

  Question question_;
  std::shared_ptr<const JointHistogram> answer_;
  QString problem_;
  std::shared_ptr<BackgroundJob> job_;  // while one runs
};

}  // namespace tidemark::engine
