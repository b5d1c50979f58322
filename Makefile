# The human entry point; `make` alone lists the targets. Every heavy command is prefixed by $(LAUNCH), empty by default.

LAUNCH ?=
THREADS ?= $(shell nproc 2>/dev/null || echo 2)
CARGO ?= cargo
BIN := target/release

# All programs.
NAMES := $(addprefix pm-,photons queries reorder sample gather cachesim chart view scene picture plan sweep)

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.SUFFIXES:
.PHONY: help programs run accuracy pictures coverage plan-coverage plan-traffic need charts-cache frontier structures scenes test check test-python full-size causes stability faults fuzz same-bytes licences advisories bench bench-growth peers later bench-traces man options test-cluster install dist clean clean-streams

help: ## List the targets
	@sed -n 's/^\([a-z-]*\):.*## /\1             ## /; s/^\([a-z-].\{12\}\) *## /  make \1 /p' $(MAKEFILE_LIST)

include scripts/orders.mk
include scripts/sweep.mk

programs: ## Build the programs into target/release
	$(CARGO) build --release

# ---- make run: the paper's effect on the Cornell box, in about a minute --------------------------------------------

SIZE := 128x128
GATHERS := 64
PHOTONS := 100000
ORDERS := scanline tiled tiled-hilbert hilbert random

run: $(ORDERS:%=out/%.csv) out/cornell.exr ## The five orders compared: a table, a picture, and the streams in out/
	@$(BIN)/pm-sweep derive compare --with size=$(SIZE) --with gathers=$(GATHERS) scripts/paper.csv $(ORDERS:%=out/%.csv)
	@echo
	@echo "Picture: out/cornell.exr (linear), out/cornell.png (preview). Streams: out/*.pmp, *.pmq, *.pmt; see pm-view."

TAKEN += $(ORDERS) soft map direct seen caustics cornell man dist cluster

out/map.pmp: $(call made_with,PHOTONS PROGRAMS)
	$(LAUNCH) $(BIN)/pm-photons -n $(PHOTONS) -t $(THREADS) -o $@

out/scanline.pmq out/direct.exr &: $(call made_with,SIZE GATHERS PROGRAMS)
	$(LAUNCH) $(BIN)/pm-queries --size $(SIZE) --gathers $(GATHERS) -t $(THREADS) \
	    --no-caustics --base out/direct.exr -o out/scanline.pmq

out/tiled.pmq: $(call made_with,SIZE GATHERS PROGRAMS)
	$(LAUNCH) $(BIN)/pm-queries --size $(SIZE) --gathers $(GATHERS) --order tiled --tile 16 -t $(THREADS) -o $@

out/tiled-hilbert.pmq: out/tiled.pmq
	$(LAUNCH) $(BIN)/pm-reorder hilbert --per batch $< -o $@

out/hilbert.pmq: out/scanline.pmq
	$(LAUNCH) $(BIN)/pm-reorder hilbert $< -o $@

out/random.pmq: out/scanline.pmq
	$(LAUNCH) $(BIN)/pm-reorder random $< -o $@

$(ORDERS:%=out/%.pmt): out/%.pmt: out/map.pmp out/%.pmq
	$(LAUNCH) $(BIN)/pm-gather $^ -t $(THREADS) -o $@

# One picture is enough: every order gives the same, to the bit (the tests show it). Light that comes from the lamp
# through the spheres is sharp, so it has a map of its own, looked up where the eye sees.
out/soft.exr: out/map.pmp out/hilbert.pmq out/direct.exr
	$(LAUNCH) $(BIN)/pm-gather out/map.pmp out/hilbert.pmq -t $(THREADS) --no-trace --base out/direct.exr --image $@

out/caustics.pmp: $(call made_with,PHOTONS PROGRAMS)
	$(LAUNCH) $(BIN)/pm-photons --caustics -n $(PHOTONS) -t $(THREADS) -o $@

out/seen.pmq: $(call made_with,SIZE PROGRAMS)
	$(LAUNCH) $(BIN)/pm-queries --size $(SIZE) --direct-visualisation -t $(THREADS) -o $@

out/cornell.exr out/cornell.png &: out/caustics.pmp out/seen.pmq out/soft.exr
	$(LAUNCH) $(BIN)/pm-gather out/caustics.pmp out/seen.pmq -k 50 -t $(THREADS) --no-trace --base out/soft.exr \
	    --image out/cornell.exr --image out/cornell.png

$(ORDERS:%=out/%.csv): out/%.csv: out/%.pmt
	$(call row,pm-cachesim --format csv $<)

# ---- make full-size: the paper's own size, nothing left out ---------------------------------------------------------

full-size: out/full.csv out/variants.csv ## The paper's size (512 x 512, 100 gathers, 450,000 photons) in full: an hour with -j2
	@$(BIN)/pm-sweep derive compare --with size=512x512 --with gathers=100 scripts/paper.csv $^
	@$(BIN)/pm-sweep derive traffic $<

# ---- make causes: what the fetches of the plain order depend on, at 64 x 64 pixels and the paper's 450,000 photons --

causes: out/causes.csv ## What the fetches of the plain order depend on: strata, start radius, second touch, layout, photons
	@$(BIN)/pm-sweep derive compare --with size=64x64 --with gathers=100 scripts/paper.csv $<

include scripts/charts.mk
include scripts/frontier.mk
include scripts/structures.mk
include scripts/accuracy.mk
include scripts/pictures.mk
include scripts/paper.mk
include scripts/coverage.mk
include scripts/plans.mk
include scripts/bench.mk
include scripts/later.mk
include scripts/fuzz.mk

# ---- make scenes ----------------------------------------------------------------------------------------------------

