"""Holds the includes of the library and the programs to the layers of ceres_ed/README.md.

  check_includes.py [ROOT]

The table under "## Layers" names each layer and the layers that it may include. An include that the
table does not allow, a layer that the table lacks, a circle of headers, and a stage that includes the
entry point of its own layer are errors: one line each, and exit code 1.
"""
import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^#include [<"]((?:ceres_ed|cost_functions|apps)/[^>"]+)[>"]', re.MULTILINE)
ROW = re.compile(r"^\| `([a-z0-9_]+)` \|[^|]*\| ([^|]*) \|$", re.MULTILINE)
# Whoever runs the stages of a layer; no stage knows it.
ENTRY_POINTS = {"ceres_ed/registration/fit.h": {"fit.cc"},
                "ceres_ed/slam/slam.h": {"slam.cc", "tracker.h", "tracked_points.h"}}


def layer_of(path):
    """ceres_ed/solver/covariance/x.h -> solver; cost_functions/x.h -> cost_functions."""
    parts = path.split("/")
    if parts[0] == "ceres_ed":
        return parts[1] if len(parts) > 2 else "ceres_ed"
    return parts[0]


def read_layers(page):
    """Returns the layers that each layer may include: those of its row, and all below them."""
    direct = {name: set(re.findall(r"`([a-z0-9_]+)`", cell)) for name, cell in ROW.findall(page)}
    allowed = {}

    def below(name, above):
        if name in above:
            raise ValueError(f"the layers {' -> '.join(above)} -> {name} are a circle")
        if name not in allowed:
            if name not in direct:
                raise ValueError(f"the table has no row for `{name}`")
            allowed[name] = set(direct[name])
            for lower in direct[name]:
                allowed[name] |= below(lower, above + [name])
        return allowed[name]

    for name in direct:
        below(name, [])
    return allowed


def find_circle(includes):
    """Returns headers that include one another in a circle, or nothing."""
    done, path = set(), []

    def visit(header):
        if header in path:
            return path[path.index(header):] + [header]
        if header in done or header not in includes:
            return None
        path.append(header)
        for other in includes[header]:
            circle = visit(other)
            if circle:
                return circle
        path.pop()
        done.add(header)
        return None

    for header in includes:
        circle = visit(header)
        if circle:
            return circle
    return None


def check(root):
    """Returns one sentence for each include that must not be."""
    root = Path(root)
    try:
        allowed = read_layers((root / "ceres_ed/README.md").read_text(encoding="utf-8"))
    except ValueError as error:
        return [f"ceres_ed/README.md: {error}"]
    errors, headers = [], {}
    files = sorted(path for folder in ("ceres_ed", "cost_functions", "apps")
                   for path in (root / folder).rglob("*")
                   if path.suffix in (".h", ".cc") and "examples" not in path.parts)
    for path in files:
        name = str(path.relative_to(root))
        includes = INCLUDE.findall(path.read_text(encoding="utf-8"))
        if path.suffix == ".h":
            headers[name] = includes
        layer = layer_of(name)
        if layer not in allowed:
            errors.append(f"{name}: the layer {layer} has no row in the table of layers")
            continue
        for include in includes:
            target = layer_of(include)
            if target not in (layer, "ceres_ed") and target not in allowed[layer]:
                errors.append(f"{name} includes {include}: {layer} may not include {target}")
            if (include in ENTRY_POINTS and layer == layer_of(include)
                    and path.name not in ENTRY_POINTS[include]):
                errors.append(f"{name} includes {include}: a stage must not know what runs it")
    circle = find_circle(headers)
    if circle:
        errors.append("headers include one another: " + " -> ".join(circle))
    return errors


if __name__ == "__main__":
    found = check(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2])
    print("\n".join(found) if found else "every include follows the layers")
    sys.exit(1 if found else 0)
