# make pictures: every scene, to look at.

LOOK := out/pictures
TAKEN += pictures
PICTURED := cornell cornell-diffuse fractal columns columns-cached furnace sphere gap sunlit
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

$(LOOK)/%.pmp: $$(call scene_of,$$*) $(call made_with,PROGRAMS) | $(LOOK)
	$(LAUNCH) $(BIN)/pm-photons -q $< -n 400000 -t $(THREADS) -o $@

$(LOOK)/%.caustics.pmp: $$(call scene_of,$$*) $(call made_with,PROGRAMS) | $(LOOK)
	$(LAUNCH) $(BIN)/pm-photons -q $< --caustics -n 100000 -t $(THREADS) -o $@

# The light that is soft, by final gather in the order of the Hilbert curve, and direct light.
soft = $(LAUNCH) sh -c '$(BIN)/pm-queries -q $(call scene_of,$*) $(LOOK_SIZE) $(LIGHTS_$(call base_of,$*)) $(if $(filter %-cached,$*),--irradiance-cache 0.1,--gathers 36) \
    $(if $(filter $*,$(SPARKLING)),--no-caustics) --base $(LOOK)/$*.base.exr -t $(THREADS) | $(BIN)/pm-reorder -q hilbert | \
    $(BIN)/pm-gather -q $(LOOK)/$(call base_of,$*).pmp - -k 50 --base $(LOOK)/$*.base.exr $1 --no-trace -t $(THREADS)'

$(LOOK)/%.soft.exr: $(LOOK)/$$(call base_of,$$*).pmp $(call made_with,LOOK_SIZE)
	$(call soft,--image $@)

# And what is sharp, where there is such light.
sharp = $(LAUNCH) sh -c '$(BIN)/pm-queries -q $(call scene_of,$*) $(LOOK_SIZE) --direct-visualisation -t $(THREADS) | \
    $(BIN)/pm-gather -q $(LOOK)/$(call base_of,$*).caustics.pmp - -k 50 --base $(LOOK)/$*.soft.exr $1 --no-trace -t $(THREADS)'

$(LOOK)/%.exr $(LOOK)/%.png: $$(if $$(filter $$*,$$(SPARKLING)),$(LOOK)/$$(call base_of,$$*).caustics.pmp $(LOOK)/$$*.soft.exr,$(LOOK)/$$*.pmp) $(call made_with,LOOK_SIZE)
	$(call $(if $(filter $*,$(SPARKLING)),sharp,soft),$(EXPOSURE_$*) --image $(LOOK)/$*.exr --image $(LOOK)/$*.png)

# Kept, so that a rerun makes only what is missing.
.SECONDARY: $(foreach name,$(PICTURED),$(LOOK)/$(name).pmp $(LOOK)/$(name).caustics.pmp $(LOOK)/$(name).soft.exr $(LOOK)/$(name).exr)
