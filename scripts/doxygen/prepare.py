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
PAGES = ["README.md", "apps/examples/README.md", "ceres_ed/**/README.md", "data/README.md"]


def source_names():
    """Names of all files of the repository, without their folders."""
    names = set()
    for folder, subfolders, files in os.walk("."):
        subfolders[:] = [name for name in subfolders if name not in (".git", "build")]
        names.update(files)
    return names


def missing_files(text, path, names):
    """Returns a warning for each file that a comment names and that is not in `names`."""
    warnings = []
    for number, line in enumerate(text.split("\n"), 1):
        comment = line.partition("//")[2]
        for name in re.findall(r"[\w/]+\.(?:h|cc|py)\b", comment):
            if os.path.basename(name) not in names:
                warnings.append(f"{path}:{number}: warning: there is no file {name}")
    return warnings


def write(patterns, folder, convert):
    """Writes `convert(text, path)` of every file that the patterns find."""
    for pattern in patterns:
        for path in sorted(glob.glob(pattern, recursive=True)):
            if path.startswith(PRIVATE) and path.endswith(".h"):
                continue
            with open(path, encoding="utf-8") as file:
                text = convert(file.read(), path)
            os.makedirs(os.path.dirname(os.path.join(folder, path)), exist_ok=True)
            with open(os.path.join(folder, path), "w", encoding="utf-8") as file:
                file.write(text)


def main():
    """Writes all of it afresh; returns warnings."""
    folder = sys.argv[1]
    shutil.rmtree(folder, ignore_errors=True)
    names = source_names()
    warnings = []

    def header(text, path):
        warnings.extend(missing_files(text, path, names))
        return convert_header(text, path)

    def page(text, path):
        warnings.extend(missing_links(text, path))
        return convert_page(text, path)

    write(HEADERS, folder, header)
    write(PAGES, folder, page)
    return "\n".join(warnings)


if __name__ == "__main__":
    sys.exit(main() or 0)
