"""Pairs of surfaces, and runs of programs that fit them, for benchmark and ablation."""
import filecmp
import json
import statistics
import sys

from program_runs import PROGRAM, apart, run, wrong_call

MEDIANS = ("time_s", "wall_s", "cpu_s", "memory_mb")


class Pair:
    """A folder with two surfaces and perhaps the truth."""

    def __init__(self, folder, target):
        self.name = folder.name
        self.source = folder / "source.ply"
        self.target = folder / target if (folder / target).exists() else folder / "target.ply"
        truth = folder / "gt.ply"
        self.truth = truth if truth.exists() else None
        # Such a list is there where the target shows one side alone.
        self.partial = (folder / "visible.txt").exists()
        self._before = None

    def before(self, ed_eval, work):
        """Returns the figures that do not depend on a fit; each is None if there is no truth."""
        if self._before is None and self.truth:
            nothing = evaluate(ed_eval, self.source, self, work)
            truth = evaluate(ed_eval, self.truth, self, work)["shape"]
            self._before = {"nothing": nothing["truth"]["mean_percent"],
                            "rigid": apart(rigid_error, self, nothing["diagonal"]),
                            "truth_edge_p99": 100.0 * truth["edge_p99"],
                            "truth_flipped": truth["flipped"]}
        return self._before or dict.fromkeys(("nothing", "rigid", "truth_edge_p99",
                                              "truth_flipped"))


def find_pairs(folders, names, target="target.ply"):
    """Returns the pairs in `folders`, or only those of `names` if there are any names."""
    pairs = []
    for folder in folders:
        if not folder.is_dir():
            wrong_call(f"{folder} is no folder")
        pairs += [Pair(source.parent, target) for source in sorted(folder.glob("*/source.ply"))
                  if (source.parent / "target.ply").exists()]
    if names:
        unknown = set(names) - {pair.name for pair in pairs}
        if unknown:
            wrong_call(f"no pair {', '.join(sorted(unknown))}; there are "
                       f"{', '.join(pair.name for pair in pairs)}")
        pairs = [pair for pair in pairs if pair.name in names]
    if not pairs:
        wrong_call("no pairs found")
    return pairs


def write_subdivided(pair, folder):
    import ply
    source = ply.read_ply(pair.source)
    target = ply.read_ply(pair.target)
    files = [("source.ply", source, source), ("target.ply", target, target)]
    if pair.truth:
        files.append(("gt.ply", ply.read_ply(pair.truth), source))
    for name, surface, meshed in files:
        ply.write_ply(folder / name, *ply.subdivide(ply.points(surface), ply.triangles(meshed)))


def subdivided(pair, work):
    """Returns the pair with every triangle of source, target and truth cut into four.

    Its files are new ones in `work`. Needs numpy.
    """
    folder = work / f"{pair.name}_subdivided"
    folder.mkdir()
    try:
        apart(write_subdivided, pair, folder)
    except ImportError as error:
        wrong_call(f"--subdivide: {error}; install python3-numpy")
    return Pair(folder, "target.ply")


def evaluate(ed_eval, result, pair, work):
    report = work / "eval.json"
    command = [ed_eval, result, pair.target, f"--source={pair.source}", f"--report={report}"]
    if pair.truth:
        command.append(f"--truth={pair.truth}")
    run(command, work / "eval.log")
    return json.loads(report.read_text())


def rigid_error(pair, diagonal):
    """Returns the residual of the best rigid motion in percent, or None without truth or numpy."""
    try:
        import numpy as np
        import ply
    except ImportError:
        return None
    try:
        source = ply.points(ply.read_ply(pair.source))
        truth = ply.points(ply.read_ply(pair.truth))
    except ValueError:
        return None
    a, b = source - source.mean(axis=0), truth - truth.mean(axis=0)
    u, _, vt = np.linalg.svd(a.T @ b)
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    return 100.0 * np.linalg.norm(a @ (u @ flip @ vt) - b, axis=1).mean() / diagonal


def fit_once(variant, pair, work):
    """Runs the program, called as ed_fit is; returns its row of times and counts."""
    report = work / "fit.json"
    command = [variant.program, pair.source, pair.target, f"--output={work / 'fitted.ply'}",
               f"--report={report}", "--quiet"] + variant.flags
    wall, cpu, memory = run(command, work / "fit.log")
    fit = json.loads(report.read_text())
    return {"time_s": fit["time_s"]["total"], "wall_s": wall, "cpu_s": cpu, "memory_mb": memory,
            "nodes": fit["nodes"]["total"], "inliers": fit["inliers"], "status": fit["status"]}


def summarise(runs, pair, ed_eval, result, work):
    evaluation = evaluate(ed_eval, result, pair, work)
    shape = evaluation["shape"]
    row = dict(runs[0], pair=pair.name, **pair.before(ed_eval, work))
    row.update({key: statistics.median(one[key] for one in runs) for key in MEDIANS})
    row["backward"] = evaluation["backward"]["mean_percent"]
    # Of a partial target most of the result has no counterpart.
    row["partial"] = pair.partial
    surface = evaluation["backward" if pair.partial else "symmetric"]
    row["surface"] = surface["mean_percent"]
    row["trimmed"] = 100.0 * surface["trimmed"] / evaluation["diagonal"]
    row["edge_p99"], row["flipped"] = 100.0 * shape["edge_p99"], shape["flipped"]
    row["truth"] = evaluation["truth"]["mean_percent"] if pair.truth else None
    return row


def bench_pair(variants, pair, options, work):
    """Fits options.runs times, the variants in turn, and measures with options.ed_eval.

    Returns a row per variant, in the order of the variants, and whether all runs of each agreed.
    """
    runs = {variant.name: [] for variant in variants}
    agreed = True
    for _ in range(options.runs):
        for variant in variants:
            runs[variant.name].append(fit_once(variant, pair, work))
            fitted, first = work / "fitted.ply", work / f"first_{variant.name}.ply"
            if len(runs[variant.name]) == 1:
                fitted.replace(first)
            elif not filecmp.cmp(fitted, first, shallow=False):
                print(f"{PROGRAM}: {pair.name}: two runs of {variant.name} differ",
                      file=sys.stderr)
                agreed = False
    rows = []
    for variant in variants:
        first = work / f"first_{variant.name}.ply"
        row = summarise(runs[variant.name], pair, options.ed_eval, first, work)
        rows.append(dict(row, variant=variant.name))
    return rows, agreed
