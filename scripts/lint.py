#!/usr/bin/python3
"""Runs clang-tidy on files of a build: lint.py BUILD_FOLDER [FILE ...]; without files, on all of the build.

Nearly all of clang-tidy's time goes into the headers of Eigen, Ceres and GoogleTest. So the files
of a top folder are checked in units that include many of them, and those headers are read once a unit. Files that
define the same name at namespace scope go into different units. A unit that does not compile all the same is
checked in two halves.
"""
import collections
import concurrent.futures
import functools
import json
import os
import re
import shlex
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FILES_PER_UNIT = 25
# Tests may take the short way where it costs time, and have their process to themselves.
LEFT_OUT = {"test": "-performance-*,-concurrency-*"}
# clang has another default than g++ 12.
OWN_FLAGS = ["-std=gnu++17"]
# The included files are what is checked, and not only the headers.
FILTER = "--header-filter=.*/(apps|ceres_ed|cost_functions|data|test)/.*"
# The code is formatted, so what begins in column 0 is at namespace scope. The name is that before the first of
# ( [ ; = { or the end of the line; the definition of a member has a "::" before it. Tests and flags are macros.
DEFINED = re.compile(
    r"(?:(?:TEST(?:_[FP])?|DEFINE_\w+)\((\w+(?:, *\w+(?=\)))?)"
    r"|(?:#define |(?!#|//|TEST|namespace|return|using namespace)[\w\[][^(={;]*?(?<!::))"
    r"\b([A-Za-z_]\w*)(?: final|)(?:\(|\[\d*\]|;|$| [={:]|\{))"
)


def compile_flags(build):
    """Returns {file: its -I, -isystem and -D flags} from the build's compile_commands.json."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        commands = json.load(file)
    flags = {}
    for command in commands:
        words = shlex.split(command["command"])
        flags.setdefault(command["file"], [
            word if word.startswith("-") else f"-isystem{word}"
            for before, word in zip(words, words[1:])
            if re.match(r"-I|-D(?!\w+_EXPORTS$)", word) or before == "-isystem"
        ])
    return flags


def is_for_clang(path):
    """Returns whether clang can compile a file. Debian's headers of ITK refuse any compiler but g++."""
    with open(path, encoding="utf-8") as file:
        return "#include <itk" not in file.read()


@functools.lru_cache(None)
def names_of(path):
    """Returns the names that a file defines at namespace scope, and those of the tests' headers that it includes."""
    own = set()
    included = set()
    with open(path, encoding="utf-8") as file:
        for line in file:
            if re.search(r"\bCERES_ED_PLUGIN(_ABI_SYMBOL)?\(", line):
                own.add("CERES_ED_PLUGIN")
            if match := DEFINED.match(line):
                own.add(match[1] or match[2])
            elif match := re.match(r"#include <(test/.*)>", line):
                included.update(*names_of(os.path.join(ROOT, match[1])))
    return own, included


class Unit:
    """Files that are checked together, and what they are compiled with."""

    def __init__(self):
        self.files = []
        self.own_names = set()
        self.included_names = set()
        self.flags = {}

    def take(self, path, flags):
        """Adds a file, unless it does not go with those that are there. Returns whether it did."""
        values = {flag.split("=")[0]: flag for flag in flags}
        own, included = names_of(path)
        if len(self.files) == FILES_PER_UNIT:
            return False
        if own & (self.own_names | self.included_names) or included & self.own_names:
            return False
        if any(self.flags.get(key, flag) != flag for key, flag in values.items()):
            return False
        self.files.append(path)
        self.own_names |= own
        self.included_names |= included
        self.flags.update(values)
        return True


def make_units(flags):
    """Returns units of all files in {file: flags}, large ones first."""
    begun = collections.defaultdict(list)
    for path in sorted(flags):
        units = begun[os.path.relpath(path, ROOT).split(os.sep)[0]]
        units.append(Unit())
        next(unit for unit in units if unit.take(path, flags[path]))
        if not units[-1].files:
            units.pop()
    return sorted((unit for units in begun.values() for unit in units), key=lambda unit: -len(unit.files))


def check(build, name, paths, flags):
    """Returns what clang-tidy says of the files as one unit; empty where they are clean."""
    main = paths[0]
    if len(paths) > 1:
        main = os.path.join(build, "lint", name + ".cc")
        with open(main, "w", encoding="utf-8") as file:
            file.writelines(f'#include "{path}"  // NOLINT(bugprone-suspicious-include)\n' for path in paths)
    folder = os.path.relpath(paths[0], ROOT).split(os.sep)[0]
    checks = [f"--checks={LEFT_OUT[folder]}"] if folder in LEFT_OUT else []
    command = ["clang-tidy", "--quiet", FILTER, *checks, main, "--", *flags, *OWN_FLAGS]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    if done.returncode == 0:
        return ""
    error = re.search(r".*\[clang-diagnostic-error", done.stdout)
    if len(paths) > 1 and error:
        print(f"lint: {name} does not compile as one: {error[0]}", file=sys.stderr)
        half = len(paths) // 2
        return check(build, name + "a", paths[:half], flags) + check(build, name + "b", paths[half:], flags)
    return done.stdout or done.stderr


def main():
    build = os.path.abspath(sys.argv[1])
    # What the build has written itself has no style.
    flags = {path: flag for path, flag in compile_flags(build).items() if not path.startswith(build + os.sep)}
    if len(sys.argv) > 2:
        files = [os.path.abspath(path) for path in sys.argv[2:]]
        left_out = [os.path.relpath(path, ROOT) for path in files if path not in flags]
        if left_out:
            print("lint: not in the build, so not checked:", *left_out)
        flags = {path: flags[path] for path in files if path in flags}
    refused = [os.path.relpath(path, ROOT) for path in flags if not is_for_clang(path)]
    if refused:
        print("lint: clang cannot compile these, so not checked:", *refused)
    units = make_units({path: flag for path, flag in flags.items() if is_for_clang(path)})
    os.makedirs(os.path.join(build, "lint"), exist_ok=True)
    failed = False
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [
            pool.submit(check, build, f"unit_{i}", unit.files, list(unit.flags.values()))
            for i, unit in enumerate(units)
        ]
        for job in concurrent.futures.as_completed(jobs):
            failed |= bool(job.result())
            print(job.result(), end="", flush=True)
    print(f"lint: {len(flags)} files in {len(units)} units:", "faults" if failed else "clean")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
