# make later: what came after the paper, and what it leaves open.

TAKEN += later

later: out/later/report.html ## What came after the paper: hints of a few bits, Morton against Hilbert, order in software, irradiance held beforehand (-j1: some minutes)

out/later/report.html: scripts/later.toml out/hints.csv out/curves.csv out/latency.csv out/software.csv out/atlas.csv out/held-orders.csv $(call made_with,REPORTING)
	@mkdir -p $(@D)
	$(BIN)/pm-chart -q --anyway --page $< -o $@
	@echo "After the paper: $@"
