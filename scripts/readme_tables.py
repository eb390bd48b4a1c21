#!/usr/bin/env python3
"""Copies columns of the tables in test/benchmark/README.md to the short tables of README.md.

Rows without a truth, so without an error, stay in the long tables.

It writes between the marks `<!-- readme_tables.py: NAME: begin -->` and `... end -->`. With --check it
writes nothing, and exits with 1 if README.md differs.

  scripts/readme_tables.py
  scripts/readme_tables.py --check
"""
import argparse
import sys
from pathlib import Path

from bench_tables import PAGE, check_marks, table, write_between
from program_runs import PROGRAM, ROOT

README = ROOT / "README.md"
# For each short table: the first heading of the table that it is taken from, and the columns that it takes,
# with their new headings.
TABLES = {
    "fits": ("shipped pair", {
        "shipped pair": "pair", "nothing %": "before %", "rigid %": "best rigid %",
        "truth %": "fitted %", "target %": "visible surface %", "s": "seconds"}),
    "tracking": ("sequence", {
        "sequence": "sequence", "frames": "frames", "lost": "lost", "surface mm": "surface mm",
        "seen mm": "visible points mm", "hidden mm": "hidden points mm", "ms": "ms a frame"}),
}


def read_table(page, first_heading):
    """Returns headings and rows of the table whose first heading is this."""
    lines = page.split("\n")
    begin = next(i for i, line in enumerate(lines) if line.startswith(f"| {first_heading} |"))
    rows = []
    for line in lines[begin:]:
        if not line.startswith("|"):
            break
        rows.append([text.strip() for text in line.strip("|").split("|")])
    return rows[0], rows[2:]


def short_table(page, first_heading, columns):
    """Returns the lines of the columns that a short table has."""
    headings, rows = read_table(page, first_heading)
    chosen = [headings.index(heading) for heading in columns]
    short = [[row[i] for i in chosen] for row in rows]
    return table(list(columns.values()), [row for row in short if "-" not in row])


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare, and write nothing")
    check = parser.parse_args().check
    page = PAGE.read_text()
    for name, (first_heading, columns) in TABLES.items():
        begin, end = (f"<!-- readme_tables.py: {name}: {word} -->" for word in ("begin", "end"))
        text = "\n".join(short_table(page, first_heading, columns))
        if not check:
            write_between(README, begin, end, text)
        elif f"{begin}\n{text}\n{end}" not in check_marks(README, begin, end):
            sys.exit(f"{PROGRAM}: the table '{name}' of README.md is not that of "
                     f"{PAGE.relative_to(ROOT)}; scripts/refresh_pages.sh brings it up to date")


if __name__ == "__main__":
    main()
