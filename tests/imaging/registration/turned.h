// Images that lie turned and shifted in the patient, and how far a registration is from that.
#pragma once

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "imaging/registration/registration.h"

namespace tidemark::test {

inline glm::dvec3 centre_of(const Geometry& grid) {
  return grid.to_patient(glm::dvec3(grid.size - Index3(1)) * 0.5);
}

// A turn about an oblique axis through the grid's centre, then a shift in an oblique direction.
inline glm::dmat4 turned(const Geometry& grid, double degrees, double shift_mm) {
  const glm::dvec3 centre = centre_of(grid);
  const glm::dvec3 shift = shift_mm * glm::normalize(glm::dvec3(2.0, -1.0, 1.5));
  const glm::dmat4 there = glm::translate(glm::dmat4(1.0), centre + shift);
  return glm::translate(glm::rotate(there, glm::radians(degrees), glm::normalize(glm::dvec3(1.0, 2.0, 2.0))),
                        -centre);
}

// How far the registration is from bringing an image that was moved by `moved` back to where it was.
inline imaging::Registration miss(const imaging::Registration& found, const glm::dmat4& moved,
                                  const Geometry& grid) {
  return imaging::describe_rigid(found.to_fixed * moved, centre_of(grid));
}

}  // namespace tidemark::test
