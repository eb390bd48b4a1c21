#!/usr/bin/env python3
"""Runs ed_slam on every depth sequence and tabulates how accurate and how fast it is.

Sequences are searched in the folder that the environment variable CERES_ED_DATA names (folders with
camera.txt and depth/, or with depth.txt). ed_simulate makes heart, kidney, stomach, strip and plane
once, into --cache. With --compare-flags or --compare-bin a second variant B takes turns with the first
one (A B A B ...), so both meet the same state of the machine. One run follows another.

  frames   number of frames, and of these: reloc (camera found again), lost, skipped (nothing to see)
  surface  distance of visible map points to the true surface: median of a frame, median of the frames
  seen     tracking error: distance of a map point to the place of its tissue; mean of points in view
  worst    the largest of these means of a frame
  after    the mean of these means from frame 60 on, when what covers a hard sequence is over
  hidden   the same for points out of view or behind others
  map      99th percentile of the distances of all map points to the true surface, last live cloud
  camera   rms error of the camera's position (camera and tissue may exchange motion)
  px       median error of the given 2D tracks; tracks: followed / given
  moved    median error at the ends of the tracks that move more than 50 pixels
  plane    rms distance of inliers to the planes of the depth image, median of the frames
  static   residual of a pair of frames in which nothing moves, for --static-residual: see below
  depth    |z - depth| at the pixel, median of a frame, mean of the frames; includes the sensor's noise
  far      share of the map points in view that lie more than 3 mm from that depth, %; mean of the frames
  length   how much longer or shorter an object becomes that a mask outlines, %; the worst frame
  ms, p95  time of a frame, t_total of frames.csv: without reading, decoding and writing
  late     the time of a frame in the last quarter over that in the second
  cpu      CPU time of the whole program for a frame; for use on a machine that is busy
  observe ... grow   medians of the stages, ms
  MB       peak memory of ed_slam
  nodes, points   of the map at the end; pr: nodes with data, active: moved by Level I (medians)
Below the table, hard sequences are compared with the same frames without the hardship (REFERENCES of
hard_sequences.py), if these are in the table, too.

Lengths are in millimetres. Times are medians over --runs; errors are those of the first run.

--static-residual: ed_slam places the map of frame k alone on frame k + 1, with rotation and
regularization so strong that nothing bends. The median over the quietest quarter of all neighbouring
frames is what the sensor's noise and the calibration leave (sequence_runs.py explains it).

The script exits with 1 when a run fails or two runs of one variant differ, and with 2 on a wrong call.

  scripts/bench_sequences.py
  scripts/bench_sequences.py --sequences=heart,kidney,stomach --compare-flags="--mode=batch"
  scripts/bench_sequences.py --sequences=invivo_heart_40 --runs=3 --json=build/sequences.json
  scripts/bench_sequences.py --compare-bin=../before/build/release/apps
  scripts/bench_sequences.py --sequences=hard       # orbits, cover, jumps (hard_sequences.py)
  scripts/bench_sequences.py --page      # then scripts/refresh_pages.sh, for the README
"""
import argparse
import json
import shlex
import statistics
import sys
import tempfile
from pathlib import Path

from bench_tables import (PAGE, add_page_option, cell, check_marks, print_table, ratio_row, table,
                          write_between)
from hard_sequences import REFERENCES, hard_sequences
from object_length import worst_length_change
from program_runs import PROGRAM, ROOT, RunFailed, Variant, default_folders, wrong_call
from sequence_runs import (CACHE, SCENES, STAGES, counts_of, digest, errors_of, evaluate,
                           find_sequences, read_frames, simulate, static_residual, times_of, track)

BEGIN, END = "<!-- bench_sequences.py: begin -->", "<!-- bench_sequences.py: end -->"
TIMES = ("ms", "ms_p95", *(f"ms_{stage}" for stage in STAGES), "cpu", "wall_s", "memory_mb")

