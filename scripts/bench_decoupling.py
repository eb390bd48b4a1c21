#!/usr/bin/env python3
"""Measures what decoupling loses and saves: energy against batch, and time against the size of the map.

It has three parts. Each can be made alone (--only); the results of the others are then read from --work.

  strip  A camera moves along a long band, with 320 x 240 pixels and about 300 nodes in view. At each of
         --sizes nodes the table has the median time of the last 50 frames, in total (t_total of
         frames.csv: without reading and writing) and by stage. It also has the ratio of times from the
         first size to the last, and the slope of log time over log nodes. Batch, marginal and the
         paper's scheme (no rings, all of Level II) take a few frames from the last checkpoint of the
         default run before that size: milliseconds, and in brackets their ratio to the default run on
         the same frames. Each of these has --budget_s. A scheme that fails or finishes no frame in it is
         reported, and not tried at larger sizes.
  paired Both ends of that strip take turns, 50 frames each, three times. A machine whose speed changes
         does not spoil this ratio.
  gap    Whole sequences: a strip of --gap_nodes nodes, and the organs. For each scheme: the median time
         of the last 50 frames, relative to batch; the energy above that of a batch solve of the same
         frame (--verify_every of ed_slam; mean and largest); and the mean errors by ed_eval: distance of
         visible map points to the true surface, and tracking errors of visible and hidden points.

The schemes of gap are batch, marginal, the default, and the paper's with both boundaries. The first
sequence also has 0, 2, 4 and 8 rings with keep and 0, 2 and 8 with cut (lazy Level II), and two rings
with full Level II. Times leave out the frames that are verified. All runs have one thread and follow
one another. The script writes decoupling.png, decoupling.md and the results of each part to --work, and
uses the sequences that it finds there again. It needs python3-numpy and python3-matplotlib. It exits
with 1 if the default or the batch run fails, and with 2 on a wrong call; other failures are listed in
the tables.

  scripts/bench_decoupling.py
  scripts/bench_decoupling.py --quick --work=/tmp/decoupling
  scripts/bench_decoupling.py --only=strip --sizes=1000,3000,10000
  scripts/bench_decoupling.py --page       # also writes the figure into scripts/images/
"""
import argparse
import json
import shlex
import shutil
import sys
import time
from pathlib import Path

# First of those that need numpy and matplotlib: it says so where they are missing.
import mesh_picture  # noqa: F401
from bench_tables import add_page_option, check_marks, write_between
from decoupling_gaps import gaps
from decoupling_runs import (BATCH, DEFAULT, MARGINAL, NODES_IN_VIEW, NODES_OF_VIEW, PAPER_CUT,
                             PAPER_KEEP, growth, make_strip, paired)
from decoupling_tables import draw, gap_lines, growth_lines, paired_lines
from program_runs import PROGRAM, ROOT, RunFailed, wrong_call
from sequence_runs import SCENES, simulate

BEGIN, END = "<!-- bench_decoupling.py: begin -->", "<!-- bench_decoupling.py: end -->"
PARTS = ("strip", "paired", "gap")
PICTURE = "decoupling.png"
PAGE = ROOT / "ceres_ed/slam/decoupling.md"


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of the programs [build/release/apps]")
    parser.add_argument("--work", type=Path, default=ROOT / "build/decoupling", metavar="DIR",
                        help="folder for sequences, runs, results and the figure [build/decoupling]")
    parser.add_argument("--only", default=",".join(PARTS), metavar="PARTS",
                        help="parts to make, with commas between [strip,paired,gap]")
    parser.add_argument("--sizes", default="1000,3000,10000,30000,50000", metavar="N,...",
                        help="sizes of the map in nodes [1000,3000,10000,30000,50000]")
    parser.add_argument("--speed", type=float, default=0.05, metavar="SHARE",
                        help="share of the view that the camera moves in a frame of strip [0.05: 6 mm]")
    parser.add_argument("--nodes_in_view", type=int, default=NODES_IN_VIEW, metavar="N",
                        help=f"flag of ed_slam [{NODES_IN_VIEW}: about 300 PR nodes]")
    parser.add_argument("--beside", type=int, default=10, metavar="N",
                        help="frames that the other schemes take at each size [10]")
    parser.add_argument("--budget_s", type=float, default=600.0, metavar="S",
                        help="time limit of each of these runs, and of each run of gap [600]")
    parser.add_argument("--checkpoint_every", type=int, default=50, metavar="N",
                        help="frames between checkpoints of strip [50]")
    parser.add_argument("--gap_nodes", type=int, default=1000, metavar="N",
                        help="nodes of the strip in gap [1000]")
    parser.add_argument("--scenes", default="strip,heart,kidney,stomach", metavar="NAMES",
                        help="sequences of gap [strip,heart,kidney,stomach]")
    parser.add_argument("--verify_every", type=int, default=10, metavar="N",
                        help="flag of ed_slam in gap; 0 verifies nothing [10]")
    parser.add_argument("--flags", default="", help="more flags of ed_slam for all runs [none]")
    parser.add_argument("--fresh", action="store_true",
                        help="simulate again even if --work has the sequences")
    parser.add_argument("--quick", action="store_true",
                        help="small maps and few schemes, to test the script")
    parser.add_argument("--json", metavar="FILE", help="also write all figures and options there")
    add_page_option(parser, PAGE, "the figure into scripts/images/, and tables and command")
    options = parser.parse_args()
    # What a reader has to say to get the same.
    options.said = {key: value for key, value in vars(options).items()
                    if value != parser.get_default(key)
                    and key not in ("bin", "work", "only", "fresh", "json", "page")}
    check(options, parser)
    return options


