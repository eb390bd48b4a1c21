#!/usr/bin/env python3
"""Measures how much memory a map takes: by owner, for a node and a point, and as the process grows.

It runs ed_slam once, along a strip (as bench_decoupling.py makes them: 320 x 240 pixels, some 300 nodes
in view) or on --sequence, and gives two views of the same map:

  counted   The object `memory` of report.json: bytes of the map by owner, by the capacity of its
            containers. The bytes of the nodes with their edges and of the points are divided by their
            numbers.
  resident  The growth of the process's own pages (RssAnon) over the nodes of frames.csv: the slope of a
            straight line through samples of the run. It includes memory that is counted nowhere. A node
            comes with its points, so it is compared with the whole map divided by its nodes.

--first leaves out the first frames, in which solvers and libraries allocate memory that they keep; a
run of less than a few thousand nodes measures mostly these. The script exits with 1 if the run fails
or the map takes more than --most_node bytes for a node or --most_point bytes for a point, and with 2 on
a wrong call.

  scripts/bench_memory.py
  scripts/bench_memory.py --nodes=50000 --work=/tmp/memory
  scripts/bench_memory.py --sequence=heart
"""
import argparse
import json
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path

from decoupling_runs import NODES_IN_VIEW, make_strip
from program_runs import PROGRAM, ROOT, RunFailed, wrong_call

NODE_OWNERS = ("nodes", "edges", "node_index", "tissue_memory", "levels")
POINT_OWNERS = ("points", "bindings", "point_lists")
SAMPLE_S = 0.2


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of the programs [build/release/apps]")
    parser.add_argument("--work", type=Path, default=ROOT / "build/memory", metavar="DIR",
                        help="folder for sequences and the run [build/memory]")
    parser.add_argument("--sequence", type=Path, metavar="DIR", help="use this sequence instead of a strip")
    parser.add_argument("--nodes", type=int, default=3000, metavar="N",
                        help="nodes of the map at the end of the strip [3000]")
    parser.add_argument("--nodes_in_view", type=int, default=NODES_IN_VIEW, metavar="N",
                        help=f"flag of ed_slam [{NODES_IN_VIEW}]")
    parser.add_argument("--speed", type=float, default=0.05, metavar="SHARE",
                        help="share of the view that the camera moves in a frame [0.05]")
    parser.add_argument("--first", type=int, default=50, metavar="N",
                        help="frame from which growth is counted [50]")
    parser.add_argument("--most_node", type=float, default=1500.0, metavar="BYTES",
                        help="allowed bytes of a node with its edges [1500]")
    parser.add_argument("--most_point", type=float, default=100.0, metavar="BYTES",
                        help="allowed bytes of a point [100]")
    parser.add_argument("--flags", default="", help="more flags of ed_slam [none]")
    parser.add_argument("--fresh", action="store_true", help="simulate again even if --work has the sequence")
    options = parser.parse_args()
    if not (options.bin / "ed_slam").exists():
        wrong_call(f"{options.bin / 'ed_slam'} is not there; build it or name its folder")
    if options.nodes < 400:
        parser.error(f"--nodes={options.nodes}, expected 400 or more")
    options.simulate_flags = ["--width=320", "--height=240"]
    options.work.mkdir(parents=True, exist_ok=True)
    return options


def resident_bytes(pid):
    """Returns the resident memory of a process without mapped files, or None if the process has ended."""
    try:
        lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    except OSError:
        return None
    sizes = [line.split()[1] for line in lines if line.startswith("RssAnon:")]
    return 1024 * int(sizes[0]) if sizes else None


def last_frame(path):
    """Returns frame number and nodes of the last complete row of a frames.csv that is being written."""
    try:
        with open(path, "rb") as file:
            header = file.readline().decode().strip().split(",")
            file.seek(0, 2)
            file.seek(max(0, file.tell() - 4096))
            rows = file.read().decode().split("\n")
    except OSError:
        return None
    # What follows the last line feed isn't whole yet.
    row = rows[-2].split(",") if len(rows) > 1 else []
    if len(row) != len(header) or row[0] == "frame":
        return None
    return int(row[0]), int(float(row[header.index("nodes")]))


def run_sampled(command, frames, log):
    """Runs ed_slam; returns samples (frame, nodes, bytes) of the run."""
    samples = []
    with open(log, "wb") as stderr:
        child = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL,
                                 stderr=stderr)
        while child.poll() is None:
            frame, resident = last_frame(frames), resident_bytes(child.pid)
            if frame and resident and (not samples or samples[-1][0] != frame[0]):
                samples.append((*frame, resident))
            time.sleep(SAMPLE_S)
    if child.returncode != 0:
        raise RunFailed(f"{command[0]}: exit code {child.returncode}, see {log}")
    # The last frame may be followed by results that are being written.
    return samples[:-1]


def slope_of(samples):
    """Returns the slope of bytes over nodes by least squares, or None if the map does not grow."""
    nodes = [sample[1] for sample in samples]
    if len(samples) < 3 or max(nodes) - min(nodes) < 100:
        return None
    mean_nodes = sum(nodes) / len(nodes)
    mean_bytes = sum(sample[2] for sample in samples) / len(samples)
    along = sum((n - mean_nodes) * (sample[2] - mean_bytes) for n, sample in zip(nodes, samples))
    return along / sum((n - mean_nodes) ** 2 for n in nodes)


def lines_of(report, slope):
    memory = report["memory"]
    nodes, points = report["nodes"]["total"], report["map"]["points"]
    yield f"{nodes} nodes, {report['nodes']['edges']} edges, {points} points"
    yield "| owner | MiB | bytes a node | bytes a point |"
    yield "|---|--:|--:|--:|"
    for owner in NODE_OWNERS:
        yield f"| {owner} | {memory[owner] / 2**20:.2f} | {memory[owner] / nodes:.0f} | |"
    for owner in POINT_OWNERS:
        yield f"| {owner} | {memory[owner] / 2**20:.2f} | | {memory[owner] / points:.1f} |"
    yield (f"| map | {memory['map'] / 2**20:.2f} | {memory['per_node']:.0f} | "
           f"{memory['per_point']:.1f} |")
    counted = memory["map"] / nodes
    grown = "does not grow enough to say" if slope is None else f"{slope:.0f} resident"
    yield f"\na node with its {points / nodes:.1f} points: {counted:.0f} bytes counted, {grown}"
    yield (f"process at the end: {memory['resident_mib']:.0f} MiB, at most "
           f"{report['memory_peak_mib']:.0f}")


def main():
    options = parse_options()
    output = options.work / "run"
    shutil.rmtree(output, ignore_errors=True)
    try:
        if options.sequence:
            folder = options.sequence
        else:
            sequence, _ = make_strip(options, options.nodes, ["--truth=false"])
            folder = sequence.folder
        command = [options.bin / "ed_slam", folder, f"--output={output}", "--quiet",
                   "--progress=none", "--threads=1", f"--nodes_in_view={options.nodes_in_view}",
                   "--live_every=0", "--checkpoint_every=0", *shlex.split(options.flags)]
        samples = run_sampled(command, output / "frames.csv", options.work / "run.log")
    except RunFailed as error:
        print(f"{PROGRAM}: {error}", file=sys.stderr)
        return 1
    report = json.loads((output / "report.json").read_text())
    slope = slope_of([sample for sample in samples if sample[0] >= options.first])
    print("\n".join(lines_of(report, slope)))
    memory = report["memory"]
    return 0 if (memory["per_node"] <= options.most_node
                 and memory["per_point"] <= options.most_point) else 1


if __name__ == "__main__":
    sys.exit(main())
