# make paper: every table and figure of the paper again, sampled, and what the paper leaves out.

PAPER_SWEEPS := table1 figure6 figure6-cached figure7 figure8 scenes guided hashing convergence pictures cached storage shards sampling failures
TAKEN += paper references exact
PAPER_DATA := $(PAPER_SWEEPS:%=out/%.csv) $(patsubst %,out/paper/%.csv,table1 storage cheapest sampling claims plan)
# Of Figures 1 and 4; scripts/pictures.mk renders them.
PAPER_PICTURES := $(patsubst %,out/pictures/%.png,cornell fractal columns columns-cached)

paper: out/paper/report.html ## The paper's tables and figures again, sampled, in one page: out/paper/report.html (-j2: a quarter of an hour)
	@echo "Report: $<"
.PHONY: paper

out/paper/report.html: scripts/report.toml $(PAPER_DATA) $(PAPER_PICTURES) $(wildcard scripts/paper-*.csv) $(call made_with,REPORTING)
	pm-chart -q --anyway --page $< -o $@

out/paper/table1.csv: scripts/paper-table1.csv out/table1.csv $(call made_with,REPORTING)
	@mkdir -p $(@D)
	@$(BIN)/pm-sweep derive table1 scripts/paper-table1.csv out/table1.csv -o $@

out/paper/storage.csv: out/storage.csv $(call made_with,REPORTING)
	@mkdir -p $(@D)
	@$(BIN)/pm-sweep derive frontier $< -o $@

out/paper/cheapest.csv: out/pictures.csv $(call made_with,REPORTING)
	@mkdir -p $(@D)
	@$(BIN)/pm-sweep derive cheapest $< -o $@

out/paper/sampling.csv: out/sampling.csv $(call made_with,REPORTING)
	@mkdir -p $(@D)
	@$(BIN)/pm-sweep derive sampled $< -o $@

# How little the paper's picture needs for an error of 5 %, where bytes are to be saved. Trials hang on time as well, so it may differ a little.
out/paper/plan.csv: $(call made_with,PROGRAMS)
	$(call row,pm-plan -q --size 512x512 --error 5% --on-chip 128K -t $(THREADS) --format csv)

# What pictures are compared with: many photons, many neighbours, many rays, another seed.
out/references/cornell.exr out/references/cornell.base.exr &: $(call made_with,PROGRAMS)
	@mkdir -p $(@D)
	$(LAUNCH) bash -euo pipefail -c 'pm-photons -q -n 2000000 --seed 7 -t $(THREADS) -o out/references/cornell.pmp && \
	    pm-queries -q --size 48x48 --seed 7 -t $(THREADS) --gathers 400 --light-samples 64 --base out/references/cornell.base.exr | \
	    pm-gather -q out/references/cornell.pmp - -k 200 -t $(THREADS) --no-trace --base out/references/cornell.base.exr --image out/references/cornell.exr'
	@test -s out/references/cornell.exr

# What cached irradiance is compared with, the same view without a cache: a wall, where it is cached with ease, and a corner; the plain box and the
# fractal one, in all their light and where what mirrors and glass focus is left to a map of its own (soft).
VIEW := --size 48x48 --gathers 400
export VIEW_wall := $(VIEW) --vfov 40 --eye 0,0.75,-0.1 --look-at 0,0.75,-0.5
export VIEW_corner := $(VIEW) --vfov 40 --eye -0.2,0.7,-0.2 --look-at -0.5,1,-0.5
export VIEW_soft := $(VIEW) --no-caustics
export VIEW_all := $(VIEW)
VIEWED := scenes/cornell-diffuse.obj
VIEWED_plain := scenes/cornell.obj
VIEWED_fractal := out/scenes/fractal.obj
view_of = $(VIEW_$(firstword $(subst -, ,$1)))
viewed = $(or $(VIEWED_$(lastword $(subst -, ,$1))),$(VIEWED))
$(patsubst %,out/references/%.exr,wall corner soft-plain soft-fractal all-plain all-fractal): out/references/%.exr: \
        $$(call viewed,$$*) out/streams/$$(subst /,-,$$(call viewed,$$*))-n-50000.pmp $(call made_with,VIEW_wall VIEW_corner VIEW_soft VIEW_all PROGRAMS)
	@mkdir -p $(@D)
	$(LAUNCH) bash -euo pipefail -c 'pm-queries -q $< $(call view_of,$*) -t $(THREADS) --base out/references/$*.base.exr | \
	    pm-gather -q $(word 2,$^) - --no-trace -t $(THREADS) --base out/references/$*.base.exr --image $@'
	@test -s $@

# The diffuse box, and the same with every surface as glossy as not.
out/scenes/box-diffuse.obj out/scenes/box-glossy.obj: out/scenes/box-%.obj: scenes/cornell-diffuse.obj scenes/cornell-diffuse.mtl scripts/scenes/box-glossy.mtl
	@mkdir -p $(@D)
	@cp $(if $(filter glossy,$*),scripts/scenes/box-glossy.mtl,scenes/cornell-diffuse.mtl) out/scenes/box-$*.mtl
	@cp scenes/cornell-diffuse.camera.toml out/scenes/box-$*.camera.toml
	@sed 's/^mtllib .*/mtllib box-$*.mtl/' $< > $@

# What the paper says, and what we find.
out/paper/claims.csv: scripts/claims.csv $(CLAIMED.claims) $(call made_with,REPORTING)
	@mkdir -p $(@D)
	@$(BIN)/pm-sweep derive claims $< -o $@

# The same in full, in a folder of its own where nothing is cut into windows or thinned; what there is stays, so that it may be
# stopped and go on.
EXACT := out/exact
paper-exact: programs ## The same with nothing sampled: a working day, point by point; may be stopped and go on
	@mkdir -p $(EXACT)/scripts/sweeps
	@cp -pr Makefile scenes $(EXACT) && cp -p $(wildcard scripts/*.*) $(EXACT)/scripts
	@for table in scripts/sweeps/*.csv; do \
	    $(BIN)/pm-sweep derive exact $$table > $(EXACT)/new && { cmp -s $(EXACT)/new $(EXACT)/$$table || cp $(EXACT)/new $(EXACT)/$$table; } || exit 1; \
	done
	@ln -sfn $(CURDIR)/target $(EXACT)/target
	$(MAKE) -C $(EXACT) CARGO=true paper
.PHONY: paper-exact
