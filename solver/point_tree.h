// A k-d tree of points, for the nearest of them.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace tidemark::solver {

class PointTree {
 public:
  explicit PointTree(std::vector<glm::vec3> points);

  [[nodiscard]] const std::vector<glm::vec3>& points() const { return points_; }  // in the tree's order
  // The distance to the nearest point that is nearer than the `hint`-th one, or to that. `hint` becomes the
  // nearest: neighbours that are asked for one after the other are found quickly. There must be points.
  [[nodiscard]] float distance(glm::vec3 from, std::size_t& hint) const;

 private:
  struct Search;
  void build(std::size_t begin, std::size_t end);
  void look(Search& search, std::size_t begin, std::size_t end) const;

  std::vector<glm::vec3> points_;   // a range is divided at its middle
  std::vector<std::uint8_t> axes_;  // of that division, at the middle's index
};

}  // namespace tidemark::solver
