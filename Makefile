# Everything runs in .venv, made on first use by the Python found below (3.11 or newer).
PYTHON ?= $(firstword $(foreach p,python3 python3.14 python3.13 python3.12 python3.11 python,\
  $(shell $(p) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $(p))))
BIN = .venv/$(if $(filter Windows_NT,$(OS)),Scripts,bin)
# Not --quiet: mkdocs then counts no warning, and --strict passes whatever is broken.
DOCS = $(BIN)/mkdocs build --strict --config-file .ci/mkdocs.yml
# Python compiles a file when it is first used; pip would compile all of them: 15 s of 37.
PIP = $(BIN)/pip install --quiet --disable-pip-version-check --no-compile
# Even where Python is told to keep nothing compiled, as in many a container: tests start the program
# some hundred times.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: demo test pytest lint docs web web-test stress stress-numbers \
  certify jam cad fuzz bench bench-full bench-start dist clean

demo: .venv/demo
	@mkdir -p build
	@echo "--- a table, and a slot, a wheel and a whole machine in build/: some seconds"
	$(BIN)/geneva table --z 6 --internal
	$(BIN)/geneva profile designs/modified-sine-matched.toml -o build/modified-sine-slot.csv
	$(BIN)/geneva profile designs/modified-sine-matched.toml --part wheel -o build/wheel.dxf
	$(BIN)/geneva profile designs/modified-sine-matched.toml --part assembly -o build/machine.svg
	@echo "written to build/: modified-sine-slot.csv, wheel.dxf, machine.svg"

# Types are checked beside the tests: neither waits for the other.
test: .venv/dev
	$(MAKE) --jobs=2 lint pytest

# Assertions that are rewritten to show their values take 10 s of a first run to compile, on each
# core; so the tests that failed are run again with them.
pytest: .venv/dev
	$(BIN)/pytest -n logical --dist worksteal --assert=plain \
	  || { $(BIN)/pytest --last-failed; exit 1; }

lint: .venv/dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(DOCS)

# The manual as a static site in build/site; a broken link is an error.
docs: .venv/dev
	$(DOCS)

# Run time against error: kernels against their rivals (those by Numba where it is installed), a table
# and plots in build/bench; five minutes. bench-full measures whole runs too, an hour.
bench: .venv/dev
	@mkdir -p build/bench
	PYTHONPATH=tests $(BIN)/python -m bench -o build/bench/bench.md

bench-full: .venv/dev
	@mkdir -p build/bench
	PYTHONPATH=tests $(BIN)/python -m bench --full -o build/bench/bench.md

# Numerical stress against mpmath, random machines turned, then every case of the tests, of which
# `make test` takes a sample (tests/sampling.py): sweeps of every key of all designs are among them,
# and their certificates (`make certify` adds random machines); an hour and a half on two cores.
stress: stress-numbers
	GENEVA_STRESS=1 $(BIN)/pytest -n logical --dist worksteal

stress-numbers: .venv/dev
	PYTHONPATH=tests:tests/motion:tests/parts $(BIN)/python tests/stress/stress.py
	$(FUZZ) schema --runs 2000
	PYTHONPATH=tests $(BIN)/python tests/stress/stress_many.py
	$(FUZZ) synth --runs 105
	PYTHONPATH=tests $(BIN)/python tests/stress/stress_many.py --loads --designs 5000

# Proved bounds of every peak of 1,000 random machines of each kind; two hours. `make stress` takes
# the designs.
certify: .venv/dev
	$(FUZZ) certificates --runs 10500

# A static folder, build/web, on which geneva runs in a browser; needs npm and its registry. To try
# it: python3 -m http.server -d build/web
web: .venv/demo
	@mkdir -p build
	$(BIN)/python .ci/web/build.py build/web

# That page in a headless Chromium, which must be installed: the time to the first answer, verdicts
# and files against the commands' own, and without a network; a minute.
web-test: .venv/dev web
	$(PIP) "websocket-client>=1.8,<2"
	PYTHONPATH=tests:tests/output:tests/stress $(BIN)/python tests/stress/web_in_browser.py build/web

# Every design's STEP files read by a CAD kernel, and the manual's CAD code run with it; it is
# installed with build123d (1 GB). Four minutes.
cad: .venv/dev
	$(PIP) "build123d>=0.13,<0.14"
	PYTHONPATH=tests $(BIN)/python tests/stress/solids_in_cad.py
	PATH="$(CURDIR)/$(BIN):$$PATH" PYTHONPATH=tests python tests/stress/cad_code.py

# Every design's DXF files in a physics engine, which is installed for it: does it jam, and does the
# wheel go where it should; ten minutes.
jam: .venv/dev
	$(PIP) "pymunk>=7,<8"
	PYTHONPATH=tests $(BIN)/python tests/stress/jam.py

# A million random specs, 20,000 machines with parts, 10,000 drawing sheets, 2,000 wheels with curved
# slots; hours. `--first N` goes on from case N, `--seed N` has other cases.
FUZZ = PYTHONPATH=tests:tests/motion:tests/parts $(BIN)/python tests/stress/fuzz.py --jobs 2
fuzz: .venv/dev
	$(FUZZ) specs --runs 1000000
	$(FUZZ) parts --runs 20000
	$(FUZZ) sheets --runs 10000
	$(FUZZ) stops --runs 2000

# Start-up of every command against `import typer` alone: whole processes in pairs, processor time.
# The budget of `geneva table --z 6` is 1.05.
bench-start: .venv/dev
	PYTHONPATH=tests $(BIN)/python -m bench start

# Wheel and sdist in dist/, each installed alone and run, with the lowest and the highest releases of
# what it needs; some minutes.
dist: .venv/dev
	$(PIP) "build>=1.2,<2" "uv>=0.9"
	rm -rf dist
	$(BIN)/python -m build --outdir dist >/dev/null
	PATH="$(CURDIR)/$(BIN):$$PATH" PYTHONPATH=tests python tests/stress/try_dist.py dist/*

.venv/python:
	@test -n "$(PYTHON)" || { echo "make: no Python 3.11 or newer found; set PYTHON=..." >&2; exit 1; }
	@echo "--- making .venv with $(PYTHON)"
	@$(PYTHON) -m venv .venv
	@touch $@

.venv/demo: .venv/python pyproject.toml
	@echo "--- installing geneva and what it needs in .venv: a minute, the first time alone"
	$(PIP) --editable .
	@touch $@

# One run of pip for both. Python's own reader of TOML: nothing is installed yet.
.venv/dev: .venv/python pyproject.toml
	@echo "--- installing geneva and what the tests need in .venv: some minutes, the first time alone"
	$(PIP) --editable . $$($(BIN)/python -c "import tomllib; print(*(r.replace(' ', '') for r in tomllib.load(open('pyproject.toml', 'rb'))['dependency-groups']['dev']))")
	@touch .venv/demo $@

clean:
	rm -rf .venv build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis
