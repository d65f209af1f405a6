// All widgets, drawn anew after another font or palette of the application.
#pragma once

namespace tidemark::ui {

// Widgets under a style sheet take either only when they are polished again, and a window has more than a
// thousand of them: those that are seen come first, the others in the turns of the event loop after that.
void polish_again();

}  // namespace tidemark::ui