# Field, heading, decimals.
COLUMNS = [
    ("sequence", "sequence", None), ("frames", "frames", 0), ("relocalized", "reloc", 0),
    ("lost", "lost", 0), ("skipped", "skipped", 0), ("surface_seen", "surface", 3),
    ("tracking_seen", "seen", 3), ("seen_worst", "worst", 2), ("seen_late", "after", 3),
    ("tracking_hidden", "hidden", 3), ("map_p99", "map", 2),
    ("camera", "camera", 2),
    ("track_px", "px", 2), ("moved_px", "moved", 1), ("tracks", "tracks", None), ("rms_plane", "plane", 3),
    ("static", "static", 3), ("depth", "depth", 3), ("far", "far", 2),
    ("length", "length", 1), ("ms", "ms", 1), ("ms_p95", "p95", 1),
    ("late_ratio", "late", 2), ("cpu", "cpu", 1), *((f"ms_{stage}", stage, 1) for stage in STAGES), ("memory_mb", "MB", 0),
    ("nodes", "nodes", 0), ("pr", "pr", 0), ("active", "active", 0), ("points", "points", 0),
]
RATIOS = ("surface_seen", "tracking_seen", "tracking_hidden", "camera", "track_px", "rms_plane",
          "depth", *TIMES)
# The columns of the page.
SHOWN = [("frames", "frames", 0), ("lost", "lost", 0), ("surface_seen", "surface mm", 2),
         ("tracking_seen", "seen mm", 2), ("tracking_hidden", "hidden mm", 2),
         ("track_px", "tracks px", 1), ("rms_plane", "plane mm", 2), ("ms", "ms", 0),
         ("ms_p95", "p95 ms", 0), ("memory_mb", "MB", 0), ("nodes", "nodes", 0),
         ("points", "points", 0)]


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of ed_slam, ed_simulate and ed_eval [build/release/apps]")
    parser.add_argument("--flags", default="", help="flags of ed_slam for both variants [none]")
    parser.add_argument("--runs", type=int, default=1, help="runs of each variant [1]")
    parser.add_argument("--sequences", default="", help="names, with commas between [all]")
    parser.add_argument("--data", action="append", type=Path, metavar="DIR",
                        help="folder of sequences, repeatable [data/ and $CERES_ED_DATA]")
    parser.add_argument("--cache", type=Path, default=CACHE, metavar="DIR",
                        help="where simulated sequences are kept [build/sequences]")
    parser.add_argument("--simulate-flags", default="", metavar="FLAGS",
                        help="flags of ed_simulate, such as --frames=30 [none]")
    parser.add_argument("--fresh", action="store_true",
                        help="simulate again even if --cache has the sequences")
    parser.add_argument("--static-residual", default="invivo_heart_40", metavar="NAMES",
                        help="sequences whose static residual is measured [invivo_heart_40]")
    parser.add_argument("--compare-flags", metavar="FLAGS", help="additional flags of variant B")
    parser.add_argument("--compare-bin", metavar="DIR",
                        help="variant B is the ed_slam in this folder")
    parser.add_argument("--json", metavar="FILE", help="also write rows and options to this file")
    add_page_option(parser, PAGE, "the table")
    options = parser.parse_args()
    if options.runs < 1:
        parser.error(f"--runs={options.runs}, expected 1 or more")
    if options.data is None:
        options.data = default_folders()
    options.compared = options.compare_flags is not None or options.compare_bin is not None
    if options.compared and options.page:
        parser.error("--page takes one variant alone")
    if options.page:
        check_marks(options.page, BEGIN, END)
    return options


