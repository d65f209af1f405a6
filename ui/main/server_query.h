// The way from a PACS to a case.
#pragma once

namespace tidemark {

class MainWindow;

// Shows the window's one query dialog; what it brings is opened.
void query_server(MainWindow& window);

}  // namespace tidemark
