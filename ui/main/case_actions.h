// The actions that are about a case, and what they do.
#pragma once

namespace tidemark::ui {

class MainWindow;

// They act on the active case, and do nothing where there is none. Tools are chosen for all cases.
void connect_case_actions(MainWindow& window);

}  // namespace tidemark::ui
