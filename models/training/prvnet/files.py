"""Files that are there whole or not at all."""

import os
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def whole(path: Path):
    """Gives the path to write to, which becomes `path` when that has gone well. Processes may write the same file side by
    side: the last one's stays."""
    partial = path.with_suffix(f".{os.getpid()}.part")
    yield partial
    partial.rename(path)
