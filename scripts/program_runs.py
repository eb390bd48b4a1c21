"""Runs and measures programs, for benchmarks, ablation and experiments."""
import multiprocessing
import os
import shlex
import subprocess
import sys
import threading
import time
from pathlib import Path

PROGRAM = Path(sys.argv[0]).name
ROOT = Path(__file__).resolve().parent.parent


class RunFailed(Exception):
    pass


def wrong_call(message):
    print(f"{PROGRAM}: {message}", file=sys.stderr)
    sys.exit(2)


def apart(function, *arguments):
    """Returns the result of `function`, called in a process of its own.

    A program's peak memory, as the kernel counts it, is at least that of the process that starts
    it: large arrays in this one would show in every figure that follows.
    """
    with multiprocessing.get_context("fork").Pool(1) as pool:
        return pool.apply(function, arguments)


class Variant:
    """A program and its flags."""

    def __init__(self, name, program, flags):
        self.name = name
        self.program = Path(program)
        self.flags = flags
        if not os.access(self.program, os.X_OK):
            wrong_call(f"{self.program} is not there; build it or name its folder")


def names(text):
    """Returns the entries of a list with commas."""
    return [name for name in text.split(",") if name]


def default_folders():
    """Returns data/ and the folder that the environment variable CERES_ED_DATA names."""
    extra = os.environ.get("CERES_ED_DATA")
    return [ROOT / "data"] + ([Path(extra)] if extra else [])


def run(command, log, accepted=(0,), kill_after_s=None):
    """Runs a program; returns its wall seconds, CPU seconds and peak megabytes.

    Other exit codes than those `accepted` are failures, and so is a program that is still running
    after `kill_after_s`: it is killed.
    """
    with open(log, "wb") as stderr:
        start = time.monotonic()
        child = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL,
                                 stderr=stderr)
        killer = threading.Timer(kill_after_s, child.kill) if kill_after_s else None
        if killer:
            killer.start()
        _, status, usage = os.wait4(child.pid, 0)
        if killer:
            killer.cancel()
        wall = time.monotonic() - start
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode not in accepted:
        last = Path(log).read_text(errors="replace").strip().splitlines()[-1:] or ["no message"]
        raise RunFailed(f"{shlex.join(map(str, command))}\n  exit code {child.returncode}: {last[0]}")
    return wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0
