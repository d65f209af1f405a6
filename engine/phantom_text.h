// The synthetic studies in words.
#pragma once

#include <QString>
#include <string_view>

namespace tidemark {

// How a kind of phantom_kinds() is called and what it shows, in one sentence.
struct PhantomText {
  QString title;
  QString sentence;
};
PhantomText phantom_text(std::string_view kind);

}  // namespace tidemark
