"""Tables on the terminal and in pages, including those of bench_pairs.py."""
import csv
import sys
from pathlib import Path

from program_runs import PROGRAM, ROOT

PUBLISHED = ROOT / "data" / "published.csv"
# The page that has the tables of pairs and of sequences.
PAGE = ROOT / "test/benchmark/README.md"
BEGIN, END = "<!-- bench_pairs.py: begin -->", "<!-- bench_pairs.py: end -->"

# Field, heading, decimals. Compared variants show the ratio B/A of those in RATIOS.
COLUMNS = [
    ("pair", "pair", None), ("nothing", "nothing %", 2), ("rigid", "rigid %", 2),
    ("truth", "truth %", 3), ("surface", "surface %", 3), ("trimmed", "trimmed %", 3),
    ("backward", "target %", 3), ("edge_p99", "edge p99 %", 1), ("truth_edge_p99", "true p99 %", 1),
    ("flipped", "flips", 0), ("truth_flipped", "true flips", 0), ("time_s", "time s", 2),
    ("wall_s", "wall s", 2), ("cpu_s", "cpu s", 2), ("memory_mb", "MB", 0),
    ("nodes", "nodes", 0), ("inliers", "inliers", 0),
]
RATIOS = ("truth", "surface", "trimmed", "backward", "time_s", "wall_s", "cpu_s", "memory_mb")


def cell(value, decimals):
    if value is None:
        return "-"
    return str(value) if decimals is None else f"{value:.{decimals}f}"


def ratio_row(a, b, columns=COLUMNS, ratios=RATIOS):
    """Returns the row of the ratios B/A, with the name from the first of `columns`."""
    name = columns[0][0]
    row = {key: None for key, _, _ in columns}
    row.update({name: a[name], "variant": "B/A"})
    for key in ratios:
        row[key] = b[key] / a[key] if a[key] and b[key] is not None else None
    return row


def print_table(rows, compared, columns=COLUMNS, ratios=RATIOS):
    columns = ([("variant", "", None)] if compared else []) + columns
    lines = [[heading for _, heading, _ in columns]]
    for row in rows:
        decimals = 2 if row["variant"] == "B/A" else None
        lines.append([cell(row[key], decimals if decimals and key in ratios else default)
                      for key, _, default in columns])
    if compared:  # the name stands first
        lines = [[line[1], line[0]] + line[2:] for line in lines]
    text_columns = 2 if compared else 1
    widths = [max(len(line[i]) for line in lines) for i in range(len(columns))]
    for line in lines:
        print("  ".join(text.ljust(width) if i < text_columns else text.rjust(width)
                        for i, (text, width) in enumerate(zip(line, widths))))


def published_figures():
    """Returns {pair: {program: errors and seconds, or why there are none}} of data/published.csv."""
    figures = {}
    with open(PUBLISHED, newline="") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            parts = [f"{name} {row[name + '_percent']}" for name in ("truth", "surface")
                     if row[name + "_percent"]]
            if row["seconds"]:
                parts.append(f"{row['seconds']} s")
            figures.setdefault(row["pair"], {})[row["program"]] = ", ".join(parts) or row["note"]
    return figures


def table(headings, rows):
    lines = ["| " + " | ".join(headings) + " |", "|---|" + "--:|" * (len(headings) - 1)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def shipped_row(row):
    places = (("nothing", 2), ("rigid", 2), ("truth", 2), ("backward", 3), ("edge_p99", 1),
              ("flipped", 0), ("time_s", 1), ("memory_mb", 0), ("nodes", 0))
    return [f"`{row['pair']}`"] + [cell(row[key], decimals) for key, decimals in places]


def real_row(row, published):
    others = published.get(row["pair"], {})
    errors = [] if row["truth"] is None else [f"truth {row['truth']:.3f}"]
    # Most of the result has no counterpart in a partial target: then there is no distance both ways.
    if row["truth"] is None or any("surface" in text for text in others.values()):
        errors.append(f"surface {row['surface']:.3f}")
    return [row["pair"], cell(row["nothing"], 1), cell(row["rigid"], 1), ", ".join(errors),
            f"{row['time_s']:.1f}", others.get("SPARE", "-"), others.get("AMM_NRR", "-")]


def markdown(rows):
    """Returns the tables of the page: shipped pairs, then those by others."""
    shipped = [row for row in rows if (ROOT / "data" / row["pair"]).is_dir()]
    real = [row for row in rows if row not in shipped]
    lines = table(["shipped pair", "nothing %", "rigid %", "truth %", "target %", "edge p99 %",
                   "flips", "s", "MB", "nodes"], [shipped_row(row) for row in shipped])
    if real:
        published = published_figures()
        lines += [""] + table(["pair by others", "nothing %", "rigid %", "`ed_fit` %", "s",
                               "SPARE", "AMM_NRR"], [real_row(row, published) for row in real])
    return "\n".join(lines)


def add_page_option(parser, default, what):
    """Adds --page, which also puts `what` into a page: `default` where no other is named."""
    parser.add_argument("--page", nargs="?", const=default, type=Path, metavar="FILE",
                        help=f"also put {what} between the marks of this page "
                        f"[{default.relative_to(ROOT)}]")


def check_marks(path, begin, end):
    """Returns the text of the file at `path`; ends the program unless it has both marks exactly once."""
    page = Path(path).read_text()
    if page.count(begin) != 1 or page.count(end) != 1:
        sys.exit(f"{PROGRAM}: {path} lacks the marks {begin} and {end}")
    return page


def write_between(path, begin, end, text):
    """Puts `text` between the two marks of the file at `path`."""
    page = check_marks(path, begin, end)
    head, tail = page.split(begin)[0], page.split(end)[1]
    Path(path).write_text(f"{head}{begin}\n{text}\n{end}{tail}")


def write_page(path, rows):
    write_between(path, BEGIN, END, markdown(rows))
