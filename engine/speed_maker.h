// Speed functions, and the sources that they are made on, made on a thread of their own: smoothing and
// learning from examples take a while.
#pragma once

#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "document/drive.h"
#include "solver/speed/speed_registry.h"

namespace tidemark::engine {

// What a function was made from. With the same of all of these it is the same one, but for the tents in it:
// the level set puts T and epsilon into them.
struct SpeedOrigin {
  solver::SpeedSetting setting;
  std::shared_ptr<const Volume> volume;  // as loaded
  double smoothed_mm = 0.0;
  std::shared_ptr<const solver::Strokes> strokes;                  // of functions that learn from them
  std::vector<std::shared_ptr<const document::CaseImage>> images;  // of functions that use several
  std::shared_ptr<const document::SpeedMap> map;                   // of functions that need one

  bool operator==(const SpeedOrigin&) const = default;
};
[[nodiscard]] SpeedOrigin speed_origin(const document::Drive& drive, std::shared_ptr<const Volume> volume,
                                       double smoothed_mm);

// Belongs to one thread.
class SpeedMaker {
 public:
  struct Pair {
    std::shared_ptr<const Volume> source;
    std::shared_ptr<const solver::SpeedFunction> speed;  // null: the tent
  };
  using Made = Result<Pair>;
  // Called on the maker's thread, and not at all when another one is wanted before. Where it throws, it is
  // called once more, with that error. Where no thread can be had, make() calls it with an error.
  using Done = std::function<void(Made)>;
  using Report = std::function<void(double fraction, std::string_view what)>;  // as Progress has it

  ~SpeedMaker();

  // `source` is the volume smoothed by that much; null: the maker smooths it, and reports on it.
  void make(const SpeedOrigin& origin, std::shared_ptr<const Volume> source, Report report, Done done);
  void give_up();

 private:
  std::jthread thread_;
};

}  // namespace tidemark::engine
