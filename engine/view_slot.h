// The slot between a view, which asks for a picture, and the engine, which draws it.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "engine/picture_feed.h"
#include "engine/view_textures.h"
#include "engine/weak_receiver.h"
#include "renderer/quality_control.h"

namespace tidemark::engine {

struct ViewSlot {
  struct Wish {
    AnyView view;
    renderer::PictureSize size;
    std::shared_ptr<const document::Labels> labels;  // in place of the case's; null: those
    bool operator==(const Wish&) const = default;
  };

  std::shared_ptr<WeakReceiver> weak_receiver;
  std::function<void()> take;  // called through weak_receiver when there is a picture

  std::mutex mutex;                    // of the next four
  std::optional<Wish> wish;            // the newest; none before the first
  bool wish_is_new = false;            // since it was last drawn
  bool seen = false;                   // somebody sees the view; else nothing is drawn
  ShownPicture finished;               // what the engine drew last
  std::atomic<bool> waiting{false};    // a job to draw it is in the queue
  std::atomic<bool> refining{false};   // and one to draw it better
  std::atomic<bool> announced{false};  // the user interface knows of `finished`, and has not taken it

  // On the engine's thread alone.
  renderer::QualityControl quality;
  renderer::PictureMean mean;              // of pictures that are read back
  std::shared_ptr<ViewTextures> textures;  // of those that are not, when first needed
  std::int64_t drawn_phi = -1;             // revision of phi that was last drawn
  std::uint64_t drawn_look = 0;            // revision of labels and parameters
  std::int64_t drawn_advance = -1;         // how often steps had been computed when it was last drawn
  std::uint64_t pictures = 0;
};

}  // namespace tidemark::engine
