#!/usr/bin/env python3
"""Checks whether two builds give the same bytes, for a change that must not change a result.

  scripts/compare_results.py BEFORE AFTER [--data=FOLDER] [--frames=60] [--modes=batch,two_level]

BEFORE and AFTER are folders of the programs. Both fit every pair in data/ and in FOLDER, with the default
flags and with --mode=two_level and marginal; the fitted PLY, the warp and the graph must have the same
bytes. Both track a simulated heart and every sequence in FOLDER in each mode; map, graph, trajectory,
tracks and live clouds must have the same bytes, and frames.csv must be the same except for its columns
of time. The script exits with 1 if something differs.
"""
import argparse
import csv
import filecmp
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FIT_FILES = ["fitted.ply", "warp.json", "graph.ply"]


def call(program, *arguments):
    subprocess.run([str(program), *map(str, arguments)], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)


def fit(programs, pair, mode, out):
    target = pair / "target.ply"
    call(programs / "ed_fit", pair / "source.ply", target, f"--mode={mode}",
         f"--output={out / 'fitted.ply'}", f"--warp={out / 'warp.json'}",
         f"--graph={out / 'graph.ply'}")


def track(programs, sequence, mode, frames, out):
    call(programs / "ed_slam", sequence, f"--output={out}", f"--mode={mode}",
         f"--last={frames - 1}", "--live_every=5", "--quiet")


def without_times(path):
    """Returns the rows of frames.csv without the columns of time."""
    with open(path, newline="", encoding="utf-8") as file:
        return [{name: value for name, value in row.items() if not name.startswith("t_")}
                for row in csv.DictReader(file)]


def differences(before, after):
    """Returns the names of files that differ or that one of the folders lacks."""
    names = {str(path.relative_to(folder))
             for folder in (before, after) for path in folder.rglob("*") if path.is_file()}
    differing = []
    for name in sorted(names - {"report.json", "checkpoint.cbor"}):
        one, other = before / name, after / name
        if not (one.exists() and other.exists()):
            differing.append(name)
        elif name == "frames.csv":
            if without_times(one) != without_times(other):
                differing.append(name)
        elif not filecmp.cmp(one, other, shallow=False):
            differing.append(name)
    return differing, len(names)


def compare(title, run, before, after):
    with tempfile.TemporaryDirectory() as work:
        folders = [Path(work) / "before", Path(work) / "after"]
        for programs, folder in zip((before, after), folders):
            folder.mkdir()
            run(programs, folder)
        differing, count = differences(*folders)
    print(f"{title}: " + ("differs in " + ", ".join(differing) if differing else
                          f"{count} files, same bytes"), flush=True)
    return not differing


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", type=Path)
    parser.add_argument("after", type=Path)
    parser.add_argument("--data", type=Path, help="folder of more pairs and sequences")
    parser.add_argument("--frames", type=int, default=60, help="frames of each sequence")
    parser.add_argument("--only", help="pairs and sequences of these names, with commas between")
    parser.add_argument("--modes", default="batch,two_level,marginal")
    options = parser.parse_args()
    folders = [ROOT / "data"] + ([options.data] if options.data else [])
    found = [path for folder in folders for path in sorted(folder.iterdir())]
    if options.only:
        found = [path for path in found if path.name in options.only.split(",")]
    modes = options.modes.split(",")
    same = True
    for path in found:
        if (path / "source.ply").exists() and (path / "target.ply").exists():
            for mode in modes:
                same &= compare(f"{path.name} {mode}",
                                lambda programs, out, p=path, m=mode: fit(programs, p, m, out),
                                options.before, options.after)
    with tempfile.TemporaryDirectory() as work:
        heart = Path(work) / "heart"
        call(options.before / "ed_simulate", "heart", f"--output={heart}",
             f"--frames={options.frames}", "--width=320", "--height=240")
        sequences = [heart] + [path for path in found if (path / "camera.txt").exists()
                               and (path / "depth").is_dir()]
        for path in sequences:
            for mode in modes:
                same &= compare(
                    f"{path.name} {mode}",
                    lambda programs, out, p=path, m=mode: track(programs, p, m, options.frames, out),
                    options.before, options.after)
    sys.exit(0 if same else 1)


if __name__ == "__main__":
    main()
