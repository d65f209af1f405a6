#!/usr/bin/env python3
"""Texts that users see, from the sources into the languages' files beside this one.

  resources/languages/collect.py            adds new texts with an empty translation, and removes those that are gone
  resources/languages/collect.py --check    writes nothing; fails where a text is not translated, or badly

A file is an object of JSON, in the order of the sources: English text, translation; of a text with a count a list of two
translations, for one thing and for others, and en.json has those alone. docs/how-to/translate.md
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent

# Which arguments of a call are texts.
CALLS = {"tr": {0}, "translate": {1}, "QT_TRANSLATE_NOOP": {1}, "fail": {1}, "progress": {1}, "shared": {2}}
# Languages without a plural: a single translation serves any count.
ONE_FORM = ("ja", "zh_CN")
# Tables of the folders below the user interface, whose texts are shown: members of these names, and columns.
MEMBERS = ("title", "text", "unit")
TABLES = {"document/lesson_figure.cpp": r'^\s+\{"\w+", "[^"]*", "([^"]+)"',
          "document/start.cpp": r'"(nothing|mask|(?:mask|phi) \{\}|within \{\} mm|1 seed|\{\} seeds|1 eraser|\{\} erasers)"',
          "document/cohort/case_status.cpp": r'^\s+return "([a-z ]+)";',
          "imaging/guard/nrrd_layout.cpp": r'"((?:space )?units \'[^"]+)"',
          "imaging/results/segment_meaning.cpp": r'^\s+\{"([a-z-]+)", '}
# Here every text of some words is part of what users are told of a file.
SENTENCES = ("core", "document", "engine", "imaging")
FOLDERS = ("app/desktop", "ui", "gpu", "renderer", "solver") + SENTENCES
NO_SENTENCES = ("document/change.cpp", "document/cohort/", "document/drive.cpp", "document/measure_codes.cpp",
                "imaging/guard/dicom/transfer_syntaxes.cpp",
                "imaging/deidentify/method_codes.cpp", "imaging/guard/nrrd_layout.cpp",
                "imaging/results/segment_meaning.cpp", "imaging/surface/write_mesh.cpp")

TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"([^(]*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)+\'|\w+|.', re.S)
ESCAPE = re.compile(r"\\(x[0-9a-fA-F]+|u[0-9a-fA-F]{4}|.)")
ESCAPED = {"n": "\n", "t": "\t", "r": "\r", "0": "\0", '"': '"', "\\": "\\", "'": "'"}
VALUE = re.compile(r"\{[^}]*\}")
PLACE = re.compile(r"%(?:L?\d+|n)")


def unescaped(literal):
    return ESCAPE.sub(lambda m: ESCAPED.get(m[1]) or chr(int(m[1][1:], 16)), literal)


def tokens_of(source):
    tokens = (m[0] for m in TOKEN.finditer(source))
    return [token for token in tokens if not token.isspace() and not token.startswith(("//", "/*"))]


def joined(tokens, i):
    """Literals that stand side by side are one; with the place behind them."""
    text = ""
    while i < len(tokens) and tokens[i].startswith('"'):
        text += unescaped(tokens[i][1:-1])
        i += 1
    return text, i


def arguments(tokens, i, wanted):
    """The texts of the wanted arguments of the call whose first argument begins at i; with their number."""
    found = []
    depth, argument = 1, 0
    while i < len(tokens) and depth:
        token = tokens[i]
        if token.startswith('"'):
            text, i = joined(tokens, i)
            if argument in wanted:
                found.append(text)
            continue
        depth += (token in "([{") - (token in ")]}")
        argument += token == "," and depth == 1
        i += 1
    return found, argument + 1


def marked(tokens, counted):
    """Texts that a call or a table marks as such. Those with a count go into `counted` too."""
    found = []
    for i, token in enumerate(tokens):
        if token in CALLS and tokens[i + 1:i + 2] == ["("]:
            texts, number = arguments(tokens, i + 2, CALLS[token])
            found += texts
            if token == "tr" and number > 1:
                counted.update(texts)
        elif token in MEMBERS and i > 0 and tokens[i - 1] == "." and tokens[i + 1:i + 2] == ["="]:
            found.append(joined(tokens, i + 2)[0])
    return found


def sentences(tokens):
    """All texts of three words, of two with a value, or of two that say what work does."""
    found = []
    i = 0
    while i < len(tokens):
        if not tokens[i].startswith('"'):
            i += 1
            continue
        text, i = joined(tokens, i)
        words = re.findall(r"(?<![\w{:])[A-Za-z]*[a-z]{2,}(?![\w(])", text)
        if " " in text.strip() and "\n" not in text and (len(words) >= (2 if "{" in text else 3) or re.match(r"\w+ing \w+$", text)):
            found.append(text)
    return found


def lesson_texts(lesson):
    """What students read, in the order of the file."""
    found = []
    for key, value in lesson.items() if isinstance(lesson, dict) else enumerate(lesson):
        if key == "choices":
            found += value
        elif isinstance(value, (dict, list)):
            found += lesson_texts(value)
        elif key in ("title", "about", "text", "explanation"):
            found.append(value)
    return found


def collected():
    """The texts in the order of the sources, each once, and those of them that have a count."""
    texts, counted = {}, set()
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in (".cpp", ".h"):
                continue
            source = path.read_text(encoding="utf-8")
            name = str(path.relative_to(ROOT))
            tokens = tokens_of(source)
            found = marked(tokens, counted) + re.findall(TABLES.get(name, r"(?!)"), source, re.M)
            if folder in SENTENCES and not name.startswith(NO_SENTENCES):
                found += sentences(tokens)
            for text in found:
                if re.search(r"[^\W\d_]{2}", PLACE.sub("", VALUE.sub("", text))):
                    texts.setdefault(text, name)
    for path in sorted((ROOT / "resources/lessons").glob("*.json")):
        for text in lesson_texts(json.loads(path.read_text(encoding="utf-8"))):
            texts.setdefault(text, str(path.relative_to(ROOT)))
    return texts, counted


def problem(english, translation, forms):
    """What is wrong with a translation that should have so many forms, or None."""
    if not translation:
        return "is not translated"
    if forms > 1 or isinstance(translation, list):
        if not isinstance(translation, list) or len(translation) != forms:
            return f"has other than {forms} forms"
        return next(filter(None, (problem(english, form, 1) for form in translation)), None)
    if sorted(PLACE.findall(english)) != sorted(PLACE.findall(translation)):
        return "has other places for values (%1)"
    values = VALUE.findall(translation)
    numbered = [re.match(r"\{\d", value) is not None for value in values]
    if (any(numbered) and not all(numbered)) or (not any(numbered) and len(values) != len(VALUE.findall(english))):
        return "has other places for values ({})"
    key = re.compile(r"&(?=[^\s&;#]+(?:[^;]|$))")
    is_menu_entry = not re.search(r"<|&\w+;", english)
    if is_menu_entry and bool(key.search(english)) != bool(key.search(translation)):
        return "has a menu letter where the English has none, or none where it has one"
    if re.findall(r"</?\w+", english) != re.findall(r"</?\w+", translation):
        return "has other tags"
    if english.count("(*") != translation.count("(*") or english.count(";;") != translation.count(";;"):
        return "names other kinds of files"
    return None


def main():
    all_texts, counted = collected()
    failed = False
    for path in sorted(HERE.glob("*.json")):
        known = json.loads(path.read_text(encoding="utf-8"))
        texts = [text for text in all_texts if text in counted] if path.stem == "en" else all_texts
        if sys.argv[1:] == ["--check"]:
            problems = [(text, problem(text, known.get(text), 2 if text in counted and path.stem not in ONE_FORM else 1)) for text in texts]
            problems += [(text, "is no text of the program") for text in known if text not in texts]
            for text, what in problems:
                if what:
                    print(f"{path.name}: {text!r} {what}")
                    failed = True
        else:
            now = {text: known.get(text, "") for text in texts}
            lines = (f"{json.dumps(text, ensure_ascii=False)}: {json.dumps(own, ensure_ascii=False)}" for text, own in now.items())
            path.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
            print(f"{path.name}: {len(now)} texts, {sum(not one for one in now.values())} not translated")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