TAKEN += scenes

scenes: $(patsubst %,out/scenes/%.obj,fractal columns sphere gap sunlit) ## Make the generated scenes in out/scenes: fractal Cornell box, hall of columns, integrating sphere, room with a gap, sunlit room

out/scenes/%.obj: $(call made_with,PROGRAMS)
	$(LAUNCH) $(BIN)/pm-scene $* -q -o out/scenes

# ---- checks ---------------------------------------------------------------------------------------------------------

test: ## All tests, optimised
	$(CARGO) test --workspace --release

test-python: programs ## The reader in Python against the streams that are kept and those written now (needs python3 and its packages)
	python3 -m venv target/python
	target/python/bin/pip install -q ./formats/python
	cd formats/python && PM_BIN=$(abspath $(BIN)) $(CURDIR)/target/python/bin/python -m unittest

test-cluster: programs ## A sweep on a private Slurm of two nodes on this machine: a step cancelled, a node killed, equal bytes (needs slurmd)
	@if ! PATH=$$PATH:/usr/sbin command -v slurmctld slurmd munged srun > /dev/null; then \
	    echo "make test-cluster needs Slurm: apt-get install --no-install-recommends slurmctld slurmd slurm-client munge" >&2; exit 1; fi
	scripts/cluster/with-slurm.sh scripts/cluster/test.sh

check: ## Formatting and lints
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets --release -- -D warnings

stability: ## Photon maps under stress: out/stability.txt, a table of structures and what breaks them
	mkdir -p out
	PM_STABILITY_TABLE=$(CURDIR)/out/stability.txt $(CARGO) test -q -p pm-maps --release --lib stability
	@cat out/stability.txt

faults: programs ## Kills, full disks, refused memory and threads, two makes, folders of others
	scripts/faults.sh $(BIN)

same-bytes: programs ## Small pipes with builds for debugging, for any and for this machine, and with 1, 2 and 7 threads: the same bytes
	$(CARGO) build -p pm-programs --bins --target-dir target/same-bytes
	RUSTFLAGS='-C target-cpu=native' $(CARGO) build --release -p pm-programs --bins --target-dir target/native
	scripts/same-bytes.sh $(BIN) target/same-bytes/debug target/native/release

licences: ## What may be built upon: licences, sources, versions (needs cargo-deny)
	$(CARGO) deny --config scripts/deny.toml check licenses bans sources

advisories: ## Known faults of what is built upon, by the RustSec database (needs cargo-deny and the network)
	$(CARGO) deny --config scripts/deny.toml check advisories

man: programs ## Manual pages of all programs in out/man
	mkdir -p out/man
	for program in $(NAMES); do $(BIN)/$$program --generate man > out/man/$$program.1 || exit 1; done

options: programs ## The pages of options, tools/programs/options, written anew from the programs
	for program in $(NAMES); do $(BIN)/$$program --generate options > tools/programs/options/$$program.md || exit 1; done

# ---- make install, make dist -------------------------------------------------------------------------------------------

PREFIX ?= /usr/local
DESTDIR ?=

install: programs ## PREFIX=/usr/local: the programs, their manual pages, and completions for bash, zsh and fish
	$(call put,$(BIN),$(DESTDIR)$(PREFIX))

# $(call put,PROGRAMS,WHERE): programs from a folder, and what they generate, below another.
define put
@install -d '$2/bin' '$2/share/man/man1' '$2/share/bash-completion/completions' '$2/share/zsh/site-functions' '$2/share/fish/vendor_completions.d'
@set -e; for program in $(NAMES); do \
    install -m 755 $1/$$program '$2/bin'; \
    $(BIN)/$$program --generate man > '$2/share/man/man1'/$$program.1; \
    $(BIN)/$$program --generate bash > '$2/share/bash-completion/completions'/$$program; \
    $(BIN)/$$program --generate zsh > '$2/share/zsh/site-functions'/_$$program; \
    $(BIN)/$$program --generate fish > '$2/share/fish/vendor_completions.d'/$$program.fish; \
done; echo "$(words $(NAMES)) programs, manual pages and completions in $2"
endef

STATIC := x86_64-unknown-linux-musl
DIST = pm-$(shell sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)-$(STATIC)

dist: programs ## out/dist/*.tar.gz: all programs without libraries of the system's, for any Linux on x86-64
	@rustc --print target-libdir --target $(STATIC) 2>/dev/null | xargs -r test -d && command -v musl-gcc >/dev/null || { \
	    echo "make dist needs the target $(STATIC) (rustup target add $(STATIC)) and musl-gcc (the package musl-tools)" >&2; exit 1; }
	$(CARGO) build --release -p pm-programs --bins --target $(STATIC)
	@rm -rf out/dist/$(DIST)
	$(call put,target/$(STATIC)/release,out/dist/$(DIST))
	@cp README.md LICENSE-MIT LICENSE-APACHE CHANGELOG.md out/dist/$(DIST)
	@tar -C out/dist --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner -c $(DIST) | gzip -9n > out/dist/$(DIST).tar.gz
	@ls -l out/dist/$(DIST).tar.gz

clean-streams: ## Remove the streams in out/ that rows were made of; the rows stay, and nothing is made again
	@if [ -x $(BIN)/pm-sweep ] && [ -d out ]; then $(BIN)/pm-sweep hold out --by $$PPID --what 'make clean-streams'; fi
	rm -rf out/streams

clean: ## Remove out/
	@if [ -x $(BIN)/pm-sweep ] && [ -d out ]; then $(BIN)/pm-sweep hold out --by $$PPID --what 'make clean'; fi
	rm -rf out
