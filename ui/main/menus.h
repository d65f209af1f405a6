// The menu bar.
#pragma once

#include "ui/main/actions.h"

namespace tidemark::ui {

class MainWindow;
class PanelDocks;
class RecentStudies;

struct MenuParts {
  RecentStudies* recent;
  PanelDocks* panels;
};
void make_tool_bar(MainWindow& window, Actions& actions);
void make_menus(MainWindow& window, Actions& actions, const MenuParts& parts);

}  // namespace tidemark::ui
