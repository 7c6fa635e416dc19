"""Which objects are trained on, chosen between, and held out: by a hash of the object, never by row.

An object keeps its fold when others are added, and all its sizes and variants share it.
"""

import hashlib
import re

FOLDS = 10
# Splits that together hold every object out once.
TURNS = 5


def group_of(key: str) -> str:
    """The object key without what marks a size or a variant (`#...`, `@...` or `~texture=...` at its end)."""
    return re.split(r"[#@~]", key, maxsplit=1)[0]


def fold_of(group: str) -> int:
    """A number from 0 to 9, the same on every machine."""
    return int.from_bytes(hashlib.sha256(group.encode()).digest()[:8], "big") % FOLDS


def split(rows, turn: int = 0):
    """(train, validation, test) with 7, 1 and 2 of ten folds; `turn` 0 to 4 moves on to the next test folds."""
    test = {2 * turn, 2 * turn + 1}
    validation = {(2 * turn + 2) % FOLDS}
    parts = ([], [], [])
    for row in rows:
        fold = fold_of(row.group)
        parts[2 if fold in test else 1 if fold in validation else 0].append(row)
    return parts
