// A panel's memory of each case while it shows others.
#pragma once

#include <QObject>
#include <map>

namespace tidemark::ui {

// By the case, or what lives as long as it; forgotten when that is gone. Its connections are its own: those
// of a panel to a case end when the panel shows another one.
template <class Kept>
class PerCase : public QObject {
 public:
  // Null: nothing is kept.
  [[nodiscard]] const Kept* find(const QObject* of) const {
    const auto found = kept_.find(of);
    return found == kept_.end() ? nullptr : &found->second;
  }
  // Made when it is asked for first.
  Kept& operator[](QObject& of) {
    const auto [place, is_new] = kept_.try_emplace(&of);
    if (is_new) connect(&of, &QObject::destroyed, this, [this](const QObject* gone) { kept_.erase(gone); });
    return place->second;
  }

 private:
  std::map<const QObject*, Kept> kept_;
};

}  // namespace tidemark::ui
