// The menu bar.
#pragma once

#include "ui/main/actions.h"

namespace tidemark::ui {

class MainWindow;
class PanelDocks;
class RecentStudies;
class Teaching;

struct MenuParts {
  RecentStudies* recent;
  PanelDocks* panels;
  Teaching* teaching;
};
void make_tool_bar(MainWindow& window, Actions& actions);
void make_menus(MainWindow& window, Actions& actions, const MenuParts& parts);

}  // namespace tidemark::ui
