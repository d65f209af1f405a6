// The way from a PACS to a case.
#pragma once

namespace tidemark::ui {

class MainWindow;
class QueryDialog;

// Shows the window's one query dialog, and opens the series that it brings.
QueryDialog& query_server(MainWindow& window);

}  // namespace tidemark::ui
