#!/usr/bin/env python3
"""Texts of the handbook, from its pages into the languages' files beside this one.

  handbook/languages/collect.py                           adds new texts with an empty translation, and removes those that are gone
  handbook/languages/collect.py --check [SPHINX_BUILD]    writes nothing; fails where a text is not translated, or badly

A file is a page's in the format of gettext (LANGUAGE/LC_MESSAGES/PAGE.po), which Sphinx reads. What the program shows
is called as the program's own translation calls it (resources/languages). Needs Sphinx. docs/how-to/translate.md
"""
import collections
import json
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
BOOK = HERE.parent
PROGRAM = BOOK.parent / "resources/languages"
IN_ENGLISH = ("conformance",)  # as DICOM's own statements are
HEADER = 'msgid ""\nmsgstr "Content-Type: text/plain; charset=UTF-8\\nLanguage: {}\\n"\n'


def read(file):
    """Of a file of gettext: English text, translation."""
    texts, key = {}, None
    for line in file.read_text(encoding="utf-8").splitlines():
        found = re.match(r'(msgid |msgstr )?(".*")$', line)
        if not found:
            continue
        word, piece = found[1], json.loads(found[2])
        if word == "msgid ":
            key, of_key = piece, True
        elif word == "msgstr ":
            texts[key], of_key = piece, False
        elif of_key:
            key += piece
        else:
            texts[key] += piece
    texts.pop("", None)
    return texts


def write(file, language, texts):
    file.parent.mkdir(parents=True, exist_ok=True)
    quoted = lambda text: json.dumps(text, ensure_ascii=False)
    entries = [f"msgid {quoted(text)}\nmsgstr {quoted(texts[text])}\n" for text in texts]
    file.write_text("\n".join([HEADER.format(language), *entries]), encoding="utf-8")


def has_words(text):
    return re.search(r"[^\W\d_]{2}", re.sub(r"`[^`]*`|\]\([^)]*\)", "", text)) is not None


def pages(sphinx):
    """Of each page its texts, in their order."""
    with tempfile.TemporaryDirectory() as folder:
        built = subprocess.run([sphinx, "-q", "-b", "gettext", "-d", f"{folder}/trees", BOOK, f"{folder}/out"],
                               capture_output=True, text=True)
        if built.returncode:
            sys.exit(f"collect.py: Sphinx fails:\n{built.stderr}")
        out = pathlib.Path(folder) / "out"
        found = {file.relative_to(out).with_suffix(""): read(file) for file in sorted(out.rglob("*.pot"))}
    return {page: [text for text in texts if has_words(text)] for page, texts in found.items()
            if str(page) not in IN_ENGLISH}


def shown_by_program(language):
    """What the program shows: English, translations, all as users read them."""
    plain = lambda text: re.sub(r"\(&.\)", "", text).replace("&", "").rstrip("…")
    shown = collections.defaultdict(set)  # a menu and a panel may have one name in English
    for text, own in json.loads((PROGRAM / f"{language}.json").read_text()).items():
        for form in own if isinstance(own, list) else [own]:
            shown[plain(text)].add(plain(form))
    return shown


def spans(pattern, text):
    return collections.Counter(re.findall(pattern, text))


def fault(text, own, shown):
    """What is wrong with a translation; empty: nothing."""
    if not own:
        return "is not translated"
    for what, pattern in (("code", r"`[^`]+`"), ("link", r"\]\([^)]*\)")):
        if spans(pattern, text) != spans(pattern, own):
            return f"has not the same {what}"
    emphasised = r"(?<!\*)\*([^*]+)\*(?!\*)"
    for name in re.findall(emphasised, text):
        if name in shown and shown[name].isdisjoint(re.findall(emphasised, own)):
            return f"calls *{name}* other than the program: {', '.join(sorted(shown[name]))}"
    return ""


def main():
    check = sys.argv[1:2] == ["--check"]
    faults = []
    found = pages(sys.argv[2] if check and len(sys.argv) > 2 else "sphinx-build")
    for folder in sorted(HERE.iterdir()):
        language = folder.name
        if not folder.is_dir() or language.startswith("_"):
            continue
        shown = shown_by_program(language)
        files = {file.relative_to(folder / "LC_MESSAGES").with_suffix(""): file for file in folder.rglob("*.po")}
        for page in sorted(found.keys() | files.keys()):
            file = folder / "LC_MESSAGES" / f"{page}.po"
            known = read(file) if page in files else {}
            texts = {text: known.get(text, "") for text in found.get(page, [])}
            where = file.relative_to(BOOK)
            faults += [f"{where}: '{text[:60]}' is on no page" for text in known if text not in texts]
            reasons = {text: fault(text, own, shown) for text, own in texts.items()}
            faults += [f"{where}: '{text[:60]}' {reason}" for text, reason in reasons.items() if reason]
            if not check and texts:
                write(file, language, texts)
            elif not check:
                file.unlink()
    if check and faults:
        print("\n".join(faults))
        sys.exit(1)


if __name__ == "__main__":
    main()
