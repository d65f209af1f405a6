// D of a box of voxels, evaluated away from the thread of the user interface.
#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <vector>

#include "engine/background_job.h"
#include "solver/speed/speed_function.h"

namespace tidemark::engine {

// The newest question wins; the one that is being answered is answered to its end.
class SpeedSampler : public QObject {
  Q_OBJECT
 public:
  struct Question {
    std::shared_ptr<const solver::SpeedFunction> speed;
    Index3 first{0};
    Index3 size{1};

    bool operator==(const Question&) const = default;
  };

  explicit SpeedSampler(QObject* parent = nullptr) : QObject(parent) {}
  ~SpeedSampler() override;

  void ask(const Question& question);
  // The values of the question that was last asked, x fastest; none while they are not there.
  [[nodiscard]] const std::optional<std::vector<double>>& answer() const { return answer_; }

 signals:
  void answered();

 private:
  void start();
  void take(const Question& question, std::vector<double> values);

  Question question_;
  std::optional<std::vector<double>> answer_;
  std::shared_ptr<BackgroundJob> job_;  // while one runs
};

}  // namespace tidemark::engine
