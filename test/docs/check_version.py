"""Checks that the version of the project stands everywhere: check_version.py SOURCES VERSION."""

import re
import subprocess
import sys
from pathlib import Path


def versions(source: Path) -> dict[str, str]:
    """Returns what each place says, by its name; a tag of the checked-out commit is one of them."""
    changelog = (source / "CHANGELOG.md").read_text()
    found = {
        "CHANGELOG.md": re.search(r"^## (\S+)", changelog, re.MULTILINE).group(1),
        "CITATION.cff": re.search(r"^version: (\S+)", (source / "CITATION.cff").read_text(), re.MULTILINE).group(1),
    }
    tags = subprocess.run(["git", "-C", str(source), "tag", "--points-at", "HEAD", "--list", "v*"],
                          capture_output=True, text=True, check=False).stdout.split()
    found.update({f"tag {tag}": tag[1:] for tag in tags})
    return found


def main() -> int:
    source, expected = Path(sys.argv[1]), sys.argv[2]
    wrong = {place: version for place, version in versions(source).items() if version != expected}
    for place, version in wrong.items():
        print(f"{place} says {version}, CMakeLists.txt {expected}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
