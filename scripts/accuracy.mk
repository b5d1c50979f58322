# make accuracy: is the light right? What is known stands in scripts/accuracy.csv; each experiment is a target of its own,
# its rows in out/accuracy/NAME.csv.

ACCURACY := out/accuracy
TAKEN += accuracy
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
SEEDS := 1 2 3 4
RECIPES := recipe-box gap $(SEEDS:%=recipe-spheres-%)
PICTURES := $(FURNACES) $(BOXES) cached full recipe-box gap
EXPERIMENTS := $(PICTURES) recipe-spheres flux edges cached-searches full-searches powers-made powers-read

accuracy: $(EXPERIMENTS:%=$(ACCURACY)/%.csv) $(ACCURACY)/report.html ## Is the light right, and what does it cost? Furnaces, path tracers' rooms, recipes: ten minutes
	@$(BIN)/pm-sweep derive accuracy $(KNOWN) $(filter %.csv,$^)
	@echo "Error against processor time: $(ACCURACY)/report.html"

# The rectangles of a picture that something is known of.
regions = $(shell $(BIN)/pm-sweep derive regions --with experiment=$1 $(KNOWN))

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

$(patsubst %,$(ACCURACY)/%.pmp,furnace sphere grey mm far $(BOXES)): $(ACCURACY)/%.pmp: $$(SCENE_$$*) $(call made_with,PROGRAMS) | $(ACCURACY)
	$(LAUNCH) $(BIN)/pm-photons -q $< -n $(if $(filter box-%,$*),300000,1000000) -t $(THREADS) -o $@

$(PICTURES:%=$(ACCURACY)/%.csv): $(ACCURACY)/%.csv: $(ACCURACY)/%.exr
	$(LAUNCH) $(BIN)/pm-view $< $(or $(call regions,$*),--mean all) --format csv -o $@

# The furnace otherwise: all grey, and scenes of another size and at another place.
$(SCENE_grey): scenes/furnace.obj scenes/furnace.mtl scenes/furnace.camera.toml | $(ACCURACY)/scenes
	sed 's/^Kd .*/Kd .8 .8 .8/' scenes/furnace.mtl > $(@D)/grey.mtl
	cp scenes/furnace.camera.toml $(@D)/grey.camera.toml
	sed 's/^mtllib .*/mtllib grey.mtl/' $< > $@

PLACE_mm := --scale 1000
PLACE_far := --scale 100 --offset 1e5
$(foreach at,mm far,$(ACCURACY)/scenes/furnace-$(at).obj $(ACCURACY)/scenes/cornell-diffuse-$(at).obj): $(ACCURACY)/scenes/%.obj: $(call made_with,PROGRAMS) | $(ACCURACY)/scenes
	cp scenes/*.mtl $(@D)
	$(BIN)/pm-sweep place $(PLACE_$(lastword $(words))) scenes/$(*:-$(lastword $(words))=).camera.toml -o $(@D)/$*.camera.toml
	$(BIN)/pm-sweep place $(PLACE_$(lastword $(words))) scenes/$(*:-$(lastword $(words))=).obj -o $@

# Sixteen maps tell the flux and its standard error.
$(BATCHES:%=$(ACCURACY)/flux-%.pmp): $(ACCURACY)/flux-%.pmp: $(SCENE_box) $(call made_with,PROGRAMS) | $(ACCURACY)
	$(LAUNCH) $(BIN)/pm-photons -q $< -n 65536 --seed $* -t $(THREADS) -o $@

$(BATCHES:%=$(ACCURACY)/flux-%.csv): %.csv: %.pmp
	$(LAUNCH) sh -c '$(BIN)/pm-view --records $< | $(BIN)/pm-sweep derive flux --with paths=$$($(BIN)/pm-view -q $< | sed -n "s/.*emitted_paths *//p" | tr -d ,) -' > $@

$(ACCURACY)/flux.csv: $(BATCHES:%=$(ACCURACY)/flux-%.csv)
	$(BIN)/pm-sweep derive batches $(filter %.csv,$^) -o $@

# The map itself at edges and corners, where there is little light and few photons: eight maps of a million.
EDGES := 1 2 3 4 5 6 7 8
$(EDGES:%=$(ACCURACY)/edges-%.pmp): $(ACCURACY)/edges-%.pmp: $(SCENE_box) $(call made_with,PROGRAMS) | $(ACCURACY)
	$(LAUNCH) $(BIN)/pm-photons -q $< -n 1000000 --seed $* -t $(THREADS) -o $@

