"""What is compared, and with which options: no network library needed."""

import json

import pytest

from prvnet import recipes


def test_the_committed_recipes_can_be_read_and_the_slow_ones_wait():
    every = recipes.read(recipes.DEFAULT)
    quick = recipes.chosen(every, slow=False, only=None)
    assert [recipe.kind for recipe in quick[:2]] == ["constant", "statistics"]
    assert {recipe.options.get("encoder") for recipe in quick[2:]} == {"efficientnet_lite0", "efficientnet_lite1", "efficientnet_lite2"}
    assert len(recipes.chosen(every, slow=True, only=None)) == len(every) > len(quick)
    assert [recipe.name for recipe in recipes.chosen(every, slow=False, only="paper")] == ["paper"]
    assert all(recipe.pretraining_options for recipe in every if recipe.pretraining)


def test_options_become_flags_and_defaults_give_way():
    assert recipes.flags({"encoder_lr": 1e-4, "freeze": False, "paper": True}) == ["--encoder-lr", "0.0001", "--no-freeze", "--paper"]
    small = next(recipe for recipe in recipes.read(recipes.DEFAULT) if recipe.name == "lite0-small-heads")
    assert small.options["epochs"] == 150 and small.options["variants"] == 8


@pytest.mark.parametrize("entry", [
    {"kind": "constant"}, {"name": "a", "kind": "magic"}, {"name": "a", "pretraining": "none"}, {"name": "a", "option": {}},
])  # fmt: skip
def test_a_wrong_recipe_is_shown(tmp_path, entry):
    (tmp_path / "recipes.json").write_text(json.dumps({"recipes": [entry]}))
    with pytest.raises(SystemExit, match="is not a recipe"):
        recipes.read(tmp_path / "recipes.json")


def test_a_name_that_no_recipe_has_is_told():
    with pytest.raises(SystemExit, match="lite9"):
        recipes.chosen(recipes.read(recipes.DEFAULT), False, "lite0,lite9")
