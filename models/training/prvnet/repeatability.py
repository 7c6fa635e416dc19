"""How far two labels of the same object at the same size are apart.

    python -m prvnet.repeatability models/labels.csv models/label_repeats.csv

The second file comes from `prv label --repeat 1`: other NeRF seeds, turns of the view sets and test views.
"""

import argparse
import csv
from pathlib import Path

import numpy as np

from .labels import TARGETS

NAMES = {
    "v_gain": "v_gain, the label (one more view brings less than 0.05 dB)",
    "v_near": "v_near (within 0.5 dB of 100 views)",
    "v_star": "v*, the paper's (orthogonal fit, less than 0.02 dB)",
}


def pairs(first: Path, second: Path, target: str) -> np.ndarray:
    """[n, 2] labels of what both files hold."""
    tables = []
    for path in (first, second):
        with open(path, newline="") as file:
            rows = {(line["object"], line["draw"]): line[target] for line in csv.DictReader(file)}
        tables.append({key: float(value) for key, value in rows.items() if value})
    keys = sorted(tables[0].keys() & tables[1].keys())
    return np.array([[tables[0][key], tables[1][key]] for key in keys]).reshape(-1, 2)


def lines(first: Path, second: Path) -> list[str]:
    """A Markdown table."""
    text = ["| labels measured twice | objects | mean difference | spread between objects (sd) | correlation |"]
    text.append("|---|---|---|---|---|")
    for target in TARGETS:
        both = pairs(first, second, target)
        if len(both) < 3:
            continue
        apart = np.abs(both[:, 0] - both[:, 1]).mean()
        spread, correlation = both.mean(1).std(ddof=1), np.corrcoef(both.T)[0, 1]
        text.append(f"| {NAMES[target]} | {len(both)} | {apart:.2f} views | {spread:.1f} views | {correlation:.2f} |")
    return text


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("first", type=Path)
    parser.add_argument("second", type=Path)
    args = parser.parse_args(argv)
    print("\n".join(lines(args.first, args.second)))


if __name__ == "__main__":
    main()
