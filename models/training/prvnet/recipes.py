"""recipes.json: what `prvnet.compare` compares.

    {"defaults": {options of prvnet.train}, "pretraining": {NAME: {options of prvnet.pretrain}},
     "recipes": [{"name": NAME, "kind": "constant" | "statistics" | "network", "slow": bool, "pretraining": NAME,
                  "options": {options of prvnet.train}}]}

A recipe is a network unless it says otherwise; those marked slow are run only when asked for.
"""

import json
import re
from dataclasses import dataclass, field
from pathlib import Path

DEFAULT = Path(__file__).parents[1] / "recipes.json"
KINDS = ("constant", "statistics", "network")


@dataclass(frozen=True)
class Recipe:
    name: str
    kind: str = "network"
    slow: bool = False
    options: dict = field(default_factory=dict)
    """Options of `prvnet.train`, by the names of its flags."""
    pretraining: str | None = None
    """The name of the pre-training whose weights the encoder starts from."""
    pretraining_options: dict = field(default_factory=dict)
    """Its options of `prvnet.pretrain`."""


def folder_of(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9._-]+", "-", name)


def flags(options: dict) -> list[str]:
    """{"encoder-lr": 1e-4, "freeze": false} to ["--encoder-lr", "0.0001", "--no-freeze"]."""
    result = []
    for key, value in options.items():
        key = key.replace("_", "-")
        if isinstance(value, bool):
            result.append(f"--{key}" if value else f"--no-{key}")
        else:
            result += [f"--{key}", str(value)]
    return result


def read(path: Path) -> list[Recipe]:
    try:
        table = json.loads(path.read_text())
        entries = table["recipes"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise SystemExit(f"{path} is not a file of recipes: {error!r}") from None
    defaults, pretrainings, result = table.get("defaults", {}), table.get("pretraining", {}), []
    for entry in entries:
        unknown = entry.keys() - {"name", "kind", "slow", "pretraining", "options"}
        kind, before = entry.get("kind", "network"), entry.get("pretraining")
        if "name" not in entry or unknown or kind not in KINDS or (before is not None and before not in pretrainings):
            raise SystemExit(f"{path}: {json.dumps(entry)} is not a recipe")
        options = {**defaults, **entry.get("options", {})} if kind == "network" else {}
        slow = bool(entry.get("slow", False))
        result.append(Recipe(entry["name"], kind, slow, options, before, pretrainings.get(before, {})))
    if len({folder_of(recipe.name) for recipe in result}) < len(result):
        raise SystemExit(f"{path}: two recipes have the same name")
    return result


def chosen(recipes: list[Recipe], slow: bool, only: str | None) -> list[Recipe]:
    """Those to run: named ones (by commas), or all but the slow ones."""
    if not only:
        return [recipe for recipe in recipes if slow or not recipe.slow]
    names = [name.strip() for name in only.split(",")]
    missing = set(names) - {recipe.name for recipe in recipes}
    if missing:
        raise SystemExit(f"no recipe is named {', '.join(sorted(missing))}")
    return [recipe for recipe in recipes if recipe.name in names]
