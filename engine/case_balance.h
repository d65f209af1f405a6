// The reasons why the surface moves or rests at a place that the user has chosen.
#pragma once

#include <QObject>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "engine/case_state.h"
#include "engine/newest_question.h"
#include "solver/balance.h"

namespace tidemark::engine {

class CaseProxy;

// The balance at a place on the surface, with all that is needed to speak of it.
struct ExplainedPlace {
  glm::dvec3 place_mm{0.0};  // LPS
  glm::dvec3 outward{0.0};   // unit vector in the patient
  solver::Balance balance;
  double spacing_mm = 1.0;  // the smallest: pushes and phi are in units of it
  double time_step = 0.0;
  solver::Parameters parameters;
  bool has_tent = true;  // T and epsilon alone make D

  // Parameters, each by itself, with which the surface would begin to move that way; none: no value does.
  struct Turn {
    std::optional<double> alpha;
    std::optional<double> range;
  };
  Turn to_outward;
  Turn to_inward;

  // In mm per unit of time; > 0 outward.
  [[nodiscard]] double sum_mm() const { return balance.pushes.sum() * spacing_mm; }
  // Slower than what counts as stopped.
  [[nodiscard]] bool rests() const;
};

// Follows the case: the balance is as new as its figures. A place that the surface has left is looked for
// along the normal, so that it goes with the front. Lives on the thread of the user interface.
class CaseBalance : public QObject {
  Q_OBJECT
 public:
  explicit CaseBalance(CaseProxy& proxy);
  ~CaseBalance() override;

  // On the surface near that place of the patient (LPS, mm).
  void ask(glm::dvec3 place_mm);
  // The same while the mouse passes: nothing need come to the front, and passed() forgets it.
  void ask_in_passing(glm::dvec3 place_mm);
  void passed();
  // Where the surface moves most; the slices go there.
  void ask_fastest();
  void forget();

  [[nodiscard]] bool asked() const { return chosen_.has_value(); }
  // None while nothing was found: the surface is not near the place, or the answer is on its way.
  [[nodiscard]] const std::optional<ExplainedPlace>& place() const { return shown_; }
  [[nodiscard]] bool waits() const { return question_.waits(); }

 signals:
  void changed();
  void show_wanted();  // it was asked for, and not in passing

 private:
  struct Question {
    solver::StepInputs inputs;
    glm::dvec3 place_mm{0.0};
    glm::dvec3 outward{0.0};  // along which the surface was left; 0: not known
    bool fastest = false;
    std::uint64_t number = 0;  // of the choice

    bool operator==(const Question&) const = default;
  };
  struct Chosen {
    glm::dvec3 place_mm{0.0};
    glm::dvec3 outward{0.0};
    bool fastest = false;
    std::uint64_t number = 0;
    bool in_passing = false;
  };
  using Answer = std::optional<ExplainedPlace>;
  static Answer explain(const Question& question, const std::stop_token& stop);
  void choose(const Chosen& chosen);
  void follow();
  void take();
  void go_to(glm::dvec3 place_mm);

  CaseProxy& proxy_;
  std::optional<Chosen> chosen_;
  std::uint64_t choices_ = 0;
  std::optional<ExplainedPlace> shown_;
  NewestQuestion<Question, Answer> question_;
};

}  // namespace tidemark::engine
