# The project's commands. The two a newcomer needs: `make demo` and `make test`.
#
#   make demo       install what is missing, build, run both engines on cases/demo.toml, compare: out/demo/report.html
#   make test       the same set-up, then all tests and make lint   (SANITIZE=1: with sanitizers); outside of CI clang-tidy
#                   looks at what changed and at an eighth of the rest, another one from commit to commit: LINT_PARTS=1, all
#                   SANITIZE=thread: the engine with threads, under the thread sanitizer
#                   where emscripten is installed, it builds and tries the page of `make web` too: 3 CPU minutes, once
#   make build      build/endoflow and its engines
#   make install    DESTDIR and prefix as usual          make package   a Debian package in build/
#   make hero       the README's picture and film, from what make demo made
#   make bench      what the engines cost here: out/bench/bench.md   (BENCH=--quick: minutes instead of tens of minutes)
#   make web        the sharp engine as a page that needs no installation: build/web/index.html
#   make results    all numbers of docs/ anew, hours: docs/results/data, figures, pages   (RESULTS='--only STUDY', --list, --pages)
#   make docs       docs/ as HTML in build/docs      make notebooks  python/notebooks executed and stored
#   make docs-check run every command of README and docs/, and the notebooks
#   make format     clang-format on all sources          make lint      clang-format, clang-tidy and pyflakes, check only
#   make portability DISTRIBUTION=trixie [TARGET=demo]   the committed tree in a bare Debian: log in out/portability
# UNITY=OFF compiles file by file: longer from nothing, shorter after an edit; the choice where a compiler cache is set.
# WERROR=ON makes warnings errors, in this build directory from then on: for who changes the sources, and where CI is set.
# PHASEFIELD=OFF leaves the phase-field engine (deal.II, MPI) out of all of them.

PHASEFIELD ?= ON
UNITY ?= $(if $(CMAKE_CXX_COMPILER_LAUNCHER),OFF,ON)
WERROR ?= $(if $(CI),ON)
SANITIZE ?= 0
BENCH ?=
RESULTS ?=
DISTRIBUTION ?= trixie
TARGET ?= demo
CORES ?= $(shell tools/cores)
prefix ?= /usr/local

ifeq ($(SANITIZE),1)
  preset := sanitize
  build := build-sanitize
else ifeq ($(SANITIZE),thread)
  preset := sanitize-thread
  build := build-sanitize-thread
  override PHASEFIELD := OFF
  tests := --tests-regex '^boundary_integral$$'
else
  preset := release
  build := build
endif

groups := base $(if $(filter ON,$(PHASEFIELD)),phasefield)
# Sanitizers do not see into WebAssembly: with them the page is left out.
page_for_tests = $(if $(filter 0,$(SANITIZE)),tools/web/page_for_tests $(build) --parallel $(CORES),:)
engines := boundary-integral $(if $(filter ON,$(PHASEFIELD)),phase-field)

# OpenMPI refuses to run as root unless told twice that this is meant.
ifeq ($(shell id -u),0)
  export OMPI_ALLOW_RUN_AS_ROOT := 1
  export OMPI_ALLOW_RUN_AS_ROOT_CONFIRM := 1
endif

.PHONY: all demo announcement hero test build configure packages test-packages run-demo install package bench results docs docs-check notebooks format
.PHONY: lint portability web web-page clean

all: build

packages:
	@tools/install_packages $(groups)

test-packages:
	@tools/install_packages $(groups) test

# Tests are configured by `make test` alone: nobody else needs Catch2. A build directory that has them keeps them.
configure:
	@cmake --preset $(preset) -DENDOFLOW_PHASEFIELD=$(PHASEFIELD) -DENDOFLOW_UNITY=$(UNITY) \
	    $(if $(TESTS),-DENDOFLOW_TESTS=$(TESTS)) $(if $(WERROR),-DENDOFLOW_WERROR=$(WERROR)) > $(build).configure.log 2>&1 \
	  || { cat $(build).configure.log; exit 1; }
	@rm -f $(build).configure.log

build: packages
	@$(MAKE) --no-print-directory configure
	cmake --build $(build) --target programs

# The programs of the demonstration alone: a newcomer waits for no other.
announcement:
	@tools/demo --announce $(CORES) $(engines)

demo: announcement packages
	@$(MAKE) --no-print-directory configure
	cmake --build $(build) --target endoflow $(addprefix endoflow-,$(engines))
	tools/demo $(build) $(CORES) $(engines)

out/demo/hero.webp:
	@$(MAKE) --no-print-directory demo

hero: out/demo/hero.webp
	cp out/demo/hero.png out/demo/hero.webp docs/images/

test: test-packages
	@$(MAKE) --no-print-directory configure TESTS=ON
	cmake --build $(build)
	@$(MAKE) --no-print-directory lint LINT_PARTS=$(or $(LINT_PARTS),$(if $(CI),1,8))
	@$(page_for_tests)
	ctest --test-dir $(build) --parallel $(CORES) --output-on-failure --timeout 3600 $(tests)

bench: build
	cmake --build $(build) --target bench-ring-kernels
	bench/bench.py $(build) $(BENCH)

install: build
	DESTDIR=$(DESTDIR) cmake --install $(build) --prefix $(prefix)

package: build
	@tools/install_packages package
	cd $(build) && cpack

web:
	@tools/install_packages base web
	@$(MAKE) --no-print-directory web-page

web-page:
	tools/web/build_engine $(build)/web-engine --parallel $(CORES)
	tools/web/page.py $(build)/web-engine/engine.wasm $(build)/web/index.html

# The Python that CMake found has numpy and what draws.
results: build
	@"$$(sed -n 's/^ENDOFLOW_PYTHON:[A-Z]*=//p' $(build)/CMakeCache.txt)" tools/results $(build) $(RESULTS)

docs: build
	@tools/install_packages docs
	python3 tools/docs/build.py $(build)/endoflow $(build)/docs

docs-check: build
	@tools/install_packages docs test
	python3 tools/docs/check.py $(build)

# Executes python/notebooks and stores what their cells show.
notebooks: build
	@tools/install_packages docs test
	python3 tools/docs/check.py $(build) --store

format:
	tools/clang_format -i

# clang-tidy sees a target's files together: it looks through the headers of all they include each time it is called. That a
# file stands by itself, and does not live on what another includes, is what builds with UNITY=OFF see.
lint:
	tools/clang_format --dry-run --Werror
	tools/pyflakes
	tools/unused_using
	@cmake --preset $(preset) -B $(build)/lint -DENDOFLOW_PHASEFIELD=$(PHASEFIELD) -DENDOFLOW_UNITY=ON -DENDOFLOW_TESTS=ON > /dev/null
	tools/clang_tidy $(build)/lint $(CORES) $(or $(LINT_PARTS),1)

portability:
	tools/portability $(DISTRIBUTION) $(TARGET)

clean:
	rm -rf build build-debug build-sanitize build-sanitize-thread build-clang