def list_sequences(options):
    """Returns {name: function that returns the sequence}; the function simulates it if needed."""
    names = [name for name in options.sequences.split(",") if name]
    made = {}
    for scene in SCENES:
        def make(scene=scene):
            return simulate(options.bin / "ed_simulate", scene,
                            shlex.split(options.simulate_flags), options.cache, options.fresh)
        made[scene] = make
    found = {sequence.name: (lambda sequence=sequence: sequence)
             for sequence in find_sequences(options.data)}
    hard = hard_sequences(options.bin / "ed_simulate", options.cache, options.fresh)
    if names == ["hard"]:
        names = list(hard)
    known = {**found, **made, **hard}
    unknown = set(names) - set(known)
    if unknown:
        wrong_call(f"no sequence {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    return {name: known[name] for name in names or {**found, **made}}


def run_once(variant, sequence, output):
    wall, cpu, memory = track(variant, sequence, output)
    frames = read_frames(output)
    return {"wall_s": wall, "cpu": 1e3 * cpu / max(1, len(frames)), "memory_mb": memory,
            **counts_of(frames), **times_of(frames)}


def bench_sequence(variants, sequence, options, work):
    """Runs the variants in turn; returns a row for each, and whether all runs of each variant agreed."""
    runs, digests, agreed = {}, {}, True
    for number in range(options.runs):
        for variant in variants:
            output = work / f"{variant.name}_{number > 0}"
            runs.setdefault(variant.name, []).append(run_once(variant, sequence, output))
            if digests.setdefault(variant.name, digest(output)) != digest(output):
                print(f"{PROGRAM}: {sequence.name}: two runs of {variant.name} differ",
                      file=sys.stderr)
                agreed = False
    rows = []
    for variant in variants:
        of_variant = runs[variant.name]
        row = dict.fromkeys(key for key, _, _ in COLUMNS)
        row.update(of_variant[0], sequence=sequence.name, variant=variant.name)
        for key in TIMES:
            values = [one[key] for one in of_variant if key in one]
            row[key] = statistics.median(values) if values else None
        row.update(errors_of(evaluate(options.bin / "ed_eval", sequence,
                                      work / f"{variant.name}_False")))
        row["length"] = worst_length_change(sequence.folder, work / f"{variant.name}_False")
        if sequence.name in options.static_residual.split(","):
            row["static"] = static_residual(variant, sequence, work)
        rows.append(row)
    return rows, agreed


def markdown(rows):
    lines = table(["sequence", *(heading for _, heading, _ in SHOWN)],
                  [[f"`{row['sequence']}`", *(cell(row[key], decimals)
                                              for key, _, decimals in SHOWN)] for row in rows])
    for row in rows:
        if row["static"]:
            lines += ["", static_note(row)]
    return "\n".join(lines)


def static_note(row):
    return (f"`{row['sequence']}`: a pair of frames where nothing moves leaves "
            f"{row['static']:.3f} mm to the planes; the sequence {row['rms_plane']:.3f} mm, "
            f"{row['rms_plane'] / row['static']:.2f} times that.")


def reference_notes(rows):
    """Returns a line for each hard sequence whose reference is in the table, too."""
    known = {(row["sequence"], row["variant"]): row for row in rows}
    notes = []
    for row in rows:
        reference, key = REFERENCES.get(row["sequence"], (None, None))
        other = known.get((reference, row["variant"]))
        if other and row[key] and other[key]:
            heading = next(h for k, h, _ in COLUMNS if k == key)
            notes.append(f"{row['sequence']}: {heading} {row[key] / other[key]:.2f} times that of "
                         f"{reference}")
    return notes


def save(options, rows):
    if options.json:
        said = {key: getattr(options, key) for key in ("flags", "runs", "simulate_flags",
                                                       "compare_flags")}
        Path(options.json).write_text(json.dumps({"options": said, "rows": rows}, indent=2) + "\n")
    if options.page:
        write_between(options.page, BEGIN, END, markdown(rows))


def main():
    options = parse_options()
    variants = [Variant("A", options.bin / "ed_slam", shlex.split(options.flags))]
    if options.compared:
        flags = shlex.split(f"{options.flags} {options.compare_flags or ''}")
        folder = Path(options.compare_bin or options.bin)
        variants.append(Variant("B", folder / "ed_slam", flags))

    rows, failed = [], False
    with tempfile.TemporaryDirectory(prefix="bench_sequences_") as work:
        sequences = list_sequences(options)
        for number, (name, make) in enumerate(sequences.items(), 1):
            print(f"[{number}/{len(sequences)}] {name}", file=sys.stderr)
            try:
                of_sequence, agreed = bench_sequence(variants, make(), options, Path(work))
            except RunFailed as error:
                print(f"{PROGRAM}: {name}: {error}", file=sys.stderr)
                failed = True
                continue
            failed = failed or not agreed
            rows += of_sequence
            if options.compared:
                rows.append(ratio_row(*of_sequence, COLUMNS, RATIOS))
    print_table(rows, options.compared, COLUMNS, RATIOS)
    for row in rows:
        if row["static"]:
            print(static_note(row).replace("`", ""))
    for note in reference_notes(rows):
        print(note)
    if failed and options.page:
        print(f"{PROGRAM}: a run failed, {options.page} stays as it is", file=sys.stderr)
        options.page = None
    save(options, rows)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