def check(options, parser):
    """Ends the program on a wrong call; splits lists and sets sizes."""
    options.only = [name for name in options.only.split(",") if name]
    if not options.only or set(options.only) - set(PARTS):
        parser.error(f"--only={','.join(options.only)}, expected some of {', '.join(PARTS)}")
    options.scenes = [name for name in options.scenes.split(",") if name]
    if set(options.scenes) - set(SCENES):
        parser.error(f"--scenes={','.join(options.scenes)}, expected some of {', '.join(SCENES)}")
    options.slam_flags = shlex.split(options.flags)
    options.simulate_flags = ["--width=320", "--height=240"]
    options.live_every = 5
    options.given_up = {}
    if options.quick:
        if options.page:
            parser.error("--page takes no --quick")
        options.sizes, options.nodes_in_view, options.gap_nodes = "300,600,900", 140, 400
        options.checkpoint_every, options.beside = 10, 5
        options.verify_every = min(options.verify_every, 5)
        options.budget_s = min(options.budget_s, 40.0)
        options.scenes = options.scenes[:2]
        options.simulate_flags = ["--width=160", "--height=120"]
    try:
        options.sizes = sorted({int(size) for size in options.sizes.split(",")})
    except ValueError:
        parser.error(f"--sizes={options.sizes}, expected whole numbers with commas between")
    for name, lowest in (("beside", 2), ("budget_s", 1.0), ("checkpoint_every", 2),
                         ("gap_nodes", NODES_OF_VIEW), ("nodes_in_view", 4), ("verify_every", 0)):
        if getattr(options, name) < lowest:
            parser.error(f"--{name}={getattr(options, name)}, expected {lowest} or more")
    if not 0.001 <= options.speed <= 0.3:
        parser.error(f"--speed={options.speed}, expected 0.001 to 0.3")
    if options.sizes[0] < 1:
        parser.error(f"--sizes: {options.sizes[0]}, expected 1 or more")
    if options.page:
        check_marks(options.page, BEGIN, END)
    for program in ("ed_slam", "ed_simulate", "ed_eval"):
        if not (options.bin / program).exists():
            wrong_call(f"{options.bin / program} is not there; build it or name its folder")


def make_strip_part(options):
    options.say(f"simulating a strip for {options.sizes[-1]} nodes")
    # The truth of every vertex in every frame would take tens of gigabytes.
    sequence, frames = make_strip(options, options.sizes[-1], ["--truth=false"])
    records = growth(options, sequence, frames, [BATCH, MARGINAL, PAPER_KEEP, PAPER_CUT])
    return records, any(not record["reached"] for record in records)


def make_paired_part(options):
    sequence, _ = make_strip(options, options.sizes[-1], ["--truth=false"])
    options.say("strip: both ends in turn")
    return paired(options, sequence), False


def make_gap_part(options):
    sequences = []
    for scene in options.scenes:
        options.say(f"simulating {scene}")
        if scene == "strip":
            sequences.append(make_strip(options, options.gap_nodes, [])[0])
            continue
        frames = ["--frames=12"] if options.quick else []
        sequences.append(simulate(options.bin / "ed_simulate", scene,
                                  frames + options.simulate_flags, options.work / "sequences",
                                  options.fresh))
    rows = gaps(options, sequences)
    needed = (BATCH.name, DEFAULT.name)
    return rows, any(row["note"] and row["scheme"] in needed for row in rows)


def result_of(options, part):
    """Returns the result of a part, made now or read from an earlier run, and whether it failed."""
    path = options.work / f"{part}.json"
    if part in options.only:
        result, failed = {"strip": make_strip_part, "paired": make_paired_part,
                          "gap": make_gap_part}[part](options)
        path.write_text(json.dumps(result, indent=1) + "\n")
        return result, failed
    return (json.loads(path.read_text()) if path.exists() else []), False


def page_of(records, rounds, rows, options):
    words = [f"--{key}" if value is True else f"--{key}={value}"
             for key, value in options.said.items()]
    parts = [f"`{shlex.join(['scripts/bench_decoupling.py', *words])}`:"]
    if records:
        parts.append("\n".join(growth_lines(records)))
    if rounds:
        parts.append("\n".join(paired_lines(rounds)))
    if rows:
        parts.append("\n".join(gap_lines(rows)))
    return "\n\n".join(parts)


def main():
    options = parse_options()
    start = time.monotonic()
    def say(text):
        print(f"[{time.monotonic() - start:4.0f} s] {text}", file=sys.stderr)
    options.say = say
    options.work.mkdir(parents=True, exist_ok=True)
    try:
        records, strip_failed = result_of(options, "strip")
        rounds, _ = result_of(options, "paired")
        rows, gap_failed = result_of(options, "gap")
    except RunFailed as error:
        print(f"{PROGRAM}: {error}", file=sys.stderr)
        return 1
    page = page_of(records, rounds, rows, options)
    print(page)
    draw(records, rows, options.work / PICTURE)
    (options.work / "decoupling.md").write_text(page + "\n")
    if options.json:
        Path(options.json).write_text(json.dumps({"options": options.said, "strip": records,
                                                  "paired": rounds, "gap": rows}, indent=1) + "\n")
    failed = strip_failed or gap_failed
    if options.page and failed:
        print(f"{PROGRAM}: a run failed, {options.page} stays as it is", file=sys.stderr)
    elif options.page:
        write_between(options.page, BEGIN, END, page)
        shutil.copy(options.work / PICTURE, ROOT / "scripts/images" / PICTURE)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