$(EDGES:%=$(ACCURACY)/edges-%.exr): %.exr: %.pmp
	$(call picture,$(SCENE_box) --size 256x256 --direct-visualisation,$<)

$(EDGES:%=$(ACCURACY)/edges-%.csv): %.csv: %.exr
	$(LAUNCH) $(BIN)/pm-view $< $(call regions,edges) --format csv -o $@

$(ACCURACY)/edges.csv: $(EDGES:%=$(ACCURACY)/edges-%.csv)
	$(BIN)/pm-sweep derive batches $(filter %.csv,$^) -o $@

# Cached irradiance against a full gather. Speckles of caustics would drown what is compared. A quarter of the rays is
# enough for the mean of the full one; its searches are counted with all.
CACHE_full := --size 512x512 --no-caustics
CACHE_cached := $(CACHE_full) --irradiance-cache 0.1
$(ACCURACY)/cached.exr $(ACCURACY)/full.exr: $(ACCURACY)/%.exr: $(ACCURACY)/cornell.pmp
	$(call picture,$(CACHE_$*) $(if $(filter full,$*),--gathers 25),$<)

$(ACCURACY)/cornell.pmp: $(call made_with,PROGRAMS) | $(ACCURACY)
	$(LAUNCH) $(BIN)/pm-photons -q -n 100000 -t $(THREADS) -o $@

$(ACCURACY)/cached-searches.csv $(ACCURACY)/full-searches.csv: $(ACCURACY)/%-searches.csv: $(call made_with,PROGRAMS) | $(ACCURACY)
	$(LAUNCH) sh -c '$(BIN)/pm-queries -q $(CACHE_$*) -t $(THREADS) | $(BIN)/pm-view -q --check | sed "s/.*whole, \([0-9]*\) .*/name,r,g,b\nsearches,\1,,/"' > $@

$(ACCURACY)/powers.csv: $(call made_with,PROGRAMS) | $(ACCURACY)
	$(LAUNCH) $(BIN)/pm-sweep derive powers -o $@

$(ACCURACY)/powers-made.csv: $(ACCURACY)/powers.csv
	$(LAUNCH) $(BIN)/pm-sweep derive mean $< -o $@

$(ACCURACY)/powers-read.csv: $(ACCURACY)/powers.csv $(call made_with,PROGRAMS)
	$(LAUNCH) sh -c '$(BIN)/pm-view -q --import photons $< | $(BIN)/pm-view --records | $(BIN)/pm-sweep derive mean -' > $@

# The recipe of pm-picture as it is, with four seeds where rectangles are small, and in a room lit through a gap: few photons
# come through, so there are more of them.
SCENE_recipe-box := scenes/cornell-diffuse.obj
SCENE_recipe-spheres := scenes/cornell.obj
SCENE_gap := out/scenes/gap.obj
of_recipe = $(if $(findstring spheres,$*),recipe-spheres,$*)
$(RECIPES:%=$(ACCURACY)/%.exr): $(ACCURACY)/%.exr: $$(SCENE_$$(of_recipe)) $(call made_with,PROGRAMS) | $(ACCURACY)
	$(LAUNCH) $(BIN)/pm-picture -q $< $(if $(filter gap,$*),--size 64x64 -n 4000000,--size 128x128) \
	    $(if $(findstring spheres,$*),--seed $(lastword $(words))) -t $(THREADS) --image $@

$(SEEDS:%=$(ACCURACY)/recipe-spheres-%.csv): %.csv: %.exr
	$(LAUNCH) $(BIN)/pm-view $< $(call regions,recipe-spheres) --format csv -o $@

$(ACCURACY)/recipe-spheres.csv: $(SEEDS:%=$(ACCURACY)/recipe-spheres-%.csv)
	$(BIN)/pm-sweep derive batches $(filter %.csv,$^) -o $@

# Error against processor time: recipes in five rooms, and with MITSUBA=PYTHON a path tracer beside them.
MITSUBA ?=
export MITSUBA
$(ACCURACY)/frontier.csv: out/recipes.csv $(if $(MITSUBA),out/pathtracer.csv) $(call made_with,MITSUBA REPORTING) | $(ACCURACY)
	@$(BIN)/$(JOIN) $(inputs) -o $@

$(ACCURACY)/report.html: scripts/accuracy.toml $(ACCURACY)/frontier.csv $(call made_with,REPORTING)
	$(BIN)/pm-chart -q --anyway --page $< -o $@
