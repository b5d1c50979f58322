# The human entry point; `make` alone lists the targets. Every heavy command is prefixed by $(LAUNCH), empty by default.

LAUNCH ?=
THREADS ?= $(shell nproc 2>/dev/null || echo 2)
CARGO ?= cargo
BIN := target/release

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.SUFFIXES:
.PHONY: help programs run accuracy pictures charts-cache scenes test check full-size causes bench man clean

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

# ---- make accuracy: is the light right? ------------------------------------------------------------------------------
# What is known stands in scripts/accuracy.csv; each experiment is a target of its own, its rows in out/accuracy/NAME.csv.

ACCURACY := out/accuracy
KNOWN := scripts/accuracy.csv
SCENE_furnace := scenes/furnace.obj
SCENE_sphere := out/scenes/sphere.obj
SCENE_grey := $(ACCURACY)/scenes/grey.obj
SCENE_mm := $(ACCURACY)/scenes/furnace-mm.obj
SCENE_far := $(ACCURACY)/scenes/furnace-far.obj
SCENE_box := scenes/cornell-diffuse.obj
SCENE_box-plain := scenes/cornell-diffuse.obj
SCENE_box-mm := $(ACCURACY)/scenes/cornell-diffuse-mm.obj
SCENE_box-far := $(ACCURACY)/scenes/cornell-diffuse-far.obj

FURNACES := $(foreach k,10 30 100,furnace-direct-$k furnace-gather-$k sphere-direct-$k sphere-gather-$k) \
    $(foreach scene,grey mm far,$(scene)-direct-100 $(scene)-gather-100)
BOXES := box box-plain box-mm box-far
BATCHES := 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16
PICTURES := $(FURNACES) $(BOXES) cached full
EXPERIMENTS := $(PICTURES) flux edges cached-searches full-searches powers-made powers-read

accuracy: $(EXPERIMENTS:%=$(ACCURACY)/%.csv) ## Is the light right? Furnaces, an integrating sphere, a path tracer's box: three minutes
	@awk -f scripts/accuracy.awk $(KNOWN) $^

# The rectangles of a picture that something is known of.
regions = $(shell awk -F, -v e=$1 '$$1 == e { n = split($$2, part, " - "); for (i = 1; i <= n; i++) { gsub(" ", ",", part[i]); print "--mean " part[i] } }' $(KNOWN))

# By the words of the target's name: scene, method, k. With few neighbours there must be many pixels for a mean.
words = $(subst -, ,$*)
VIEW_direct = --direct-visualisation --size $(if $(filter 100,$(lastword $(words))),100x100,240x240)
VIEW_gather = --size 24x24 --gathers 64
VIEW_box = --size 256x256 --gathers 49
VIEW_plain = --size 128x128 --gathers 9
VIEW_mm = $(VIEW_plain)
VIEW_far = $(VIEW_plain)
# pm-gather opens the base picture after the last query, when pm-queries has written it.
picture = $(LAUNCH) sh -c '$(BIN)/pm-queries -q $1 --base $(@:.exr=.base.exr) -t $(THREADS) | $(BIN)/pm-gather -q $2 - \
    --base $(@:.exr=.base.exr) --image $@ --no-trace -t $(THREADS)'

.SECONDEXPANSION:
$(FURNACES:%=$(ACCURACY)/%.exr): $(ACCURACY)/%.exr: $(ACCURACY)/$$(firstword $$(words)).pmp
	$(call picture,$(SCENE_$(firstword $(words))) $(VIEW_$(word 2,$(words))),$< -k $(lastword $(words)))

$(BOXES:%=$(ACCURACY)/%.exr): $(ACCURACY)/%.exr: $(ACCURACY)/%.pmp
	$(call picture,$(SCENE_$*) $(VIEW_$(lastword $(words))),$<)

$(ACCURACY) $(ACCURACY)/scenes:
	mkdir -p $@

$(patsubst %,$(ACCURACY)/%.pmp,furnace sphere grey mm far $(BOXES)): $(ACCURACY)/%.pmp: $$(SCENE_$$*) | programs $(ACCURACY)
	$(LAUNCH) $(BIN)/pm-photons -q $< -n $(if $(filter box-%,$*),300000,1000000) -t $(THREADS) -o $@

$(PICTURES:%=$(ACCURACY)/%.csv): $(ACCURACY)/%.csv: $(ACCURACY)/%.exr
	$(LAUNCH) $(BIN)/pm-view $< $(or $(call regions,$*),--mean all) --format csv -o $@

