// Speed functions made on a thread of their own: learning from examples takes a while.
#pragma once

#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "document/drive.h"
#include "solver/speed/speed_registry.h"

namespace tidemark::engine {

// What a function was made from. With the same of all of these it is the same one.
struct SpeedOrigin {
  solver::SpeedSetting setting;
  std::shared_ptr<const Volume> source;
  std::shared_ptr<const solver::Strokes> strokes;                  // of functions that learn from them
  std::vector<std::shared_ptr<const document::CaseImage>> images;  // of functions that use several
  std::shared_ptr<const document::SpeedMap> map;                   // of functions that need one
  solver::Parameters parameters;                                   // of the tent, beside others

  bool operator==(const SpeedOrigin&) const = default;
};
[[nodiscard]] SpeedOrigin speed_origin(const document::Drive& drive, std::shared_ptr<const Volume> source,
                                       const solver::Parameters& parameters);

// Belongs to one thread.
class SpeedMaker {
 public:
  using Made = Result<std::shared_ptr<const solver::SpeedFunction>>;
  // Called on the maker's thread, and not at all when another one is wanted before.
  using Done = std::function<void(Made)>;

  ~SpeedMaker();

  void make(const SpeedOrigin& origin, Done done);
  void give_up();

 private:
  std::jthread thread_;
};

}  // namespace tidemark::engine
