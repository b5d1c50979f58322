# The human entry point; `make` alone lists the targets. Every heavy command is prefixed by $(LAUNCH), empty by default.

LAUNCH ?=
THREADS ?= $(shell nproc 2>/dev/null || echo 2)
CARGO ?= cargo
BIN := target/release

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.SUFFIXES:
.PHONY: help programs run accuracy pictures coverage charts-cache frontier structures scenes test check full-size causes stability bench man clean

help: ## List the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-12s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

include scripts/orders.mk

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
	$(LAUNCH) $(BIN)/pm-queries --size $(SIZE) --gathers $(GATHERS) -t $(THREADS) \
	    --no-caustics --base out/direct.exr -o out/scanline.pmq

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

# One picture is enough: every order gives the same, to the bit (the tests show it). Light that comes from the lamp
# through the spheres is sharp, so it has a map of its own, looked up where the eye sees.
out/soft.exr: out/map.pmp out/hilbert.pmq out/direct.exr
	$(LAUNCH) $(BIN)/pm-gather out/map.pmp out/hilbert.pmq -t $(THREADS) --no-trace --base out/direct.exr --image $@

out/caustics.pmp: | programs out
	$(LAUNCH) $(BIN)/pm-photons --caustics -n $(PHOTONS) -t $(THREADS) -o $@

out/seen.pmq: | programs out
	$(LAUNCH) $(BIN)/pm-queries --size $(SIZE) --direct-visualisation -t $(THREADS) -o $@

out/cornell.exr out/cornell.png &: out/caustics.pmp out/seen.pmq out/soft.exr
	$(LAUNCH) $(BIN)/pm-gather out/caustics.pmp out/seen.pmq -k 50 -t $(THREADS) --no-trace --base out/soft.exr \
	    --image out/cornell.exr --image out/cornell.png

$(ORDERS:%=out/%.csv): out/%.csv: out/%.pmt
	$(LAUNCH) $(BIN)/pm-cachesim --format csv $< > $@

# ---- make full-size: the paper's own size, through pipes and without storing the streams ----------------------------

FULL := scanline scanline-inf scanline-preorder tiled-hilbert hilbert hilbert-inf hilbert-preorder

full-size: $(FULL:%=out/full/%.csv) ## The paper's size (512 x 512, 100 gathers, 450,000 photons): 20 minutes on two cores
	@awk -v tiles=1024 -v rays=$$((512 * 512 * 100)) -f scripts/compare.awk scripts/paper.csv $^

out/full/map.pmp: | programs
	mkdir -p out/full
	$(LAUNCH) $(BIN)/pm-photons -n 450000 -t $(THREADS) -o $@

# The order and the options of pm-gather, by the two halves of the target's name.
OPTIONS_inf := --start-radius inf
OPTIONS_preorder := --layout preorder
OPTIONS_reread := --reread
variant = $(filter inf preorder reread,$(lastword $(subst -, ,$*)))
order = $(if $(variant),$(patsubst %-$(variant),%,$*),$*)

out/full/%.csv: out/full/map.pmp
	$(LAUNCH) sh -c '$(call ORDER_$(order),--size 512x512,$<,) | $(BIN)/pm-gather $< -t $(THREADS) $(OPTIONS_$(variant)) | $(BIN)/pm-cachesim --format csv' > $@

# ---- make causes: what the fetches of the plain order depend on, at 64 x 64 pixels and the paper's 450,000 photons --

CAUSES := scanline shuffled inf fixed-0.02 fixed-0.025 fixed-0.03 reread preorder photons-100000 photons-200000 random
SMALL_QUERIES := $(BIN)/pm-queries --size 64x64
CAUSE_shuffled = $(SMALL_QUERIES) --strata shuffled | $(BIN)/pm-gather $<
CAUSE_random = $(SMALL_QUERIES) | $(BIN)/pm-reorder random | $(BIN)/pm-gather $<
CAUSE_photons-100000 = $(BIN)/pm-photons -n 100000 -o out/causes/100000.pmp && $(SMALL_QUERIES) | $(BIN)/pm-gather out/causes/100000.pmp
CAUSE_photons-200000 = $(BIN)/pm-photons -n 200000 -o out/causes/200000.pmp && $(SMALL_QUERIES) | $(BIN)/pm-gather out/causes/200000.pmp
CAUSE_fixed-0.02 = $(SMALL_QUERIES) | $(BIN)/pm-gather $< --start-radius 0.02
CAUSE_fixed-0.025 = $(SMALL_QUERIES) | $(BIN)/pm-gather $< --start-radius 0.025
CAUSE_fixed-0.03 = $(SMALL_QUERIES) | $(BIN)/pm-gather $< --start-radius 0.03

causes: $(CAUSES:%=out/causes/%.csv) ## What the fetches of the plain order depend on: strata, start radius, second touch, layout, photons
	@awk -v tiles=16 -v rays=$$((64 * 64 * 100)) -f scripts/compare.awk scripts/paper.csv $^

out/causes/%.csv: out/full/map.pmp
	@mkdir -p out/causes
	$(LAUNCH) sh -c '$(or $(CAUSE_$*),$(SMALL_QUERIES) | $(BIN)/pm-gather $< $(OPTIONS_$*)) -t $(THREADS) | $(BIN)/pm-cachesim --format csv' > $@

include scripts/charts.mk
include scripts/frontier.mk
include scripts/structures.mk
include scripts/accuracy.mk
include scripts/pictures.mk
include scripts/coverage.mk

# ---- make scenes ----------------------------------------------------------------------------------------------------

scenes: $(patsubst %,out/scenes/%.obj,fractal columns sphere) ## Make the generated scenes in out/scenes: fractal Cornell box, hall of columns, integrating sphere

out/scenes/%.obj: | programs
	$(LAUNCH) $(BIN)/pm-scene $* -q -o out/scenes

# ---- checks ---------------------------------------------------------------------------------------------------------

test: ## All tests, optimised
	$(CARGO) test --workspace --release

check: ## Formatting and lints
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets --release -- -D warnings

stability: ## Photon maps under stress: out/stability.txt, a table of structures and what breaks them
	mkdir -p out
	PM_STABILITY_TABLE=$(CURDIR)/out/stability.txt $(CARGO) test -q -p pm-tools --release --lib stability
	@cat out/stability.txt

bench: ## Speed, as ratios measured side by side
	$(CARGO) bench -p pm-tools

man: programs ## Manual pages of all programs in out/man
	mkdir -p out/man
	for program in photons queries reorder sample gather cachesim chart view scene; do \
	    $(BIN)/pm-$$program --generate man > out/man/pm-$$program.1 || exit 1; \
	done

clean: ## Remove out/
	rm -rf out
