// D of a box of voxels, evaluated away from the thread of the user interface.
#pragma once

#include <QObject>
#include <memory>
#include <vector>

#include "engine/newest_question.h"
#include "solver/speed/speed_function.h"

namespace tidemark::engine {

class SpeedSampler : public QObject {
  Q_OBJECT
 public:
  struct Question {
    std::shared_ptr<const solver::SpeedFunction> speed;
    Index3 first{0};
    Index3 size{1};

    bool operator==(const Question&) const = default;
  };

  explicit SpeedSampler(QObject* parent = nullptr);

  // Without a speed: nothing is asked any more.
  void ask(const Question& question);
  // The values of the question that was last asked, x fastest; null while they are not there.
  [[nodiscard]] const std::vector<double>* answer() const { return question_.newest(); }

 signals:
  void answered();  // with the values of the question that was last asked

 private:
  NewestQuestion<Question, std::vector<double>> question_;
};

}  // namespace tidemark::engine
