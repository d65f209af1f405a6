// The synthetic studies in words.
#pragma once

#include <QString>
#include <string_view>

namespace tidemark::engine {

// The name of a kind of phantom_kinds(), and one sentence on what it shows.
struct PhantomText {
  QString title;
  QString sentence;
};
PhantomText phantom_text(std::string_view kind);

}  // namespace tidemark::engine
