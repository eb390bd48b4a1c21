#!/usr/bin/env python3
"""Measures cohorts: python3 scripts/bench_cohort.py [SECTION ...] [--folder=DIR] [--build=build/release]

  family   modes of 200 made-up dolphins (data/make_shapes.cc) against those that were put in; generalisation and
           specificity of the model
  data     landmark errors of the correspondences on mouse_skulls and vertebrae (folders of CERES_ED_DATA); the
           landmarks measure, and draw nothing
  speed    shapes a minute by --jobs
  memory   peak memory by the number of points of a shape
  collect  time and peak memory of --collect for 200, 2,000 and 20,000 made-up results
  kill     a run that is killed at 30 random moments and goes on each time, against an unbroken one

Without sections, all of them. With --folder, results stay there, and fits that are there are not run again. Needs
numpy and the programs; make_shapes is built by `cmake --build build/release --target make_shapes`.
"""
import argparse
import csv
import filecmp
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
ARRAYS = ["correspondences.npy", "aligned.npy", "mean.ply", "components.npy", "scores.csv", "rows.csv"]


class Bench:
    def __init__(self, build, folder):
        self.build, self.folder = Path(build), Path(folder)

    def program(self, name):
        return str(self.build / ("data" if name == "make_shapes" else "apps") / name)

    def run(self, *arguments, accepted=(0,)):
        """Runs ed_cohort; returns wall seconds, CPU seconds and peak megabytes."""
        start = time.monotonic()
        process = subprocess.Popen([self.program("ed_cohort"), "--quiet", *map(str, arguments)])
        _, status, usage = os.wait4(process.pid, 0)
        code = os.waitstatus_to_exitcode(status)
        if code not in accepted:
            sys.exit(f"bench_cohort.py: exit code {code} of ed_cohort {' '.join(map(str, arguments))}")
        return time.monotonic() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024

    def family(self, shapes, vertices):
        """Returns the folder of a family of shapes, made if it is not there."""
        folder = self.folder / f"family_{shapes}_{vertices}"
        if not (folder / "shapes.csv").exists():
            subprocess.run([self.program("make_shapes"), folder, str(shapes), str(vertices)], check=True)
        return folder


