# make later: what came after the paper, and what it leaves open.

TAKEN += later

# The sweeps of its sections, a line for each.
LATER := hints
LATER += curves
LATER += latency
LATER += private
LATER += software
LATER += specular
LATER += atlas
LATER += held-orders
LATER += photon-radii
LATER += reverse
LATER += treelets
LATER += groups
LATER += prefetch
LATER += radius
LATER += spills
LATER += bins
LATER += seeds
LATER += views
LATER += direct
LATER += direct-error
LATER += cells

# What the photon map looks like: seen directly, of more and more photons, and by final gathering.
LATER_PICTURES := $(patsubst %,out/later/%.png,direct-10000 direct-100000 direct-1000000 gathered-100000)

later: out/later/report.html ## What came after the paper: hints of a few bits, Morton against Hilbert, latency, private caches, mirrors, order in software, irradiance held beforehand, radii of photons, reverse photon mapping, queues at treelets, searches that several queries share, treelets prefetched, parts by radius, direct visualisation (-j1: some minutes)

out/later/report.html: scripts/later.toml $(LATER:%=out/%.csv) out/later/claims.csv $(LATER_PICTURES) $(call made_with,REPORTING)
	@mkdir -p $(@D)
	$(BIN)/pm-chart -q --anyway --page $< -o $@
	@echo "After the paper: $@"

# What others have published, and what we find.
out/later/claims.csv: scripts/later-claims.csv $(CLAIMED.later-claims) $(call made_with,REPORTING)
	@mkdir -p $(@D)
	@$(BIN)/pm-sweep derive claims $< -o $@

# What direct visualisation is compared with: the same picture as for final gathering. The map has the light that comes straight from the lamp as
# well, so that what is not looked up is what shines itself.
out/references/shown.exr: out/references/cornell.exr
	$(LAUNCH) pm-queries -q --size 48x48 --direct-visualisation --base out/references/shown.base.exr -o out/references/shown.pmq
	@rm -f out/references/shown.pmq
	@cp $< $@

shown_direct := --direct-visualisation
shown_gathered := --gathers 36
$(LATER_PICTURES): out/later/%.png: out/streams/n-$$(lastword $$(subst -, ,$$*)).pmp $(call made_with,PROGRAMS)
	@mkdir -p $(@D)
	$(LAUNCH) bash -euo pipefail -c 'pm-queries -q --size 128x128 $(shown_$(firstword $(subst -, ,$*))) -t $(THREADS) --base $(@:.png=.base.exr) | \
	    pm-gather -q $< - --no-trace -t $(THREADS) --base $(@:.png=.base.exr) --image $@'
	@rm -f $(@:.png=.base.exr)
