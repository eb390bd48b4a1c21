#!/usr/bin/env python3
"""Every code block of the pages is compiled or run: C++ and CMake blocks are parts of files that are
built, shell blocks are run here. What pages.py calls a mark says which; a block without one fails,
unless it is of the shell.

With --update, blocks that show a whole file get its present text.
"""

import argparse
import os
import re
import subprocess
import sys

from pages import CODE, PROSE, find_pages, read_blocks
from shell import make_root, missing_line, run

# Pages that have a test of their own: the language of the blocks that it runs, and its name.
OWN_TESTS = {"ceres_ed/python/README.md": {"python": "python.readme"}}
# Files that no target compiles as they stand, but that a test builds as a project.
PROJECTS = {"apps/examples/consumer": "install.consumer"}


class Checker:
    """Checks pages one by one, and keeps what is wrong."""

    def __init__(self, source, work, programs, provided, compiled, tests, left_out=()):
        """`compiled`: text of compile_commands.json; `provided`: files by their paths in `work`.

        `left_out`: how names of tests begin that this build does not have.
        """
        self._source = source
        self._work = work
        self._programs = programs
        self._provided = provided
        self._compiled = compiled
        self._tests = tests
        self._left_out = tuple(left_out)
        self.errors = []
        self.counts = {}
        self.not_run = {}
        self._printed = ""

    def check(self, page):
        """Checks the blocks of a page, the shell's in their order and in one folder."""
        folder = os.path.join(self._work, page[: -len(".md")].replace("/", "_"))
        make_root(folder, self._source, self._provided)
        self._printed = ""
        for block in read_blocks(read(os.path.join(self._source, page)), page):
            problem = self._check_block(block, folder)
            if problem:
                self.errors.append(f"{block.place()}: {problem}")
            kind = block.mark or ("run" if block.language == "sh" else "no code")
            self.counts[kind] = self.counts.get(kind, 0) + 1

    def _check_block(self, block, folder):
        """Returns what is wrong with a block; empty: nothing."""
        own_test = OWN_TESTS.get(block.page, {}).get(block.language)
        if block.mark == "not run":
            self.not_run[block.place()] = block.value
            return "" if block.value else "no reason why it is not run"
        if block.mark == "tested by" or own_test:
            return self._check_test(block.value or own_test)
        if block.mark == "file":
            return self._check_file(block)
        if block.mark == "prints" and block.text.strip() == "":
            return "says of nothing that it is printed"
        if block.mark == "prints":
            line = missing_line(block.text, self._printed)
            return "" if line is None else f"not printed: {line}"
        if block.language == "sh":
            self._printed, problem = run(block, folder, self._programs)
            return problem
        if block.language == "":
            return "code, give it a fence and a language" if CODE.search(block.text) else ""
        if block.language in PROSE:
            return ""
        return "nothing covers it (see test/docs/pages.py for the comments that do)"

    def _check_test(self, name):
        there = name in self._tests or name.startswith(self._left_out)
        return "" if there else f"there is no test '{name}'"

    def _check_file(self, block):
        path = os.path.join(self._source, block.value)
        if not os.path.exists(path):
            return f"{block.value} isn't there"
        text = read(path)
        if re.search(r"^int main\(", block.text, re.M) and text != block.text:
            return f"differs from {block.value}; --update brings it up to date"
        if "\n" + block.text not in "\n" + text:
            return f"not in {block.value}, line for line"
        if block.value.endswith(".cc") and f'/{block.value}"' in self._compiled:
            return ""
        test = PROJECTS.get(os.path.dirname(block.value))
        return self._check_test(test) if test else f"{block.value} is not compiled"


def read(path):
    """The text of a file."""
    with open(path, encoding="utf-8") as file:
        return file.read()


def list_tests(build):
    """The names of the tests of a build."""
    listing = subprocess.run(["ctest", "-N"], cwd=build, stdout=subprocess.PIPE, text=True,
                             check=True).stdout
    return re.findall(r"Test +#\d+: (\S+)", listing)


def update(source, page):
    """Puts the present text of files into the blocks of a page that show all of them, or nothing."""
    text = read(os.path.join(source, page))
    lines = text.split("\n")
    for block in reversed(read_blocks(text, page)):
        path = os.path.join(source, block.value)
        if block.mark != "file" or not os.path.exists(path):
            continue
        whole = read(path).rstrip("\n").split("\n")
        shown = block.text.rstrip("\n").split("\n")
        begin = block.line - 1
        if shown[0] in ("", whole[0]):
            end = lines.index("```", begin)
            lines[begin:end] = whole
    with open(os.path.join(source, page), "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


def main():
    """Returns 0 when every block is covered and right."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--source", default=".", help="root of the repository")
    parser.add_argument("--work", default="build/docs_code", help="where blocks are run")
    parser.add_argument("--build", default="build/release", help="folder of the build")
    parser.add_argument("--provide", action="append", default=[], metavar="PATH=FILE",
                        help="FILE is there at PATH when blocks are run")
    parser.add_argument("--left-out", action="append", default=[], metavar="PREFIX",
                        help="the build has no tests whose names begin so")
    parser.add_argument("--update", action="store_true", help="renew blocks that show whole files")
    parser.add_argument("pages", nargs="*", help="pages to check, default all")
    arguments = parser.parse_args()
    pages = arguments.pages or find_pages(arguments.source)
    if arguments.update:
        for page in pages:
            update(arguments.source, page)
        return 0
    checker = Checker(arguments.source, arguments.work,
                      [os.path.abspath(os.path.join(arguments.build, "apps"))],
                      dict(pair.split("=", 1) for pair in arguments.provide),
                      read(os.path.join(arguments.build, "compile_commands.json")),
                      list_tests(arguments.build), arguments.left_out)
    for page in pages:
        checker.check(page)
    for place, reason in checker.not_run.items():
        print(f"not run: {place}: {reason}")
    print(f"{len(pages)} pages, blocks:", ", ".join(f"{n} {kind}" for kind, n in checker.counts.items()))
    for error in checker.errors:
        print(error, file=sys.stderr)
    return 1 if checker.errors or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
