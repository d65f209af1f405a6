// The distances between the surface of a case and a known answer, while it moves, too.
#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "core/bit_mask.h"
#include "engine/newest_question.h"
#include "solver/surface_agreement.h"

namespace tidemark::engine {

class TruthSurface;

// Lives on the thread of the user interface. Distances are taken on another one, in a tenth of the time.
class TruthComparison : public QObject {
  Q_OBJECT
 public:
  explicit TruthComparison(QObject* parent = nullptr);

  // Neither is null, and they have one grid. The answer is that of the newest phi that was asked for, or of
  // one shortly before.
  void ask(const std::shared_ptr<const BitMask>& truth, std::shared_ptr<const solver::Field> phi);
  void forget();
  // Unset: not known yet, or one of them has no surface.
  [[nodiscard]] std::optional<solver::SurfaceDistance> distance() const;

 signals:
  void answered();

 private:
  struct Question {
    std::shared_ptr<const TruthSurface> truth;
    std::shared_ptr<const solver::Field> phi;

    bool operator==(const Question&) const = default;
  };
  using Answer = std::optional<solver::SurfaceDistance>;
  static Answer compare(const Question& question, const std::stop_token& stop);

  std::shared_ptr<const TruthSurface> truth_;
  NewestQuestion<Question, Answer> question_;
};

}  // namespace tidemark::engine
