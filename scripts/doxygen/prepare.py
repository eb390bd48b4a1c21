#!/usr/bin/env python3
"""Writes what Doxygen reads: prepare.py FOLDER. Run in the root.

Public headers with their `//` comments as documentation, and the pages beside them, at the same
paths and lines below FOLDER. Fails where a comment or a link names a file that isn't there: Doxygen
would not say so.
"""

import glob
import os
import re
import shutil
import sys

from headers import convert_header
from pages import PRIVATE, convert_page, missing_links

HEADERS = ["ceres_ed/**/*.h", "cost_functions/*.h"]


def source_files():
    """Paths of all files of the repository."""
    paths = []
    for folder, subfolders, files in os.walk("."):
        subfolders[:] = [name for name in subfolders
                         if name != "build" and (name == ".github" or not name.startswith("."))]
        paths += [os.path.relpath(os.path.join(folder, name)) for name in files]
    return sorted(paths)


def missing_files(text, path, names):
    """Returns a warning for each file that a comment names and that is not in `names`."""
    warnings = []
    for number, line in enumerate(text.split("\n"), 1):
        comment = line.partition("//")[2]
        for name in re.findall(r"[\w/]+\.(?:h|cc|py)\b", comment):
            if os.path.basename(name) not in names:
                warnings.append(f"{path}:{number}: warning: there is no file {name}")
    return warnings


def find_headers():
    """Paths of the headers that get pages."""
    paths = {path for pattern in HEADERS for path in glob.glob(pattern, recursive=True)}
    return sorted(path for path in paths if not path.startswith(PRIVATE))


def write(paths, folder, convert):
    """Writes `convert(text, path)` of every file."""
    for path in paths:
        with open(path, encoding="utf-8") as file:
            text = convert(file.read(), path)
        # Doxygen passes over hidden folders.
        copy = os.path.join(folder, path.lstrip("."))
        os.makedirs(os.path.dirname(copy), exist_ok=True)
        with open(copy, "w", encoding="utf-8") as file:
            file.write(text)


def main():
    """Writes all of it afresh; returns warnings."""
    folder = sys.argv[1]
    shutil.rmtree(folder, ignore_errors=True)
    files = source_files()
    names = {os.path.basename(path) for path in files}
    warnings = []

    def header(text, path):
        warnings.extend(missing_files(text, path, names))
        return convert_header(text, path)

    def page(text, path):
        warnings.extend(missing_links(text, path))
        return convert_page(text, path)

    write(find_headers(), folder, header)
    write([path for path in files if path.endswith(".md")], folder, page)
    return "\n".join(warnings)


if __name__ == "__main__":
    sys.exit(main() or 0)
