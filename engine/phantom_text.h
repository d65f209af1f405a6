// The synthetic studies in words.
#pragma once

#include <QString>
#include <string_view>

namespace tidemark::engine {

// The title of a phantom by its name (imaging::parse_phantom_name), and one sentence on what it shows.
struct PhantomText {
  QString title;
  QString sentence;
};
PhantomText phantom_text(std::string_view name);

}  // namespace tidemark::engine
