#!/usr/bin/env python3
"""Writes what Doxygen reads: prepare.py FOLDER. Run in the root.

Public headers with their `//` comments as documentation, and the pages beside them, at the same
paths and lines below FOLDER.
"""

import glob
import os
import shutil
import sys

from headers import convert_header
from pages import convert_page

HEADERS = ["ceres_ed/**/*.h", "cost_functions/*.h"]
PAGES = ["README.md", "apps/examples/README.md", "ceres_ed/**/README.md", "data/README.md"]


def write(patterns, folder, convert):
    """Writes `convert(text, path)` of every file that the patterns find."""
    for pattern in patterns:
        for path in sorted(glob.glob(pattern, recursive=True)):
            with open(path, encoding="utf-8") as file:
                text = convert(file.read(), path)
            os.makedirs(os.path.dirname(os.path.join(folder, path)), exist_ok=True)
            with open(os.path.join(folder, path), "w", encoding="utf-8") as file:
                file.write(text)


def main():
    """Writes all of it afresh."""
    folder = sys.argv[1]
    shutil.rmtree(folder, ignore_errors=True)
    write(HEADERS, folder, convert_header)
    write(PAGES, folder, convert_page)


if __name__ == "__main__":
    main()
