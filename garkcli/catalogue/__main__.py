"""``python -m garkcli.catalogue``: updates the index, and the copies in ``methods/``, in a
checkout.

Only files that have changed are analysed; with ``--all`` every one.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from garkcli.catalogue.facts import made, recovered, update_copies
from garkcli.errors import GarkError
from garkcli.order.recovered import FILE, kept

HERE = Path(__file__).resolve().parent


def main(arguments: Sequence[str]) -> int:
    """Returns 2 if a file is not a method."""
    data, index = HERE / "data", HERE / "index.json"
    before = ""
    if "--all" in arguments:
        FILE.unlink(missing_ok=True)
    elif index.exists():
        before = index.read_text(encoding="utf-8")
    try:
        FILE.write_bytes(recovered(data, kept(), before).encode("ascii"))
        text = made(data, before, _tell)
    except GarkError as error:
        print(f"gark: {error}", file=sys.stderr)
        return 2
    index.write_bytes(text.encode("ascii"))
    copies = HERE.parents[1] / "methods"
    if copies.is_dir():
        for copy in update_copies(data, copies):
            print(f"{copy.name} copied", file=sys.stderr)
    return 0


def _tell(name: str) -> None:
    print(name, file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
