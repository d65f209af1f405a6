// The drives of a session: those that its recipe and its history's recipes name, and what is wanted beside.
#pragma once

#include <functional>

#include "document/session_contents.h"

namespace tidemark::document {

// Each drive once, those of the session's own recipe first.
void visit_drives(const SessionContents& contents, const std::function<void(const Drive&)>& visit);
// Of each drive a changed copy. What several places share they still share.
void change_drives(SessionContents& contents, const std::function<void(Drive&)>& change);

}  // namespace tidemark::document