# The furnace otherwise: all grey, and scenes of another size and at another place.
$(SCENE_grey): scenes/furnace.obj scenes/furnace.mtl scenes/furnace.camera.toml | $(ACCURACY)/scenes
	sed 's/^Kd .*/Kd .8 .8 .8/' scenes/furnace.mtl > $(@D)/grey.mtl
	cp scenes/furnace.camera.toml $(@D)/grey.camera.toml
	sed 's/^mtllib .*/mtllib grey.mtl/' $< > $@

PLACE_mm := -v scale=1000 -v offset=0
PLACE_far := -v scale=100 -v offset=1e5
$(foreach at,mm far,$(ACCURACY)/scenes/furnace-$(at).obj $(ACCURACY)/scenes/cornell-diffuse-$(at).obj): $(ACCURACY)/scenes/%.obj: scripts/place.awk | $(ACCURACY)/scenes
	cp scenes/*.mtl $(@D)
	awk $(PLACE_$(lastword $(words))) -f $< scenes/$(*:-$(lastword $(words))=).camera.toml > $(@D)/$*.camera.toml
	awk $(PLACE_$(lastword $(words))) -f $< scenes/$(*:-$(lastword $(words))=).obj > $@

# Sixteen maps tell the flux and its standard error.
$(BATCHES:%=$(ACCURACY)/flux-%.pmp): $(ACCURACY)/flux-%.pmp: $(SCENE_box) | programs $(ACCURACY)
	$(LAUNCH) $(BIN)/pm-photons -q $< -n 65536 --seed $* -t $(THREADS) -o $@

$(BATCHES:%=$(ACCURACY)/flux-%.csv): %.csv: %.pmp
	$(LAUNCH) sh -c '$(BIN)/pm-view --records $< | awk -v paths=$$($(BIN)/pm-view -q $< | sed -n "s/.*emitted_paths *//p" | tr -d ,) -f scripts/flux.awk' > $@

$(ACCURACY)/flux.csv: $(BATCHES:%=$(ACCURACY)/flux-%.csv)
	awk -f scripts/batches.awk $^ > $@

# The map itself at edges and corners, where there is little light and few photons: eight maps of a million.
EDGES := 1 2 3 4 5 6 7 8
$(EDGES:%=$(ACCURACY)/edges-%.pmp): $(ACCURACY)/edges-%.pmp: $(SCENE_box) | programs $(ACCURACY)
	$(LAUNCH) $(BIN)/pm-photons -q $< -n 1000000 --seed $* -t $(THREADS) -o $@

$(EDGES:%=$(ACCURACY)/edges-%.exr): %.exr: %.pmp
	$(call picture,$(SCENE_box) --size 256x256 --direct-visualisation,$<)

$(EDGES:%=$(ACCURACY)/edges-%.csv): %.csv: %.exr
	$(LAUNCH) $(BIN)/pm-view $< $(call regions,edges) --format csv -o $@

$(ACCURACY)/edges.csv: $(EDGES:%=$(ACCURACY)/edges-%.csv)
	awk -f scripts/batches.awk $^ > $@

# Cached irradiance against a full gather. Speckles of caustics would drown what is compared. A quarter of the rays is
# enough for the mean of the full one; its searches are counted with all.
CACHE_full := --size 512x512 --no-caustics
CACHE_cached := $(CACHE_full) --irradiance-cache 0.1
$(ACCURACY)/cached.exr $(ACCURACY)/full.exr: $(ACCURACY)/%.exr: $(ACCURACY)/cornell.pmp
	$(call picture,$(CACHE_$*) $(if $(filter full,$*),--gathers 25),$<)

$(ACCURACY)/cornell.pmp: | programs $(ACCURACY)
	$(LAUNCH) $(BIN)/pm-photons -q -n 100000 -t $(THREADS) -o $@

$(ACCURACY)/cached-searches.csv $(ACCURACY)/full-searches.csv: $(ACCURACY)/%-searches.csv: | programs $(ACCURACY)
	$(LAUNCH) sh -c '$(BIN)/pm-queries -q $(CACHE_$*) -t $(THREADS) | $(BIN)/pm-view -q --check | awk -F "whole, " "{ print \"name,r,g,b\"; print \"searches,\" \$$2 + 0 \",,\" }"' > $@

$(ACCURACY)/powers.csv: scripts/powers.awk | $(ACCURACY)
	$(LAUNCH) awk -f scripts/powers.awk > $@

$(ACCURACY)/powers-made.csv: $(ACCURACY)/powers.csv
	$(LAUNCH) awk -v mean=1 -f scripts/powers.awk $< > $@

