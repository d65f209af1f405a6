# The handbook's settings for Sphinx. CMake calls it (handbook/CMakeLists.txt); by hand:
#   sphinx-build -W -b html handbook build/handbook
import re
from pathlib import Path

folder = Path(__file__).resolve().parent

project = "Tidemark"
author = "Tidemark developers"
copyright = author
# The program's own number, from the one place that has it.
release = re.search(r"project\(tidemark VERSION ([0-9.]+)", (folder.parent / "CMakeLists.txt").read_text())[1]
version = release
language = "en"

extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
# Headings down to this level can be linked to, under the names that GitHub gives them.
myst_heading_anchors = 3
exclude_patterns = ["README.md"]
pygments_style = "friendly"
# JSON of the pages has "..." where something is left out; nothing else is coloured.
highlight_language = "none"

html_theme = "basic"
html_title = f"Tidemark {release}: handbook"
html_short_title = "Tidemark handbook"
html_static_path = ["look/handbook.css"]
html_css_files = ["handbook.css"]
html_favicon = "../resources/icons/tidemark.svg"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_domain_indices = False
html_use_index = False
html_sidebars = {"**": ["searchbox.html", "chapters.html"]}
html_context = {"html_short_title": html_short_title}
templates_path = ["look"]