def summary_of(folder):
    with open(folder / "summary.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def rotation_to(points, other):
    """Returns the rotation that takes centred points (V, 3) to others best, from the right."""
    u, _, v = np.linalg.svd(points.T @ other)
    return u @ np.diag([1, 1, np.sign(np.linalg.det(u @ v))]) @ v


def align(shapes):
    """Generalised Procrustes of (N, V, 3), without the code of the library; returns also the mean."""
    shapes = shapes - shapes.mean(1, keepdims=True)
    sizes = np.linalg.norm(shapes, axis=(1, 2))
    shapes /= sizes[:, None, None]
    mean, change = shapes[0], 1.0
    while change > 1e-10:
        shapes = np.array([shape @ rotation_to(shape, mean) for shape in shapes])
        following = shapes.mean(0)
        following /= np.linalg.norm(following)
        change, mean = np.linalg.norm(following - mean), following
    return shapes * sizes.mean(), mean * sizes.mean()


def modes(shapes):
    flat = (shapes - shapes.mean(0)).reshape(len(shapes), -1)
    _, values, rows = np.linalg.svd(flat, full_matrices=False)
    return values**2 / (len(shapes) - 1), rows


def bench_family(bench):
    family = bench.family(200, 2600)
    out = bench.folder / "family_out"
    wall, cpu, _ = bench.run(family / "template.ply", f"--manifest={family}/shapes.csv", f"--output={out}")
    found, mean = align(np.load(out / "aligned.npy"))
    truth, true_mean = align(np.load(family / "truth.npy"))
    truth = truth @ rotation_to(true_mean, mean)
    used = [int(row["name"][-4:]) for row in csv.DictReader(open(out / "rows.csv", encoding="utf-8"))]
    variances, components = modes(found)
    true_variances, true_components = modes(truth)
    verdicts = [row["verdict"] for row in summary_of(out)]
    diagonal = np.linalg.norm(np.ptp(mean, axis=0))
    error = np.linalg.norm(found - truth[used], axis=2)
    print(f"\n200 made-up dolphins, 2,600 points: {verdicts.count('good')} good, {verdicts.count('doubtful')} doubtful, "
          f"{verdicts.count('bad')} bad; {wall:.0f} s, {cpu:.0f} s of CPU (if they were run now)")
    print(f"error of the correspondences: mean {100 * error.mean() / diagonal:.2f} %, 95th percentile "
          f"{100 * np.percentile(error, 95) / diagonal:.2f} % of the diagonal")
    print("| mode | true share of the variance | found / true variance | angle |\n|---|---|---|---|")
    for k in range(3):
        cosine = min(1.0, abs(components[k] @ true_components[k]))
        print(f"| {k + 1} | {100 * true_variances[k] / true_variances.sum():.1f} % | "
              f"{variances[k] / true_variances[k]:.3f} | {np.degrees(np.arccos(cosine)):.1f} deg |")
    quality = json.loads((out / "statistics.json").read_text())["quality"]
    print("| components | generalisation | specificity |\n|---|---|---|")
    for k in (1, 2, 3, 5, 10):
        print(f"| {k} | {100 * quality['generalization'][k - 1] / diagonal:.3f} % | "
              f"{100 * quality['specificity'][k - 1] / diagonal:.3f} % |")


def data_folder(name):
    folder = Path(os.environ.get("CERES_ED_DATA", "")) / name
    return folder if os.environ.get("CERES_ED_DATA") and folder.is_dir() else None


def bench_data(bench):
    for name, template, extra in (("mouse_skulls", "C57BL6_J", []), ("vertebrae", "ref_20", [])):
        folder = data_folder(name)
        if folder is None:
            print(f"\n{name}: left out, CERES_ED_DATA names no folder with it")
            continue
        out = bench.folder / f"{name}_out"
        out.mkdir(parents=True, exist_ok=True)
        shapes = sorted(path.stem for path in folder.glob("*.ply") if path.stem != template)
        table = out / "shapes.csv"
        table.write_text("path,landmarks\n" + "".join(
            f"{folder}/{shape}.ply,{folder}/{shape}.landmarks.csv\n" for shape in shapes))
        bench.run(folder / f"{template}.ply", f"--manifest={table}", f"--output={out}", "--worst=bad", *extra,
                  f"--source_landmarks={folder}/{template}.landmarks.csv", "--landmark_use=measure")
        statistics = json.loads((out / "statistics.json").read_text())
        print(f"\n{name}: {template} to {len(shapes)} others; rms of landmarks that draw nothing, % of the diagonal")
        print("| shape | verdict | rigid | after the fit | seconds |\n|---|---|---|---|---|")
        for row in sorted(summary_of(out), key=lambda row: row["name"]):
            report = json.loads((out / "members" / row["name"] / "report.json").read_text())
            percent = 100 / report["target"]["diagonal"]
            print(f"| {row['name']} | {row['verdict']} | {percent * report['landmarks']['rigid']['rms']:.2f} | "
                  f"{percent * report['landmarks']['after']['rms']:.2f} | {float(row['seconds']):.0f} |")
        quality = statistics["quality"]
        if quality["shapes"]:
            print("generalisation " + ", ".join(f"{value:.3g}" for value in quality["generalization"]) +
                  "; specificity " + ", ".join(f"{value:.3g}" for value in quality["specificity"]) +
                  " (file units, by components)")


def bench_speed(bench):
    family = bench.family(24, 2600)
    print("\n24 dolphins of 2,600 points\n| jobs | seconds | shapes a minute | CPU seconds | ratio |\n|---|---|---|---|---|")
    first = None
    for jobs in (1, 2):
        walls, cpus = [], []
        for _ in range(3):
            out = bench.folder / "speed_out"
            shutil.rmtree(out, ignore_errors=True)
            wall, cpu, _ = bench.run(family / "template.ply", f"--manifest={family}/shapes.csv", f"--output={out}",
                                     f"--jobs={jobs}")
            walls.append(wall)
            cpus.append(cpu)
        first = first or min(walls)
        print(f"| {jobs} | {min(walls):.1f} | {24 * 60 / min(walls):.0f} | {min(cpus):.1f} | {first / min(walls):.2f} |",
              flush=True)
    print(f"load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


def bench_memory(bench):
    print("\nOne shape at a time\n| points of template and shape | peak | by point |\n|---|---|---|")
    for vertices in (1000, 5000, 20000, 80000):
        family = bench.family(1, vertices)
        out = bench.folder / "memory_out"
        shutil.rmtree(out, ignore_errors=True)
        _, _, peak = bench.run(family / "template.ply", f"--manifest={family}/shapes.csv", f"--output={out}", "--jobs=1")
        print(f"| {vertices} | {peak:.0f} MB | {peak * 1024 / vertices:.1f} kB |", flush=True)


def make_results(bench, folder, count, vertices):
    """Writes finished results of `count` shapes, as if they had been fitted."""
    family = bench.family(1, vertices)
    shutil.rmtree(folder, ignore_errors=True)
    bench.run(family / "template.ply", f"--manifest={family}/shapes.csv", f"--output={folder}", "--pages=false")
    member = folder / "members" / "shape_0000"
    record = json.loads((member / "record.json").read_text())
    points = np.load(member / "points.npy")
    index = json.loads((folder / "cohort.json").read_text())
    rng = np.random.default_rng(1)
    modes_made = rng.normal(size=(10,) + points.shape)
    index["members"] = []
    for i in range(count):
        name = f"made_{i:05d}"
        index["members"].append({"name": name, "path": "", "group": "ab"[i % 2]})
        target = folder / "members" / name
        target.mkdir()
        record["name"] = name
        (target / "record.json").write_text(json.dumps(record))
        amplitudes = rng.normal(size=10) * np.arange(10, 0, -1) * 0.1
        np.save(target / "points.npy", points + np.tensordot(amplitudes, modes_made, 1) + 0.02 * rng.normal(size=points.shape))
    (folder / "cohort.json").write_text(json.dumps(index))


def bench_collect(bench):
    vertices = 1000
    print(f"\n--collect of made-up results, {vertices} points, two groups, 1000 permutations\n"
          "| shapes | seconds | CPU seconds | peak |\n|---|---|---|---|")
    for count in (200, 2000, 20000):
        folder = bench.folder / "collect_out"
        make_results(bench, folder, count, vertices)
        wall, cpu, peak = bench.run("--collect", folder)
        print(f"| {count} | {wall:.1f} | {cpu:.1f} | {peak:.0f} MB |", flush=True)
        shutil.rmtree(folder)
    print(f"load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


def bench_kill(bench, kills=30):
    family = bench.family(12, 1000)
    whole, broken = bench.folder / "kill_whole", bench.folder / "kill_broken"
    for folder in (whole, broken):
        shutil.rmtree(folder, ignore_errors=True)
    arguments = [family / "template.ply", f"--manifest={family}/shapes.csv"]
    wall, _, _ = bench.run(*arguments, f"--output={whole}")
    random.seed(1)
    killed = 0
    while killed < kills:
        process = subprocess.Popen([bench.program("ed_cohort"), "--quiet", *map(str, arguments), f"--output={broken}"])
        try:
            # Long enough that something is done, and too short for all.
            process.wait(timeout=random.uniform(0.0, wall / 4))
            # All is done: begin anew, so that every kill has something to break.
            shutil.rmtree(broken)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
            killed += 1
    bench.run(*arguments, f"--output={broken}")
    differ = [name for name in ARRAYS if not filecmp.cmp(whole / name, broken / name, shallow=False)]
    for member in (whole / "members").iterdir():
        for name in ("fitted.ply", "points.npy"):
            if not filecmp.cmp(member / name, broken / "members" / member.name / name, shallow=False):
                differ.append(f"{member.name}/{name}")
    left = list((broken / ".work").iterdir())
    print(f"\nkilled {killed} times with SIGKILL and resumed: "
          f"{'differs in ' + ', '.join(differ) if differ else 'same bytes as an unbroken run'}; "
          f"{len(left)} unfinished folders are left")
    if differ or left:
        sys.exit(1)


SECTIONS = {"family": bench_family, "data": bench_data, "speed": bench_speed, "memory": bench_memory,
            "collect": bench_collect, "kill": bench_kill}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sections", nargs="*", choices=[*SECTIONS, []])
    parser.add_argument("--folder")
    parser.add_argument("--build", default=str(ROOT / "build/release"))
    arguments = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(arguments.folder or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        bench = Bench(arguments.build, folder)
        for section in arguments.sections or SECTIONS:
            SECTIONS[section](bench)


if __name__ == "__main__":
    main()
