// The pushes of the speed terms at places spread over the surface, for the arrows of a view.
#pragma once

#include <QObject>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/newest_question.h"
#include "solver/balance.h"
#include "solver/surface_places.h"

namespace tidemark::engine {

struct PlaceForces {
  glm::dvec3 place_mm{0.0};  // LPS
  glm::dvec3 outward{0.0};   // unit vector in the patient
  solver::Pushes pushes;     // in smallest spacings per unit of time
};

class ForceSampler : public QObject {
  Q_OBJECT
 public:
  struct Question {
    solver::StepInputs inputs;
    std::optional<solver::PlaneSlab> slab;  // of a slice; none: the whole surface
    double apart_mm = 1.0;                  // how far places are from each other

    bool operator==(const Question&) const = default;
  };

  explicit ForceSampler(QObject* parent = nullptr);

  void ask(Question question) { question_.ask(std::move(question)); }
  void forget() { question_.forget(); }
  // Of the last question that was answered.
  [[nodiscard]] const std::vector<PlaceForces>& forces() const;

 signals:
  void answered();

 private:
  NewestQuestion<Question, std::vector<PlaceForces>> question_;
};

}  // namespace tidemark::engine
