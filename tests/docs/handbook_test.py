#!/usr/bin/env python3
"""handbook_test.py SOURCE [SPHINX_BUILD]

Holds the handbook to the program and to itself: every panel has a page under its key and no page is of none, every page
is in the contents, every link within handbook, docs and the pages at the top leads somewhere, every picture is used and
small. With SPHINX_BUILD it also builds the HTML in each language, with warnings as errors, follows every link from its first
page, and looks for texts that are not translated.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse
from html.parser import HTMLParser
from pathlib import Path

source = Path(sys.argv[1]).resolve()
book = source / "handbook"
faults = []

LARGEST_PICTURE = 160_000
ALL_PICTURES = 4_000_000  # of a language


def words_of(heading):
    """The anchor that GitHub and MyST make of a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    text = re.sub(r"[^\w\- ]", "", text)
    return text.replace(" ", "-")


def without_code(text):
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    return re.sub(r"`[^`\n]*`", "", text)


def anchors(page):
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S)
    return {words_of(line.lstrip("#").replace("`", "")) for line in text.splitlines() if re.match(r"#+ ", line)}


def check_panels():
    docks = (source / "ui/main/panel_docks.cpp").read_text()
    keys = set(re.findall(r'\badd\("([a-z-]+)", tr\(', docks))
    for file in ["teaching", "cohort_review"]:
        text = (source / f"ui/main/{file}.cpp").read_text()
        keys |= set(re.findall(r'make_side_dock\(window_, "([a-z-]+)"', text))
    if len(keys) < 10 or "lesson" not in keys:
        faults.append(f"few panels found in the code: {sorted(keys)}")
    pages = {page.stem for page in (book / "panels").glob("*.md")}
    for key in sorted(keys ^ pages):
        faults.append(f"panels/{key}.md: {'there is no such panel' if key in pages else 'is missing'}")


def check_contents():
    entries = re.findall(r"^[a-z][a-z/-]*$", (book / "index.md").read_text(), flags=re.M)
    pages = {str(page.relative_to(book))[:-3] for page in book.rglob("*.md")} - {"index"}
    for page in sorted(pages ^ set(entries)):
        faults.append(f"index.md: {page} is {'not in the contents' if page in pages else 'no page'}")
    for page in re.findall(r'QStringLiteral\("([a-z-]+)"\)', (source / "ui/main/help.cpp").read_text()):
        if page not in pages:
            faults.append(f"ui/main/help.cpp: there is no page {page}")


# "panel-paint.de.png" is shown in German in the place of "panel-paint.png".
def language_of(picture):
    found = re.fullmatch(r".+\.([a-z]{2}(_[A-Z]{2})?)\.png", picture.name)
    return found[1] if found else "en"


def check_links():
    used = set()
    pages = [*book.rglob("*.md"), *(source / "docs").rglob("*.md"), *source.glob("*.md")]
    for page in pages:
        for target in re.findall(r"\]\(([^)\s]+)\)|src=\"([^\"]+)\"", without_code(page.read_text())):
            target = target[0] or target[1]
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            to = (page.parent / name).resolve() if name else page
            where = f"{page.relative_to(source)}: {target}"
            if not to.exists():
                faults.append(f"{where} does not exist")
                continue
            used.add(to)
            if anchor and urllib.parse.unquote(anchor) not in anchors(to):
                faults.append(f"{where}: there is no such heading")
            if page.is_relative_to(book) and not to.is_relative_to(book):
                faults.append(f"{where} leads out of the handbook, which is installed alone")
    pictures = list((book / "pictures").glob("*"))
    for picture in pictures:
        if picture.name.replace(f".{language_of(picture)}.", ".") not in {one.name for one in used}:
            faults.append(f"{picture.relative_to(source)} is on no page")
        if picture.stat().st_size > LARGEST_PICTURE:
            faults.append(f"{picture.relative_to(source)} has {picture.stat().st_size} bytes")
    for language in {language_of(picture) for picture in pictures}:
        if sum(one.stat().st_size for one in pictures if language_of(one) == language) > ALL_PICTURES:
            faults.append(f"handbook/pictures is too large in {language}")


def check_installed():
    """What readers of an installed handbook need: files that they have, and one page for IT."""
    for page in book.rglob("*.md"):
        if page.name != "install.md" and "packaging/" in page.read_text():
            faults.append(f"{page.relative_to(source)} names a file of packaging/, which is not installed")
    for_it = re.search(r"^## A hospital's IT$.*?(?=^## )", (book / "install.md").read_text(), flags=re.M | re.S)
    if not for_it or re.search(r"~/\.", for_it[0]) or "for-it.md#where-data-lie" not in for_it[0]:
        faults.append("install.md: where data lie is for-it.md's to say")


class Links(HTMLParser):
    def __init__(self, page):
        super().__init__()
        self.links, self.ids = [], set()
        self.feed(page.read_text())

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        for name in ("href", "src"):
            # "#" is Sphinx's link to the page itself.
            if attributes.get(name) and attributes[name] != "#":
                self.links.append(attributes[name])
        self.ids |= {attributes[name] for name in ("id", "name") if attributes.get(name)}


def check_html(sphinx):
    with tempfile.TemporaryDirectory() as folder:
        html = Path(folder) / "html"
        # As handbook/CMakeLists.txt does.
        texts = shutil.copytree(book / "languages", Path(folder) / "languages")
        languages = sorted(found.parent.name for found in texts.glob("*/LC_MESSAGES"))
        for language in ["en", *languages]:
            built = subprocess.run([sphinx, "-W", "--keep-going", "-q", "-t", language, "-D", f"locale_dirs={texts}",
                                    "-d", f"{folder}/trees-{language}", "-b", "html", book,
                                    html if language == "en" else html / language], capture_output=True, text=True)
            if built.returncode:
                faults.append(f"sphinx-build ({language}) fails:\n{built.stderr}")
                return
        known, waiting = {}, [html / "index.html"]
        while waiting:
            page = waiting.pop()
            if page in known:
                continue
            known[page] = Links(page)
            for link in known[page].links:
                if re.match(r"[a-z]+:", link):
                    continue
                to = (page.parent / urllib.parse.unquote(link.partition("#")[0].partition("?")[0])).resolve()
                if not to.exists():
                    faults.append(f"{page.name}: {link} does not exist")
                elif to.suffix == ".html":
                    waiting.append(to)
        for page, parsed in known.items():
            for link in parsed.links:
                name, _, anchor = link.partition("#")
                to = (page.parent / name).resolve() if name else page
                if anchor and to in known and urllib.parse.unquote(anchor) not in known[to].ids:
                    faults.append(f"{page.name}: {link}: there is no such place")
        for page in html.rglob("*.html"):
            if page not in known and "_static" not in page.parts:
                faults.append(f"{page.relative_to(html)} cannot be reached from the first page")
        for folder_of_language in [html, *(html / language for language in languages)]:
            if not (folder_of_language / "searchindex.js").exists():
                faults.append(f"{folder_of_language.name}: there is no search")


check_panels()
check_contents()
check_links()
check_installed()
if len(sys.argv) > 2:
    check_html(sys.argv[2])
    collected = subprocess.run([book / "languages/collect.py", "--check", sys.argv[2]], capture_output=True, text=True)
    faults += (collected.stdout + collected.stderr).splitlines()
if faults:
    print("\n".join(faults))
    sys.exit(1)
