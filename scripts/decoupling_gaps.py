"""Loss against batch, and time, of each way to decouple on whole sequences."""
import shutil
import statistics

from decoupling_runs import (BATCH, DEFAULT, MARGINAL, PAPER_CUT, PAPER_KEEP, WINDOW, is_verified,
                             ring_schemes, slam, times)
from program_runs import RunFailed
from sequence_runs import errors_of, evaluate

# Held against batch in frames.csv; those beside the gap as ed_slam has them.
VERIFIED = ("verify_node_mean", "verify_node_max", "verify_camera_deg", "verify_camera_m")


def gap_schemes(quick, with_rings):
    """Returns the schemes. Batch is the first, because times of the others are relative to it."""
    schemes = [BATCH, MARGINAL, DEFAULT, PAPER_KEEP, PAPER_CUT]
    if with_rings:
        schemes += ring_schemes((0, 2) if quick else (0, 2, 4, 8), "keep", "lazy")
        schemes += ring_schemes((2,), "keep", "full")
        schemes += ring_schemes((0, 2) if quick else (0, 2, 8), "cut", "lazy")
    return schemes


def gaps_of(rows):
    """Returns the mean and the largest gap in percent, and medians of the others that exist."""
    rows = [row for row in rows if is_verified(row)]
    if not rows:
        return {}
    gaps = [100.0 * row["verify_gap"] for row in rows]
    figures = {"verified": len(rows), "gap": statistics.fmean(gaps), "gap_max": max(gaps)}
    for key in VERIFIED:
        figures[key] = statistics.median(row[key] for row in rows)
    return figures


def run_scheme(options, scheme, sequence, frames):
    """Returns one row: times, gaps, errors against the truth, and why the run ended early if it did."""
    output = options.work / "gap_run"
    shutil.rmtree(output, ignore_errors=True)
    flags = [f"--live_every={options.live_every}", "--checkpoint_every=0"]
    if options.verify_every:
        flags.append(f"--verify_every={options.verify_every}")
    rows, note = slam(options, scheme, sequence, output, flags, options.budget_s)
    row = {"sequence": sequence.name, "scheme": scheme.name, "note": note, **scheme.place(),
           "lost": sum(one["status"] == "lost" for one in rows)}
    if note is None and len(rows) < frames:
        row["note"] = f"{len(rows)} of {frames} frames within {options.budget_s:.0f} s"
    if row["note"] is None:
        row.update(times(rows[-WINDOW:]) or {}, **gaps_of(rows))
        try:
            row.update(errors_of(evaluate(options.bin / "ed_eval", sequence, output)))
        except RunFailed as error:
            row["note"] = f"ed_eval: {str(error).splitlines()[-1].strip()}"
    return row


def gaps(options, sequences):
    """Returns a row for each scheme and sequence; `share` is its time relative to batch."""
    rows = []
    for sequence in sequences:
        frames = len(list((sequence.folder / "depth").iterdir()))
        batch_ms = None
        # Every number of rings on the first one alone.
        for scheme in gap_schemes(options.quick, sequence is sequences[0]):
            row = run_scheme(options, scheme, sequence, frames)
            if scheme is BATCH:
                batch_ms = row.get("ms")
            row["share"] = row["ms"] / batch_ms if batch_ms and "ms" in row else None
            rows.append(row)
            options.say(f"{sequence.name}: {scheme.name}: {row['note'] or 'done'}")
    return rows
