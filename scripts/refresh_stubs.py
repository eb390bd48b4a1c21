#!/usr/bin/env python3
"""Brings the options in the Python stubs up to date with the module.

  scripts/refresh_stubs.py [BUILD FOLDER (build/release)]

The module has an attribute for each row of an Options struct (ceres_ed/util/options.h). The stubs
repeat them in three places: as attributes, as keywords of the class, and as keywords of the
functions that take them.
"""
import importlib
import re
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STUB = ROOT / "ceres_ed" / "python" / "ceres_ed" / "_core.pyi"
COLUMNS = 100
# A class of options, and the functions that take them as keywords: of a class, or of the module.
USERS = {"FieldOptions": [("Warp", "field"), ("Warp", "write_field")],
         "GraphOptions": [("Graph", "build")],
         "FitOptions": [(None, "fit"), ("SurfaceFitter", "__init__")],
         "TrackerOptions": [("Tracker", "__init__")],
         "SequenceOptions": [(None, "open_sequence")]}


def aliases(text):
    """Returns {names of an enum: name of its type} of the types at the top of the stubs."""
    found = re.findall(r'^(\w+) = Literal\[([^]]*)\]$', text, re.MULTILINE)
    return {frozenset(re.findall(r'"(\w+)"', names)): alias for alias, names in found}


def type_of(kind, name, known):
    """Returns the type of an option, by its default and, of an enum, by the names in its text."""
    value = getattr(kind(), name)
    if not isinstance(value, str):
        return type(value).__name__
    listed = re.search(r" One of ('\w+'(?:, '\w+')*)\.", getattr(kind, name).__doc__)
    if listed is None:
        return "str"
    names = re.findall(r"'(\w+)'", listed.group(1))
    return known.get(frozenset(names)) or "Literal[" + ", ".join(f'"{n}"' for n in names) + "]"


def keyword_types(kind, options):
    """Returns the types of keywords: a number may also be given by the word for a special value."""
    return {name: "Threads" if name == "threads" and name in kind.words
            else f'Union[{value}, Literal["{kind.words[name]}"]]' if name in kind.words else value
            for name, value in options.items()}


def options_of(kind, known):
    return {name: type_of(kind, name, known) for name in kind.names}


def parameters(text):
    """Splits the parameters of a function at its own commas."""
    pieces, depth = [""], 0
    for char in text:
        depth += (char in "[(") - (char in "])")
        if char == "," and depth == 0:
            pieces.append("")
        else:
            pieces[-1] += char
    return [" ".join(piece.split()) for piece in pieces]


def with_keywords(block, function, options, old_names):
    """Returns `block` with the keywords of its function replaced by `options`."""
    pattern = re.compile(rf"^( *)def {function}\((.*?)\) -> (.*?): \.\.\.$",
                         re.MULTILINE | re.DOTALL)
    match = pattern.search(block)
    indent, text, result = match.groups()
    own = [piece for piece in parameters(text)
           if re.split(r"[:=]", piece)[0].strip() not in old_names]
    own += [f"{name}: {kind} = ..." for name, kind in options.items()]
    # Lines break between parameters: inside of one a space is a hard one while they are wrapped.
    words = " ".join(piece.replace(" ", "\xa0") for piece in [
        *(f"{piece}," for piece in own[:-1]), f"{own[-1]}) -> {result}: ..."])
    lines = textwrap.wrap(words, COLUMNS - len(indent) - 8, break_long_words=False,
                          break_on_hyphens=False)
    body = ("\n" + indent + " " * 8).join(lines).replace("\xa0", " ")
    return block[:match.start()] + f"{indent}def {function}(\n{indent}        {body}" + \
        block[match.end():]


def replace_block(text, start, change):
    """Changes the text from `start` up to the next name of the module."""
    begin = text.index("\n" + start) + 1
    end = re.compile(r"^(?=\S)", re.MULTILINE).search(text, begin + len(start))
    end = end.start() if end else len(text)
    return text[:begin] + change(text[begin:end]) + text[end:]


def refreshed(text, module):
    """Returns the stubs with the options of the module."""
    known = aliases(text)
    for name, users in USERS.items():
        options = options_of(getattr(module, name), known)
        keywords = keyword_types(getattr(module, name), options)
        body = text[text.index(f"class {name}:"):]
        old_names = set(re.findall(r"^    (\w+): ", body[:body.index("    def __init__")],
                                   re.MULTILINE)) | set(options)

        def change_class(block):
            rows = "".join(f"    {option}: {kind}\n" for option, kind in options.items())
            block = re.sub(r"(    names: ClassVar.*\n)(?:    \w+: .*\n)*", r"\g<1>" + rows, block)
            return with_keywords(block, "__init__", keywords, old_names)

        text = replace_block(text, f"class {name}:", change_class)
        for owner, function in users:
            start = f"class {owner}:" if owner else f"def {function}("
            text = replace_block(
                text, start,
                lambda block, name=function: with_keywords(block, name, keywords, old_names))
    return text


def main():
    build = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build" / "release")
    sys.path.insert(0, str(build / "python"))
    STUB.write_text(refreshed(STUB.read_text(), importlib.import_module("ceres_ed")))
    print(f"refreshed {STUB.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
