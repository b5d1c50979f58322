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
LATER += radius
LATER += spills
LATER += bins
LATER += seeds
LATER += views
LATER += direct
LATER += cells

later: out/later/report.html ## What came after the paper: hints of a few bits, Morton against Hilbert, latency, private caches, mirrors, order in software, irradiance held beforehand, radii of photons, reverse photon mapping, queues at treelets, parts by radius (-j1: some minutes)

out/later/report.html: scripts/later.toml $(LATER:%=out/%.csv) $(call made_with,REPORTING)
	@mkdir -p $(@D)
	$(BIN)/pm-chart -q --anyway --page $< -o $@
	@echo "After the paper: $@"
