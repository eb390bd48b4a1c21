"""Holds the sources to names that both Ceres 2.1 and Ceres 2.2 have.

  check_ceres_names.py [ROOT]

Debian 12 builds with 2.1, where what 2.2 has removed still compiles. Each use of such a name is an
error: one line, and exit code 1.
"""
import re
import sys
from pathlib import Path

FOLDERS = ("apps", "ceres_ed", "cost_functions", "data", "test")
# What the headers of 2.1 (libceres-dev of Debian 12) have and those of 2.2 (of Debian 13) have not.
REMOVED = re.compile(
    r"\b(?:(?:AutoDiff)?LocalParameterization|"
    r"(?:EigenQuaternion|HomogeneousVector|Identity|Line|Product|Quaternion|Subset)Parameterization|"
    r"(?:Get|Has|Set)Parameterization|ParameterBlockLocalSize|local_parameterization_ownership|"
    r"CX_SPARSE|CERES_NO_CXSPARSE|use_postordering|"
    r"ceres/(?:autodiff_)?local_parameterization\.h)\b")


def faults(path, text):
    """Returns a line for each use of a removed name."""
    return [f"{path}:{number}: {match.group()} is not in Ceres 2.2"
            for number, line in enumerate(text.splitlines(), start=1)
            for match in REMOVED.finditer(line)]


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parents[2])
    sources = [path for folder in FOLDERS for path in sorted((root / folder).rglob("*"))
               if path.suffix in (".cc", ".h")]
    if not sources:
        sys.exit(f"{root}: no sources")
    found = [fault for path in sources
             for fault in faults(path.relative_to(root), path.read_text(encoding="utf-8"))]
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