$(ACCURACY)/powers-read.csv: $(ACCURACY)/powers.csv | programs
	$(LAUNCH) sh -c '$(BIN)/pm-view -q --import photons $< | $(BIN)/pm-view --records | awk -v mean=1 -f scripts/powers.awk -' > $@

# ---- make pictures: every scene, to look at ------------------------------------------------------------------------

LOOK := out/pictures
PICTURED := cornell cornell-diffuse fractal columns columns-cached furnace sphere
# Where light comes through glass or off mirrors, it has a map of its own.
SPARKLING := cornell fractal columns columns-cached
base_of = $(patsubst %-cached,%,$1)
scene_of = $(or $(wildcard scenes/$(base_of).obj),out/scenes/$(base_of).obj)
EXPOSURE_furnace := --exposure -2.5
EXPOSURE_sphere := --exposure -1.5
LOOK_SIZE := --size 224x224
# Seventeen lights instead of one; and walls that shine at one another from as near as their edges.
LIGHTS_columns := --light-samples 128
LIGHTS_furnace := --light-samples 128

pictures: $(LOOK)/contact-sheet.png ## All scenes rendered, in out/pictures, and a contact sheet: two minutes
	@echo "Pictures: $(LOOK)/*.png (previews), *.exr (linear); all of them on $<"

$(LOOK)/contact-sheet.png: $(PICTURED:%=$(LOOK)/%.png)
	$(BIN)/pm-view $^ --sheet $@

$(LOOK):
	mkdir -p $@

$(LOOK)/%.pmp: $$(call scene_of,$$*) | programs $(LOOK)
	$(LAUNCH) $(BIN)/pm-photons -q $< -n 400000 -t $(THREADS) -o $@

$(LOOK)/%.caustics.pmp: $$(call scene_of,$$*) | programs $(LOOK)
	$(LAUNCH) $(BIN)/pm-photons -q $< --caustics -n 100000 -t $(THREADS) -o $@

# The light that is soft, by final gather in the order of the Hilbert curve, and direct light.
soft = $(LAUNCH) sh -c '$(BIN)/pm-queries -q $(call scene_of,$*) $(LOOK_SIZE) $(LIGHTS_$(call base_of,$*)) $(if $(filter %-cached,$*),--irradiance-cache 0.1,--gathers 36) \
    $(if $(filter $*,$(SPARKLING)),--no-caustics) --base $(LOOK)/$*.base.exr -t $(THREADS) | $(BIN)/pm-reorder -q hilbert | \
    $(BIN)/pm-gather -q $(LOOK)/$(call base_of,$*).pmp - -k 50 --base $(LOOK)/$*.base.exr $1 --no-trace -t $(THREADS)'

$(LOOK)/%.soft.exr: $(LOOK)/$$(call base_of,$$*).pmp
	$(call soft,--image $@)

# And what is sharp, where there is such light.
sharp = $(LAUNCH) sh -c '$(BIN)/pm-queries -q $(call scene_of,$*) $(LOOK_SIZE) --direct-visualisation -t $(THREADS) | \
    $(BIN)/pm-gather -q $(LOOK)/$(call base_of,$*).caustics.pmp - -k 50 --kernel cone --base $(LOOK)/$*.soft.exr $1 --no-trace -t $(THREADS)'

$(LOOK)/%.exr $(LOOK)/%.png: $$(if $$(filter $$*,$$(SPARKLING)),$(LOOK)/$$(call base_of,$$*).caustics.pmp $(LOOK)/$$*.soft.exr,$(LOOK)/$$*.pmp)
	$(call $(if $(filter $*,$(SPARKLING)),sharp,soft),$(EXPOSURE_$*) --image $(LOOK)/$*.exr --image $(LOOK)/$*.png)

# Kept, so that a rerun makes only what is missing.
.SECONDARY: $(foreach name,$(PICTURED),$(LOOK)/$(name).pmp $(LOOK)/$(name).caustics.pmp $(LOOK)/$(name).soft.exr $(LOOK)/$(name).exr)
include scripts/charts.mk

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

bench: ## Speed, as ratios measured side by side
	$(CARGO) bench -p pm-tools

man: programs ## Manual pages of all programs in out/man
	mkdir -p out/man
	for program in photons queries reorder gather cachesim chart view scene; do \
	    $(BIN)/pm-$$program --generate man > out/man/pm-$$program.1 || exit 1; \
	done

clean: ## Remove out/
	rm -rf out
