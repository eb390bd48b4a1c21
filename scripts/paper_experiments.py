#!/usr/bin/env python3
"""Makes every experiment of the paper, figures and tables: batch against two-level.

  a  Growing maps: time and nodes of a frame against the number of the frame. The camera circles an organ,
     so most of the map leaves the view (paper_time.png). The table has the ratio of times at the end,
     medians of the last 20 frames.
  b  Accuracy of the same runs, means: map to scan (rms distance of inliers to the planes, and |z - depth|
     at the pixel), map points in view to the true surface, and tracking errors, with the loss of
     two-level against batch in percent.
  c  A plane that is warped under a still camera, which then sees half of it (paper_plane.png). "level I"
     are the nodes that it moves. Seen and hidden are the mean distances of points to the places of
     their tissue, by the mask; "to batch" is that to their places in batch.
  d  A dolphin bent by handles alone (paper_dolphin.png); distances in percent of its diagonal.

In a and b two-level runs with its defaults (2 rings, keep). The script writes the pictures, tables.md and
results.json to --output. Runs follow one another; before them two sequences at a time are simulated
into --cache, where the next run of the script finds them. It needs python3-numpy and
python3-matplotlib. It exits with 1 when a run fails, and with 2 on a wrong call.

  scripts/paper_experiments.py
  scripts/paper_experiments.py --page      # also writes the pictures into scripts/images/
  scripts/paper_experiments.py --quick --output=/tmp/paper
"""
import argparse
import json
import re
import shlex
import shutil
import sys
import tempfile
import time
from pathlib import Path

# First of those that need numpy and matplotlib: it says so where they are missing.
import mesh_picture  # noqa: F401
from bench_tables import add_page_option, check_marks, write_between
from paper_deformations import run_dolphin, run_plane
from paper_sequences import run_growing
from program_runs import PROGRAM, ROOT, RunFailed, wrong_call
from sequence_runs import CACHE, SCENES

BEGIN, END = "<!-- paper_experiments.py: begin -->", "<!-- paper_experiments.py: end -->"
PICTURES = ("paper_time.png", "paper_plane.png", "paper_dolphin.png")
EXPERIMENTS = "abcd"
PAGE = ROOT / "ceres_ed/slam/experiments.md"


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of the programs [build/release/apps]")
    parser.add_argument("--output", type=Path, default=ROOT / "build/paper", metavar="DIR",
                        help="folder to write [build/paper]")
    parser.add_argument("--cache", type=Path, default=CACHE, metavar="DIR",
                        help="where simulated sequences are kept [build/sequences]")
    parser.add_argument("--fresh", action="store_true",
                        help="simulate again even if --cache has the sequences")
    parser.add_argument("--scenes", default="heart,kidney,stomach", metavar="NAMES",
                        help="sequences of a and b [heart,kidney,stomach]")
    parser.add_argument("--frames", type=int, default=210,
                        help="frames of a and b [210: once around]")
    parser.add_argument("--size", default="320x240", metavar="WxH",
                        help="size of the images of a and b [320x240, as in the paper]")
    parser.add_argument("--experiments", default=EXPERIMENTS, metavar="LETTERS",
                        help="experiments to make [abcd]; a and b come together")
    parser.add_argument("--quick", action="store_true",
                        help="small images and few frames, to test the script")
    parser.add_argument("--flags", default="", help="more flags of ed_slam for all runs [none]")
    add_page_option(parser, PAGE, "the pictures into scripts/images/, and the tables")
    options = parser.parse_args()
    options.scenes = [name for name in options.scenes.split(",") if name]
    unknown = set(options.scenes) - set(SCENES)
    if unknown or not options.scenes:
        parser.error(f"--scenes: {', '.join(sorted(unknown)) or 'none'}, expected some of "
                     f"{', '.join(SCENES)}")
    if not options.experiments or set(options.experiments) - set(EXPERIMENTS):
        parser.error(f"--experiments={options.experiments}, expected some of {EXPERIMENTS}")
    if not re.fullmatch(r"[0-9]+x[0-9]+", options.size):
        parser.error(f"--size={options.size}, expected such as 320x240")
    if options.frames < 2:
        parser.error(f"--frames={options.frames}, expected 2 or more")
    if options.page:
        if options.quick or set(options.experiments) != set(EXPERIMENTS):
            parser.error("--page takes all experiments, and none of them quick")
        check_marks(options.page, BEGIN, END)
    for program in ("ed_slam", "ed_simulate", "ed_eval", "ed_fit"):
        if not (options.bin / program).exists():
            wrong_call(f"{options.bin / program} is not there; build it or name its folder")
    settle_sizes(options)
    return options


def settle_sizes(options):
    options.live_every = 5
    options.slam_flags = shlex.split(options.flags)
    width, _, height = options.size.partition("x")
    options.simulate_flags = [f"--frames={options.frames}", f"--width={width}",
                              f"--height={height}"]
    options.plane_flags = []
    if options.quick:
        small = ["--width=160", "--height=120", "--vertices=2000"]
        options.simulate_flags = ["--frames=12", *small]
        options.plane_flags = ["--frames=5", *small]
        options.slam_flags.append("--nodes_in_view=80")


def run_all(options, work):
    """Returns the Markdown of everything and what goes into the JSON file."""
    parts, results = [], {}
    if set("ab") & set(options.experiments):
        results["growing"], growth, accuracy = run_growing(options, work, options.output)
        parts += ["**Time at the end of each sequence** (medians of its last 20 frames)", growth,
                  "**Accuracy**", accuracy]
    if "c" in options.experiments:
        parts += ["**A plane warped under a still camera**",
                  run_plane(options, work, options.output)]
    if "d" in options.experiments:
        parts += ["**The dolphin bent by handles**", run_dolphin(options, work, options.output)]
    texts = ["\n".join(part) if isinstance(part, list) else part for part in parts]
    return "\n\n".join(texts), results


def main():
    options = parse_options()
    start = time.monotonic()
    def say(text):
        print(f"[{time.monotonic() - start:4.0f} s] {text}", file=sys.stderr)
    options.say = say
    options.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="paper_experiments_") as work:
        try:
            page, results = run_all(options, Path(work))
        except RunFailed as error:
            print(f"{PROGRAM}: {error}", file=sys.stderr)
            return 1
    (options.output / "tables.md").write_text(page + "\n")
    (options.output / "results.json").write_text(json.dumps(results, indent=1) + "\n")
    print(page)
    if options.page:
        write_between(options.page, BEGIN, END, page)
        for name in PICTURES:
            shutil.copy(options.output / name, ROOT / "scripts/images" / name)
    say(f"done: {options.output}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
