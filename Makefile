# A new machine needs Python 3.11 or later with pip and venv; everything else is set up here.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
READY  := $(VENV)/.ready

.DEFAULT_GOAL := help
.PHONY: help run test lint types layers pytest portable bridges proofs bench fuzz pairs rounded whole mutants catalogue snapshots figures docs paper browser page tried links man walk release-check floors format clean known

help: ## this list
	@grep -E '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed 's/:.*## /\t/' | expand -t 16

# compat: a line with the path, where the other way looks through a table at every start of Python
$(READY): pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check \
	  --config-settings editable_mode=compat --editable ".[dev]"
	touch $(READY)

run: $(READY) ## check the paper's methods and run the oscillator convergence test on the rectangular method
	$(BIN)/gark check methods
	$(BIN)/gark converge methods/rectangular.gark.yaml --problem oscillator

test: $(READY) ## linter, types, layers of imports, and all tests, side by side
	$(MAKE) --no-print-directory --jobs=2 --keep-going lint layers types pytest

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(READY)
	$(BIN)/mypy

layers: $(READY)
	$(BIN)/lint-imports --no-logo

pytest: $(READY)
	$(BIN)/python -m pytest

portable: ## the suite under other circumstances, see docs/contributing/portability.md; ONLY=kernel,floors
	$(PYTHON) -m tests.portable.run --only "$(ONLY)"

bridges: $(READY) ## exported methods in the codes they are for, see docs/bridges.md; ONLY=scipy,petsc
	$(BIN)/python -m tests.bridges.run --only "$(ONLY)"

proofs: $(READY) ## certificates judged by Coq, see proofs/README.md
	$(BIN)/python -m tests.proofs.run

bench: $(READY) ## benchmarks, as ratios within one run
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[bench]"
	$(BIN)/python -m pytest tests/benchmarks -s --override-ini addopts="-q --import-mode=importlib" --override-ini norecursedirs=".*"

fuzz: $(READY) ## some minutes of fuzzing, see docs/contributing/fuzzing.md
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[fuzz]"
	GARK_RANDOM_EXAMPLES=1 GARK_FUZZ_EXAMPLES=3000 $(BIN)/python -m pytest tests/fuzz
	for run in 1 2 3 4; do GARK_RANDOM_EXAMPLES=1 $(BIN)/python -m pytest -m hypothesis --ignore tests/fuzz || exit 1; done
	-$(BIN)/python tests/fuzz/long_run.py --hostile
	$(BIN)/python tests/fuzz/long_run.py --hostile --problems
	$(BIN)/python tests/fuzz/long_run.py --cases 100000
	$(BIN)/python tests/fuzz/long_run.py --cases 20000 --problems
	$(BIN)/python tests/fuzz/atheris_fuzz.py --target files -max_total_time=60
	$(BIN)/python tests/fuzz/atheris_fuzz.py --target numbers -max_total_time=60

pairs: $(READY) ## the theorems of docs/pair-order.md against the certificate, on thousands of random pairs
	$(BIN)/python -m tests.order.random_pairs --cases 10000 --rules 1000 --spaces 200
	$(BIN)/python -m tests.order.own_pairs --cases 10000 --trees 300 --seed 1
	$(BIN)/python -m tests.order.linear_pairs --cases 3000 --seed 1

rounded: $(READY) ## exact methods of the catalogue rounded and misprinted, see docs/contributing/rounding.md; SEED=1
	$(BIN)/python -m tests.order.random_rounded --cases 300 --misprints 300 --theorems --seed $(or $(SEED),1)

whole: $(READY) ## the suite without samples: every method of the catalogue, every format, and the cases that take long
	GARK_WHOLE=1 $(BIN)/python -m pytest

mutants: $(READY) ## small changes in the mathematical rooms, and which of them no test sees, see docs/contributing/mutants.md; COUNT=300 SEED=1
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[mutants]"
	$(BIN)/python -m tests.mutants.run --count $(or $(COUNT),300) --seed $(or $(SEED),1)

catalogue: $(READY) ## make the index of the catalogue anew, and the copies in methods/
	$(BIN)/python -m garkcli.catalogue

snapshots: catalogue ## write every recorded text anew: pages, sessions, snapshots, the man page; read the difference
	GARK_UPDATE_SNAPSHOTS=1 $(BIN)/python -m pytest $$(grep -rlE "GARK_UPDATE_SNAPSHOTS|IS_RENEWED|assert_recorded" tests --include="test_*.py")

known: $(READY) ## make the derivatives of built-in problems anew
	$(BIN)/python -m garkcli.problems

figures: $(READY) ## draw the figures of the documentation anew
	mkdir -p build
	$(BIN)/python docs/figures/wrong_entry.py
	$(BIN)/python docs/figures/least_error.py
	$(BIN)/python docs/figures/rectangular.py
	$(BIN)/python docs/figures/gallery.py > build/figures.txt

docs: $(READY) ## the documentation as a site, in build/docs; a warning, such as a link to nowhere, fails
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[docs]"
	$(BIN)/python -m sphinx -q --fail-on-warning --keep-going docs build/docs

paper: ## the article in paper/ as build/paper.html, where pandoc is installed
	@command -v pandoc > /dev/null || { echo "make paper needs pandoc, which is not installed" >&2; exit 1; }
	mkdir -p build
	pandoc paper/paper.md --bibliography paper/paper.bib --citeproc --mathml --standalone --output build/paper.html

links: $(READY) ## the links of the documentation to other sites, asked for; needs a network
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[docs]"
	$(BIN)/python -m sphinx -q -b linkcheck --keep-going docs build/links

browser: docs ## reports and the site in headless Chromium, see docs/contributing/browser.md
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[browser]"
	$(BIN)/python -m pytest tests/browser --override-ini addopts="-q --import-mode=importlib" --override-ini norecursedirs=".*"

page: $(READY) ## gark as a static page in build/page, which runs in the browser; needs npm, see docs/try-it.md
	$(BIN)/python tryit/build.py

tried: page ## that page in headless Chromium, on a desktop and on a phone
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[browser]"
	$(BIN)/python -m pytest tests/tried --override-ini addopts="-q --import-mode=importlib" --override-ini norecursedirs=".*"

man: $(READY) ## make the manual page anew
	$(BIN)/python docs/man/page.py

walk: $(READY) ## README and tutorials as a newcomer does them: in empty folders, by a shell, with the wheel
	$(BIN)/python -m tests.portable.walk

release-check: $(READY) ## the distributions, built and tried from empty environments, see docs/contributing/release.md
	$(BIN)/python -m tests.portable.release

floors: ## the suite with the oldest declared version of each dependency
	$(MAKE) --no-print-directory portable ONLY=floors

format: $(READY) ## put the code into its one format
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

clean: ## remove everything that was made
	rm -rf $(VENV) .portable .bridges .proofs .mutants build dist *.egg-info .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache
