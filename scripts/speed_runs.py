"""Measurements of bench_speed.py: stages of the programs, and benchmarks of the solver."""
import json
import statistics

from program_runs import Variant, run
from sequence_runs import read_frames, times_of, track

FIT_STAGES = ("total", "load", "rigid", "prepare", "graph", "associate", "build", "solve", "finish",
              "write")


def median_of(runs):
    """Returns the median of each figure over the runs, which all have the same figures."""
    return {key: statistics.median(one[key] for one in runs) for key in runs[0]}


def in_turn(variants, runs, measure):
    """Measures the variants A B A B ...; returns {name of the variant: medians}."""
    measured = {variant.name: [] for variant in variants}
    for _ in range(runs):
        for variant in variants:
            measured[variant.name].append(measure(variant))
    return {name: median_of(of_variant) for name, of_variant in measured.items()}


def variants_of(program, options, flags_of_kinds):
    """Returns the variants of `program`, before (where there is such a folder) and after.

    `flags_of_kinds` is {what is added to the name: flags}.
    """
    folders = [("before", options.compare_bin)] if options.compare_bin else []
    folders.append(("after", options.bin / "apps"))
    return [Variant(f"{time}{kind}", folder / program, flags)
            for kind, flags in flags_of_kinds.items() for time, folder in folders]


def measure_fit(pair, options, work):
    """Returns {variant: seconds of each stage, megabytes} of ed_fit."""
    def once(variant):
        report = work / "fit.json"
        _, _, memory = run([variant.program, pair.source, pair.target, "--quiet",
                            f"--output={work / 'fitted.ply'}", f"--report={report}",
                            *variant.flags], work / "fit.log")
        times = json.loads(report.read_text())["time_s"]
        return {**{stage: times[stage] for stage in FIT_STAGES}, "memory_mb": memory}
    return in_turn(variants_of("ed_fit", options, {"": ["--threads=1"]}), options.runs, once)


def measure_track(sequence, options, work):
    """Returns {variant: milliseconds of each stage, megabytes} of ed_slam, on 1 and 2 threads."""
    def once(variant):
        output = work / variant.name.replace(" ", "_").replace(",", "")
        _, cpu, memory = track(variant, sequence, output)
        frames = read_frames(output)
        return {**times_of(frames), "cpu": 1e3 * cpu / max(1, len(frames)), "memory_mb": memory}
    kinds = {"": ["--threads=1"], ", 2 threads": ["--threads=2"]}
    return in_turn(variants_of("ed_slam", options, kinds), options.runs, once)


def measure_benchmark(name, options, work):
    """Returns {name of a benchmark: "ms" of wall time and its counters}, medians.

    The repetitions of all benchmarks of the program run in random order; the result has theirs.
    """
    report = work / f"{name}.json"
    run([options.bin / "test/benchmark" / name, f"--benchmark_out={report}",
         f"--benchmark_repetitions={options.runs}", "--benchmark_min_time=0.1",
         "--benchmark_enable_random_interleaving=true"],
        work / f"{name}.log")
    per_ms = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
    # Keys that are not counters of ours.
    own = {"name", "family_index", "per_family_instance_index", "run_name", "run_type",
           "repetitions", "repetition_index", "threads", "aggregate_name", "aggregate_unit",
           "iterations", "real_time", "cpu_time", "time_unit"}
    entries = [entry for entry in json.loads(report.read_text())["benchmarks"]
               if entry["run_type"] == "iteration"]
    runs = {}
    for entry in sorted(entries, key=lambda entry: (entry["family_index"],
                                                    entry["per_family_instance_index"])):
        counters = {key: value for key, value in entry.items() if key not in own}
        counters["ms"] = entry["real_time"] * per_ms[entry["time_unit"]]
        runs.setdefault(entry["run_name"], []).append(counters)
    return {name: median_of(of_name) for name, of_name in runs.items()}
