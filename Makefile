# The human entry point; `make` alone lists the targets. Every heavy command is prefixed by $(LAUNCH), empty by default.

LAUNCH ?=
THREADS ?= $(shell nproc 2>/dev/null || echo 2)
CARGO ?= cargo
BIN := target/release

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.SUFFIXES:
.PHONY: help programs run test check full-size bench man clean

help: ## List the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-12s %s\n", $$1, $$2 }' Makefile

programs: ## Build the programs into target/release
	$(CARGO) build --release

# ---- make run: the paper's effect on the Cornell box, in about a minute --------------------------------------------

SIZE := 128x128
GATHERS := 64
PHOTONS := 100000
ORDERS := scanline tiled tiled-hilbert hilbert random

run: $(ORDERS:%=out/%.csv) out/cornell.exr ## The five orders compared: a table, a picture, and the streams in out/
	@awk -v tiles=64 -v rays=$$((128 * 128 * $(GATHERS))) -f scripts/compare.awk scripts/paper.csv $(ORDERS:%=out/%.csv)
	@echo
	@echo "Picture: out/cornell.exr (linear), out/cornell.png (preview). Streams: out/*.pmp, *.pmq, *.pmt; see pm-view."

# The programs are made first, but a newer program does not make finished streams old: `make clean` starts anew.
out/map.pmp out/scanline.pmq out/tiled.pmq: | programs out

out:
	mkdir -p out

out/map.pmp:
	$(LAUNCH) $(BIN)/pm-photons -n $(PHOTONS) -t $(THREADS) -o $@

out/scanline.pmq out/direct.exr &: | programs out
	$(LAUNCH) $(BIN)/pm-queries --size $(SIZE) --gathers $(GATHERS) -t $(THREADS) --base out/direct.exr -o out/scanline.pmq

out/tiled.pmq:
	$(LAUNCH) $(BIN)/pm-queries --size $(SIZE) --gathers $(GATHERS) --order tiled --tile 16 -t $(THREADS) -o $@

out/tiled-hilbert.pmq: out/tiled.pmq
	$(LAUNCH) $(BIN)/pm-reorder hilbert --per batch $< -o $@

out/hilbert.pmq: out/scanline.pmq
	$(LAUNCH) $(BIN)/pm-reorder hilbert $< -o $@

out/random.pmq: out/scanline.pmq
	$(LAUNCH) $(BIN)/pm-reorder random $< -o $@

$(ORDERS:%=out/%.pmt): out/%.pmt: out/map.pmp out/%.pmq
	$(LAUNCH) $(BIN)/pm-gather $^ -t $(THREADS) -o $@

# One picture is enough: every order gives the same, to the bit (the tests show it).
out/cornell.exr out/cornell.png &: out/map.pmp out/hilbert.pmq out/direct.exr
	$(LAUNCH) $(BIN)/pm-gather out/map.pmp out/hilbert.pmq -t $(THREADS) --no-trace --base out/direct.exr \
	    --image out/cornell.exr --image out/cornell.png

$(ORDERS:%=out/%.csv): out/%.csv: out/%.pmt
	$(LAUNCH) $(BIN)/pm-cachesim --format csv $< > $@

# ---- make full-size: the paper's own size, through pipes and without storing the streams ----------------------------

FULL := scanline scanline-inf scanline-preorder scanline-reread scanline-shuffled tiled-hilbert hilbert hilbert-inf hilbert-preorder
FULL_QUERIES := $(BIN)/pm-queries --size 512x512

full-size: $(FULL:%=out/full/%.csv) ## The paper's size (512 x 512, 100 gathers, 450,000 photons): about 25 minutes on two cores
	@awk -v tiles=1024 -v rays=$$((512 * 512 * 100)) -f scripts/compare.awk scripts/paper.csv $^

out/full/map.pmp: | programs
	mkdir -p out/full
	$(LAUNCH) $(BIN)/pm-photons -n 450000 -t $(THREADS) -o $@

# What follows the pipe's first program, by the name of the target.
ORDER_scanline := |
ORDER_tiled-hilbert := --order tiled | $(BIN)/pm-reorder hilbert --per batch |
ORDER_hilbert := | $(BIN)/pm-reorder hilbert |
OPTIONS_inf := --start-radius inf
OPTIONS_preorder := --layout preorder
OPTIONS_reread := --reread

out/full/scanline-shuffled.csv: out/full/map.pmp
	$(LAUNCH) sh -c '$(FULL_QUERIES) --strata shuffled | $(BIN)/pm-gather $< -t $(THREADS) | $(BIN)/pm-cachesim --format csv' > $@

out/full/tiled-hilbert.csv: out/full/map.pmp
	$(LAUNCH) sh -c '$(FULL_QUERIES) $(ORDER_tiled-hilbert) $(BIN)/pm-gather $< -t $(THREADS) | $(BIN)/pm-cachesim --format csv' > $@

out/full/%.csv: out/full/map.pmp
	$(LAUNCH) sh -c '$(FULL_QUERIES) $(ORDER_$(word 1,$(subst -, ,$*))) $(BIN)/pm-gather $< -t $(THREADS) \
	    $(OPTIONS_$(word 2,$(subst -, ,$*))) | $(BIN)/pm-cachesim --format csv' > $@

# ---- checks ---------------------------------------------------------------------------------------------------------

test: ## All tests, optimised
	$(CARGO) test --workspace --release

check: ## Formatting and lints
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets --release -- -D warnings

bench: ## Speed, as ratios measured side by side
	$(CARGO) bench -p pm-tools

man: programs ## Manual pages of all programs in out/man
	mkdir -p out/man
	for program in photons queries reorder gather cachesim view; do \
	    $(BIN)/pm-$$program --generate man > out/man/pm-$$program.1 || exit 1; \
	done

clean: ## Remove out/
	rm -rf out
