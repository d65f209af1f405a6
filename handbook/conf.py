# The handbook's settings for Sphinx. CMake calls it (handbook/CMakeLists.txt); by hand:
#   sphinx-build -W -b html handbook build/handbook
#   sphinx-build -W -b html -t de -D locale_dirs=COPY handbook build/handbook/de
# in German, where COPY is a copy of handbook/languages: Sphinx writes beside what it reads there.
import re
from pathlib import Path

folder = Path(__file__).resolve().parent

project = "Tidemark"
author = "Tidemark developers"
copyright = author
# The program's own number, from the one place that has it.
release = re.search(r"project\(tidemark VERSION ([0-9.]+)", (folder.parent / "CMakeLists.txt").read_text())[1]
version = release
# Languages beside English have a folder with a file a page. The tag says which of them is made.
languages = sorted(entry.name for entry in (folder / "languages").iterdir() if (entry / "LC_MESSAGES").is_dir())
language = next((one for one in languages if tags.has(one)), "en")
gettext_compact = False
gettext_location = False
words = {
    "en": ["Tidemark handbook", "Version", "Research use only. Not for diagnostic use.", "English"],
    "de": ["Tidemark-Handbuch", "Version", "Nur für die Forschung. Nicht für diagnostische Zwecke.", "Deutsch"],
}
title, version_word, use, own_name = words[language]
# The others: where their first folder lies from this one's, and how they call themselves.
others = [("" if language != "en" else one + "/", words[one][3]) for one in ["en", *languages] if one != language]

extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
# Headings down to this level can be linked to, under the names that GitHub gives them.
myst_heading_anchors = 3
exclude_patterns = ["README.md", "languages"]
pygments_style = "friendly"
# JSON of the pages has "..." where something is left out; nothing else is coloured.
highlight_language = "none"

html_theme = "basic"
html_title = f"{title} {release}"
html_short_title = title
html_static_path = ["look/handbook.css"]
html_css_files = ["handbook.css"]
html_favicon = "../resources/icons/tidemark.svg"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_domain_indices = False
html_use_index = False
html_sidebars = {"**": ["searchbox.html", "chapters.html"]}
html_context = {"html_short_title": title, "version_word": version_word, "use": use, "others": others}
templates_path = ["look"]
