# make coverage: do the intervals of samples hold the truth as often as they say? At sizes where the whole is simulated as well,
# with a thousand samples of 5 % of the searches, warm-up included: of a fixed number of windows, and added to until
# the interval is narrow enough. Each point is out/coverage/ORDER.csv. What it found stands in scripts/coverage.csv too, for the
# report.

COVERAGE_SEEDS := 1000
COVERAGE_ORDERS := scanline tiled binned binned-hashed tiled-hilbert
COVERAGE_SIZE := --size 64x64
TAKEN += coverage

# Windows of searches and their warm-up. Of tiled-hilbert, the picture is one of many tiles.
COVERAGE_scanline := --window 100 --warm-up 40
COVERAGE_tiled := --window 100 --warm-up 40
COVERAGE_binned := --window 64 --warm-up 64
COVERAGE_binned-hashed := --window 64 --warm-up 48
COVERAGE_tiled-hilbert := --window 400 --warm-up 600
COVERAGE_SIZE_tiled-hilbert := --size 200x200 --tile 10

coverage: out/coverage.csv ## How often intervals of samples hold the truth, over 1,000 seeds: out/coverage.csv
	@$(BIN)/pm-sweep derive coverage $<
	@cmp -s $< scripts/coverage.csv || echo 'The report shows other numbers: cp $< scripts/coverage.csv'

out/coverage/map.pmp: $(call made_with,PROGRAMS)
	mkdir -p $(@D)
	$(LAUNCH) $(BIN)/pm-photons -n 100000 -t $(THREADS) -o $@

out/coverage/coverage: $(call made_with,PROGRAMS)
	mkdir -p $(@D)
	$(CARGO) build --release -p pm-programs --example coverage
	cp $(BIN)/examples/coverage $@

COVERAGE_POINTS := $(COVERAGE_ORDERS:%=out/coverage/%.csv)
$(foreach order,$(COVERAGE_ORDERS),$(eval out/coverage/$(order).csv: \
    $(call made_with,COVERAGE_SEEDS COVERAGE_SIZE COVERAGE_SIZE_$(order) COVERAGE_$(order))))
$(COVERAGE_POINTS): out/coverage/%.csv: out/coverage/map.pmp out/coverage/coverage
	$(call row,$(call ORDER_$*,$(or $(COVERAGE_SIZE_$*),$(COVERAGE_SIZE)),$<,) | pm-gather $< -t $(THREADS) | \
	    out/coverage/coverage --order $* --seeds $(COVERAGE_SEEDS) $(COVERAGE_$*) --format csv)

out/coverage.csv: $(COVERAGE_POINTS) $(call made_with,COVERAGE_ORDERS REPORTING)
	$(JOIN) $(inputs) -o $@
