// A map for the views of a case that is computed when it is first wanted, on a thread of its own.
#pragma once

#include <QObject>
#include <functional>
#include <memory>

#include "solver/speed/speed_function.h"

namespace tidemark::engine {

class BackgroundJob;

// Lives on the thread of the user interface.
class WantedMap : public QObject {
  Q_OBJECT
 public:
  using Map = std::shared_ptr<const solver::SpeedFunction>;
  using Make = std::function<Map()>;
  // Null: nothing is shown any more.
  using Show = std::function<void(const Map&)>;

  explicit WantedMap(Show show) : show_(std::move(show)) {}
  ~WantedMap() override;

  // How it is made (never null), for which `make` holds all that it needs; empty: there is none. What was
  // made before is forgotten.
  void set_make(Make make);
  void set_wanted(bool wanted);

 private:
  void follow();

  Show show_;
  Make make_;
  bool wanted_ = false;
  bool shown_ = false;
  Map map_;                             // once it was made
  std::shared_ptr<BackgroundJob> job_;  // while it is made
};

}  // namespace tidemark::engine
