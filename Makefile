# What a newcomer needs: `make run` and `make test`. The rest rebuilds the model.

PYTHON    ?= python3
JOBS      ?= $(shell nproc)
OBJECTS   ?= objects
MADE      ?= 'made:*/0..24'
LABELS    ?= models/labels.csv
REPEATS   ?= models/label_repeats.csv
INPUTS    ?= models/training/data/inputs
TURNS     ?= models/training/runs/turns
COMPARE   ?= models/training/runs/compare
# Objects of Table I, and sizes of each that networks learn from.
LIMIT     ?= 260
SIZES     ?= 2
# How a network is made: solved on Lite0's own features, then tuned whole.
RECIPE    ?= --encoder efficientnet_lite0 --size 128 --sizes $(SIZES) --statuses ok,not_converged --no-freeze --head ridge \
  --variants 8 --batch 16 --encoder-lr 1.6e-3 --lr 1e-5 --loss huber --epochs 8
RUNS      := $(foreach turn,0 1 2 3 4,$(abspath $(TURNS))/$(turn))
TRAIN_ENV := models/training/.venv
# Any number: the cases that the property tests draw, the same in every run unless another is given.
PROPTEST_RNG_SEED ?= 20
SUDO      := $(if $(filter 0,$(shell id -u)),,sudo)

.PHONY: run test system-packages build openapi views-table bench objects label label-repeats inputs train-env train turns table1 compare pictures test-training

## Serves on 127.0.0.1:8080 with the model in models/.
run: system-packages
	cargo run --release -- serve

## Every test of the service; the training package's own tests are `make test-training`.
## `make test PROPTEST_RNG_SEED=$RANDOM` draws other cases.
test: export PROPTEST_RNG_SEED := $(PROPTEST_RNG_SEED)
test: system-packages
	cargo test --release
	cd models/training && $(CURDIR)/.venv/bin/python -m pytest -q -m "not torch"

build: system-packages
	cargo build --release

## Every bench. The order bench compares with HiGHS, which the first run builds in a few minutes.
bench: .venv/bin/cmake
	PATH="$(CURDIR)/.venv/bin:$$PATH" \
	  LIBCLANG_PATH="$$(.venv/bin/python -c 'import clang; print(clang.__path__[0] + "/native")')" \
	  cargo bench --features peers

# HiGHS needs CMake, a C++ compiler and, for its Rust bindings, libclang.
.venv/bin/cmake: benches/peers/requirements.txt | system-packages
	@command -v c++ >/dev/null || { $(SUDO) apt-get update -q && $(SUDO) apt-get install -y -q build-essential; }
	$(PYTHON) -m venv .venv
	.venv/bin/pip install -q --disable-pip-version-check -r $<
	@touch $@

# Installs only what is missing: a linker for Rust, pip for ONNX Runtime's wheel, curl and
# jq for the README's session, pytest for the training package's light tests.
system-packages:
	@missing=""; \
	command -v cc >/dev/null || missing="$$missing build-essential"; \
	command -v $(PYTHON) >/dev/null || missing="$$missing python3"; \
	$(PYTHON) -m pip --version >/dev/null 2>&1 || missing="$$missing python3-pip"; \
	$(PYTHON) -c 'import ensurepip, venv' >/dev/null 2>&1 || missing="$$missing python3-venv"; \
	command -v curl >/dev/null || missing="$$missing curl"; \
	command -v jq >/dev/null || missing="$$missing jq"; \
	if [ -n "$$missing" ]; then \
	  echo "installing:$$missing"; \
	  $(SUDO) apt-get update -q && $(SUDO) env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $$missing; \
	fi
	@command -v cargo >/dev/null || { echo "Rust is missing: install cargo 1.89 or newer first" >&2; exit 1; }

test: .venv/bin/pytest
.venv/bin/pytest: models/training/requirements-test.txt | system-packages
	$(PYTHON) -m venv .venv
	.venv/bin/pip install -q --disable-pip-version-check -r $<
	@touch $@

## The committed API description and view table, made again.
openapi:
	cargo run --release -- openapi > openapi/openapi.json

