"""Shell blocks, run as a reader of the page runs them."""

import os
import re
import shutil
import subprocess

NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def make_root(folder, source, provided):
    """Makes a folder that looks like the repository to the programs; `provided`: path to file."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    for name in ("data", "apps"):
        shutil.copytree(os.path.join(source, name), os.path.join(folder, name))
    for path, file in provided.items():
        os.makedirs(os.path.dirname(os.path.join(folder, path)), exist_ok=True)
        shutil.copy(file, os.path.join(folder, path))


def run(block, folder, programs):
    """Runs a block in `folder`; returns what it printed, and what is wrong (empty: nothing)."""
    environment = dict(os.environ, PATH=os.pathsep.join([*programs, os.environ["PATH"]]))
    result = subprocess.run(
        ["bash", "-eu", "-o", "pipefail", "-c", block.text],
        cwd=folder, env=environment, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300, check=False)
    if result.returncode == 0:
        return result.stdout, ""
    return result.stdout, f"exit code {result.returncode}\n{result.stdout}"


def normal(line):
    """A line but for its numbers and the width of its gaps."""
    return " ".join(NUMBER.sub("#", line).split())


def missing_line(shown, printed):
    """Returns the first line of `shown` that `printed` does not have, in order; None: all are there.

    Numbers may be others, and "..." stands for any number of lines.
    """
    lines = iter([normal(line) for line in printed.split("\n")])
    for line in shown.split("\n"):
        wanted = normal(line)
        if wanted in ("", "..."):
            continue
        if wanted not in lines:
            return line
    return None