## Debian's furniture models (CC-BY 3.0 and CC0), unpacked into an ignored folder.
objects: $(OBJECTS)/.done
$(OBJECTS)/.done:
	mkdir -p $(OBJECTS)/deb
	cd $(OBJECTS)/deb && ( ls sweethome3d-furniture_*.deb >/dev/null 2>&1 \
	  || apt-get download sweethome3d-furniture \
	  || ( $(SUDO) apt-get update -q && apt-get download sweethome3d-furniture ) )
	cd $(OBJECTS) && dpkg-deb -x deb/sweethome3d-furniture_*.deb unpacked
	mv $(OBJECTS)/unpacked/usr/share/sweethome3d/furniture/*.sh3f $(OBJECTS)/
	rm -rf $(OBJECTS)/unpacked $(OBJECTS)/deb
	touch $@

## Labels the furniture and 24 objects of each made family, at two sizes; may be stopped and started again at any time, finished objects stay.
label: $(OBJECTS)/.done build
	target/release/prv label --objects $(OBJECTS) $(MADE) --out $(LABELS) --sizes 2 --jobs $(JOBS) --resume --allow-failures

## Labels the first objects again with other seeds, turns and test views, to see how far labels scatter.
label-repeats: $(OBJECTS)/.done build
	target/release/prv label --objects $(OBJECTS) $(MADE) --out $(REPEATS) --repeat 1 --limit 40 --jobs $(JOBS) --resume

## The initial photos of every labelled object, as the network sees them.
inputs: $(OBJECTS)/.done build
	target/release/prv inputs --objects $(OBJECTS) --labels $(LABELS) --out $(INPUTS)

train-env: $(TRAIN_ENV)/.done
$(TRAIN_ENV)/.done: models/training/requirements.txt
	$(PYTHON) -m venv $(TRAIN_ENV)
	$(TRAIN_ENV)/bin/pip install -q --disable-pip-version-check -r $<
	touch $@

## Trains five networks that together hold every object out once, exports the first of them as models/prvnet.onnx and
## writes its figures into the model card. The interval of each is by the errors of the others on what those hold out.
# Curves that some view set lifts above their 100-view ceiling are within the noise of one NeRF, so both
# statuses count.
train: turns
	cp $(TURNS)/0.onnx models/prvnet.onnx
	cd models/training && .venv/bin/python -m prvnet.parity --run $(abspath $(TURNS))/0 --model $(abspath models/prvnet.onnx) \
	  --inputs $(abspath $(INPUTS)) --golden $(abspath models/prvnet.golden.json)
	cd models/training && .venv/bin/python -m prvnet.card --run $(abspath $(TURNS))/0 --model $(abspath models/prvnet.onnx) \
	  --sisters $(RUNS) --repeats $(abspath $(REPEATS)) --card $(abspath models/MODEL_CARD.md)
	$(MAKE) pictures

## Those five; what is there stays, what was stopped goes on.
turns: $(RUNS:=.onnx)
$(RUNS:=.trained): %.trained: | inputs train-env
	mkdir -p $(TURNS)
	cd models/training && .venv/bin/python -m prvnet.train --labels $(abspath $(LABELS)) --inputs $(abspath $(INPUTS)) \
	  $(RECIPE) --turn $(notdir $*) --out $*
	touch $@
$(RUNS:=.onnx): %.onnx: $(RUNS:=.trained)
	cd models/training && .venv/bin/python -m prvnet.export --run $* --sisters $(RUNS) --out $@

## The paper's Table I on the first 260 objects, each by the network that holds it out; ten CPU seconds an object,
## resumable. New labels want TURNS and COMPARE emptied: what is there is of other labels.
## models/table1/reconstructions.csv may stay, what a number of views leads to does not depend on the networks, until
## objects, renderer, view sets or the NeRF change.
table1: $(OBJECTS)/.done build turns
	target/release/prv evaluate table1 --objects $(OBJECTS) --labels $(LABELS) --sizes $(SIZES) --limit $(LIMIT) \
	  --model $(foreach turn,0 1 2 3 4,$(TURNS)/$(turn).onnx) --out models/table1 --jobs $(JOBS)

## Encoders, image sizes, heads and simple methods against each other on the same labels; resumable.
## `make compare WHAT=--slow` trains what takes hours too, `make compare WHAT="--only atto-128"` that alone.
compare: inputs train-env
	cd models/training && .venv/bin/python -m prvnet.compare --labels $(abspath $(LABELS)) --inputs $(abspath $(INPUTS)) \
	  --sizes $(SIZES) --statuses ok,not_converged --turns 5 --out $(abspath $(COMPARE)) $(WHAT)

## The model card's pictures.
pictures: inputs train-env
	cd models/training && .venv/bin/python -m prvnet.pictures --labels $(abspath $(LABELS)) \
	  --inputs $(abspath $(INPUTS)) --out $(abspath models/pictures)

test-training: train-env
	cd models/training && .venv/bin/python -m pytest -q
